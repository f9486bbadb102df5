#pragma once

#include "surefoot/logging/mcap_format.hpp"

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>

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

/// Reads an MCAP file from front to back without its index, so that a file that was cut off or
/// damaged gives everything up to that place: all of its whole chunks.
class McapReader {
 public:
  /// Reads up to the first chunk: what was attached before it is known. Throws FileError if the
  /// file is missing, empty or not MCAP.
  explicit McapReader(const std::string& path);

  /// The next message in the order of the file; false at its end, or where it stops being readable.
  [[nodiscard]] bool next(McapMessage& message);

  /// After the last message: the file is whole, with its footer.
  [[nodiscard]] bool complete() const { return complete_; }
  /// After the last message: why the file could not be read further; empty if it is complete.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// The same, shorter: what is wrong, and where.
  [[nodiscard]] const std::string& damage() const { return damage_; }
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
  bool read_record();
  void take(mcap::Opcode opcode, std::string_view content);
  bool take_from_chunk(McapMessage& message);
  void open_chunk(std::string_view content);
  void stop(const std::string& why);

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0, offset_ = 0;  // of the file, and what was read of it
  std::uint64_t chunk_offset_ = 0;
  std::string record_, chunk_;
  std::string_view rest_;  // of the open chunk
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::map<std::string, std::string> attachments_;
  std::map<std::string, std::map<std::string, std::string>> metadata_;
  bool complete_ = false, ended_ = false;
  std::string problem_, damage_;
};

}  // namespace surefoot
