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

/// A chunk of an MCAP file; where another writer left its messages outside of chunks, some of them
/// that stand one after the other.
struct McapChunk {
  std::uint64_t offset = 0, size = 0;           ///< of its record, or records, in the file [bytes]
  std::uint64_t first_time = 0, last_time = 0;  ///< of its messages [ns]
  bool is_bare = false;                         ///< its messages stand outside of chunks
  bool has_sure_times = false;                  ///< they were read of its messages
};

/// Reads an MCAP file chunk by chunk, in any order: of a file of any size only one chunk is in
/// memory. Where the chunks lie is found without reading them, also in a file that was cut off; a
/// chunk whose head has times that a recorder gives none is read for those of its messages: another
/// writer's may be longer, and a damaged head says anything.
class McapChunks {
 public:
  using Take = std::function<void(const McapMessage&)>;

  /// Throws FileError if the file can't be read.
  explicit McapChunks(const std::string& path);

  [[nodiscard]] const std::vector<McapChunk>& chunks() const { return chunks_; }

  /// The file was closed: its data have an end.
  [[nodiscard]] bool complete() const { return complete_; }
  /// Behind the last record that was found [bytes]: there a file that is not complete was cut off.
  [[nodiscard]] std::uint64_t end() const { return file_.offset(); }

  /// The data of the last attachment of that name; empty where there is none that is whole.
  [[nodiscard]] std::string attachment(const std::string& name);

  /// Places between the chunks where something stood that can't be found, and messages outside of
  /// chunks that are too short to be one.
  [[nodiscard]] std::size_t num_lost() const { return num_lost_; }

  /// The messages of a chunk, in their order. Channels are described behind the data, and in the
  /// chunk of their first message, which must have been read before where the file was cut off;
  /// messages of a channel that is not known are left out. Throws FileError if the chunk is
  /// damaged; of messages outside of chunks after those that can be read, also where a channel is
  /// not known.
  void read(std::size_t chunk, const Take& take);

 private:
  /// Of a record's content in the file [bytes].
  struct Place {
    std::uint64_t offset, length;
  };

  void find_chunks();
  void learn_channel();
  void learn_times(McapChunk& chunk);
  void add_bare_message();
  [[nodiscard]] std::string records(const McapChunk& chunk);
  void keep(const mcap::ChannelRecord& channel);
  bool take_record(mcap::Opcode opcode, std::string_view content, const Take& take);

  std::string path_;
  mcap::RecordWalk file_;
  std::vector<McapChunk> chunks_;
  std::vector<Place> attachments_;
  std::map<std::uint16_t, McapChannel> channels_;
  bool complete_ = false;
  std::size_t num_lost_ = 0;
};

}  // namespace surefoot
