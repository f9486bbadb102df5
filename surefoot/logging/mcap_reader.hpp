#pragma once

#include "surefoot/logging/mcap_format.hpp"
#include "surefoot/logging/mcap_walk.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot {

struct McapChannel {
  std::string topic, schema_name, message_encoding;
  std::map<std::string, std::string> metadata;
};

/// A message; valid until the next one is read.
struct McapMessage {
  const McapChannel* channel = nullptr;
  std::uint64_t log_time = 0;  ///< [ns]
  std::string_view data;
};

/// A part of an MCAP file that can't be read.
struct McapLoss {
  std::uint64_t offset = 0, size = 0;  ///< in the file [bytes]
  std::string why;
  bool may_hold_messages = false;
  bool has_times = false;  ///< of chunks of which is known from when their messages are
  std::uint64_t first_time = 0, last_time = 0;  ///< of them [ns]
};

/// Of the first message that is lost, where it is known [s].
[[nodiscard]] inline std::optional<double> first_time(const McapLoss& loss) {
  if (!loss.has_times) return std::nullopt;
  return 1e-9 * static_cast<double>(loss.first_time);
}

/// Reads an MCAP file from front to back without its index, so that a file that was cut off or
/// damaged gives all of its whole chunks: what can't be read is passed over.
class McapReader {
 public:
  /// Reads up to the first chunk: what was attached before it is known. Throws FileError if the
  /// file is missing, empty, not MCAP, or compressed as can't be read here.
  explicit McapReader(const std::string& path);

  /// The next message in the order of the file that can be read; false at its end. Throws FileError
  /// where a chunk is compressed as can't be read here.
  [[nodiscard]] bool next(McapMessage& message);

  /// After the last message: the file has its footer, and nothing of it is lost.
  [[nodiscard]] bool complete() const { return is_closed_ && losses_.empty(); }
  /// So far: what could not be read, in the order of the file.
  [[nodiscard]] const std::vector<McapLoss>& losses() const { return losses_; }
  /// After the last message: the file has its footer.
  [[nodiscard]] bool is_closed() const { return is_closed_; }
  /// After the last message: the file has the mark behind its last chunk and attachment; what may
  /// be missing is the index.
  [[nodiscard]] bool has_all_data() const { return has_all_data_; }
  /// In a sentence without its end, and without the file's name: what is lost so far, and after the
  /// last message where the file was cut off; empty if it is complete.
  [[nodiscard]] std::string problem() const;
  /// The same of the first place alone: what is wrong, and where.
  [[nodiscard]] std::string damage() const;
  /// Bytes before the chunk, or the record outside of chunks, that the last message stood in.
  [[nodiscard]] std::uint64_t chunk_offset() const { return chunk_offset_; }

  /// By name; those that stand before the last message read, and all after the last one.
  [[nodiscard]] const std::map<std::string, std::string>& attachments() const {
    return attachments_;
  }
  [[nodiscard]] const std::map<std::string, std::map<std::string, std::string>>& metadata() const {
    return metadata_;
  }

 private:
  void check_magic();
  bool read_record();
  void take(mcap::Opcode opcode, std::string_view content);
  void take_descriptions(mcap::Opcode opcode, std::string_view content);
  void take_metadata(std::string_view content);
  bool take_from_chunk(McapMessage& message);
  void open_chunk(std::string_view content);
  void close();
  void learn_descriptions();
  void lose(const std::string& why);
  void stop(const std::string& why);
  [[nodiscard]] std::string place(const std::string& why, std::uint64_t offset) const;

  std::string path_;
  mcap::RecordWalk file_;
  std::uint64_t chunk_offset_ = 0;
  std::string record_, chunk_;
  std::string_view rest_;  // of the open chunk
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::map<std::string, std::string> attachments_;
  std::map<std::string, std::map<std::string, std::string>> metadata_;
  bool is_closed_ = false, ended_ = false, has_learned_ = false, has_all_data_ = false;
  std::vector<McapLoss> losses_;
  std::string end_;  // why and where it ended before its end
};

}  // namespace surefoot
