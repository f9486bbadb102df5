#pragma once

#include "surefoot/logging/mcap_cursor.hpp"
#include "surefoot/logging/mcap_reader.hpp"
#include "surefoot/logging/mcap_walk.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace surefoot {

/// A chunk of an MCAP file.
struct McapChunk {
  std::uint64_t offset = 0, size = 0;           ///< of its record's content in the file [bytes]
  std::uint64_t first_time = 0, last_time = 0;  ///< of its messages [ns]
};

/// Reads an MCAP file chunk by chunk, in any order: of a file of any size only one chunk is in
/// memory. Where the chunks lie is found without reading them, also in a file that was cut off.
class McapChunks {
 public:
  using Take = std::function<void(const McapMessage&)>;

  /// Throws FileError if the file can't be read.
  explicit McapChunks(const std::string& path);

  [[nodiscard]] const std::vector<McapChunk>& chunks() const { return chunks_; }

  /// The file was closed: its data have an end.
  [[nodiscard]] bool complete() const { return complete_; }

  /// Places between the chunks where something stood that can't be found.
  [[nodiscard]] std::size_t num_lost() const { return num_lost_; }

  /// The messages of a chunk, in their order. Channels are described behind the data, and in the
  /// chunk of their first message, which must have been read before where the file was cut off;
  /// messages of a channel that is not known are left out. Throws FileError if the chunk is
  /// damaged.
  void read(std::size_t chunk, const Take& take);

 private:
  void find_chunks();
  void learn_channel();
  void keep(const mcap::ChannelRecord& channel);
  void take_record(mcap::Opcode opcode, std::string_view content, const Take& take);

  std::string path_;
  mcap::RecordWalk file_;
  std::vector<McapChunk> chunks_;
  std::map<std::uint16_t, McapChannel> channels_;
  bool complete_ = false;
  std::size_t num_lost_ = 0;
};

}  // namespace surefoot
