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

namespace surefoot::logging {

struct McapSchema {
  std::string name, encoding, data;
};

struct McapChannel {
  std::string topic, schema_name, message_encoding;
  std::map<std::string, std::string> metadata;
  McapSchema schema{};  ///< of a McapReader's messages
};

/// A message; valid until the next one is read.
struct McapMessage {
  const McapChannel* channel = nullptr;
  std::uint64_t log_time = 0;  ///< [ns]
  std::string_view data;
};

/// An unreadable part of an MCAP file.
struct McapLoss {
  std::uint64_t offset = 0, size = 0;  ///< in the file [bytes]
  std::string why;
  bool may_hold_messages = false;
  bool has_times = false;                       ///< for chunks with known message times
  std::uint64_t first_time = 0, last_time = 0;  ///< of them [ns]
};

/// Time of the first lost message, if known [s].
[[nodiscard]] inline std::optional<double> first_time(const McapLoss& loss) {
  if (!loss.has_times) return std::nullopt;
  return 1e-9 * static_cast<double>(loss.first_time);
}

/// Reads an MCAP file from front to back without its index, so that all intact chunks of a cut-off
/// or damaged file are read; skips the rest.
class McapReader {
 public:
  /// Reads up to the first chunk, with all attachments before it. Throws FileError if the file is
  /// missing, empty, not MCAP, or has an unsupported compression.
  explicit McapReader(const std::string& path);

  /// The next readable message in the file's order; false at the end. Throws FileError for a chunk
  /// with an unsupported compression.
  [[nodiscard]] bool next(McapMessage& message);

  /// After the last message: the file has its footer, and nothing is lost.
  [[nodiscard]] bool complete() const { return is_closed_ && losses_.empty(); }
  /// The unreadable parts so far, in the file's order.
  [[nodiscard]] const std::vector<McapLoss>& losses() const { return losses_; }
  /// After the last message: the file has its data end, so that at most its index is missing.
  [[nodiscard]] bool has_all_data() const { return has_all_data_; }
  /// Sentence without its full stop and the file's name: what is lost so far, and after the last
  /// message where the file was cut off; empty if it is complete.
  [[nodiscard]] std::string problem() const;
  /// The same for the first place only: what is wrong, and where.
  [[nodiscard]] std::string damage() const;
  /// Offset of the chunk, or record outside of chunks, of the last message [bytes].
  [[nodiscard]] std::uint64_t chunk_offset() const { return chunk_offset_; }

  /// By name; those before the last message read, and all after the last one.
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
  std::map<std::uint16_t, McapSchema> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::map<std::string, std::string> attachments_;
  std::map<std::string, std::map<std::string, std::string>> metadata_;
  bool is_closed_ = false, ended_ = false, has_learned_ = false, has_all_data_ = false;
  std::vector<McapLoss> losses_;
  std::string end_;  // reason and place of an early end
};

}  // namespace surefoot::logging
