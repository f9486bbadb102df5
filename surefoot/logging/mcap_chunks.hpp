#pragma once

#include "surefoot/logging/mcap_cursor.hpp"
#include "surefoot/logging/mcap_reader.hpp"
#include "surefoot/logging/mcap_walk.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace surefoot::logging {

/// A chunk of an MCAP file, or some consecutive messages outside of chunks, from other writers.
struct McapChunk {
  std::uint64_t offset = 0, size = 0;           ///< of its record, or records, in the file [bytes]
  std::uint64_t first_time = 0, last_time = 0;  ///< of its messages [ns]
  bool is_bare = false;                         ///< messages outside of chunks
  bool has_sure_times = false;                  ///< read from its messages
};

/// Reads an MCAP file chunk by chunk, in any order, with one chunk in memory. Finds the chunks
/// without reading them, also in a cut-off file. A chunk whose head has times that our recorder
/// never writes is read for its messages' times: other writers may use longer chunks, and a damaged
/// head is arbitrary.
class McapChunks {
 public:
  using Take = std::function<void(const McapMessage&)>;

  /// Throws FileError if the file can't be read.
  explicit McapChunks(const std::string& path);

  [[nodiscard]] const std::vector<McapChunk>& chunks() const { return chunks_; }

  /// The file was closed: it has a data end.
  [[nodiscard]] bool complete() const { return complete_; }
  /// After the last record found [bytes]; an incomplete file was cut off there.
  [[nodiscard]] std::uint64_t end() const { return file_.offset(); }

  /// Data of the last intact attachment with that name; empty without one.
  [[nodiscard]] std::string attachment(const std::string& name);

  /// Number of gaps between the chunks, and of messages outside of chunks that are too short.
  [[nodiscard]] std::size_t num_lost() const { return num_lost_; }

  /// The messages of a chunk, in order. Channels are described after the data, and in the chunk of
  /// their first message, which must have been read before in a cut-off file; messages of unknown
  /// channels are skipped. Throws FileError for a damaged chunk, and, after the readable ones, for
  /// messages outside of chunks that are damaged or of an unknown channel.
  void read(std::size_t chunk, const Take& take);

 private:
  /// A record's content in the file [bytes].
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

}  // namespace surefoot::logging
