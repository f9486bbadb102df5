#pragma once

#include "app/view_tick.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/mcap_chunks.hpp"

#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace surefoot {

/// The frames of a log, read from its chunks as they are asked for; few are kept in memory.
class LogFrames {
 public:
  using Frames = std::vector<ViewFrame>;  ///< by tick
  using Changes = std::vector<logged::Change>;

  /// Throws FileError if the file can't be read or holds no whole tick.
  LogFrames(const std::string& path, const LogHeader& header);

  [[nodiscard]] const ViewChannels& channels() const { return channels_; }
  /// Whole ticks; they are numbered from 0.
  [[nodiscard]] std::uint32_t ticks() const { return ticks_; }
  [[nodiscard]] bool complete() const { return file_.complete(); }
  [[nodiscard]] double period() const { return period_; }

  [[nodiscard]] std::size_t num_chunks() const { return ends_.size(); }
  /// Of the chunk that has a tick.
  [[nodiscard]] std::size_t chunk_of(std::uint32_t tick) const;
  /// The frames of a chunk, none where it is damaged. `changes`, if given, gets what was changed
  /// in it.
  [[nodiscard]] std::shared_ptr<const Frames> chunk(std::size_t number, Changes* changes = nullptr);
  /// The frame of a tick; null where its chunk is damaged or lacks it. Stays valid until the next
  /// call.
  [[nodiscard]] const ViewFrame* frame(std::uint32_t tick);

 private:
  struct Decoded;

  [[nodiscard]] std::uint32_t tick_at(std::uint64_t time) const;
  void find_ticks(const std::string& path);
  void learn_channels(const std::string& path);
  [[nodiscard]] Frames decode(std::size_t number, Changes* changes);
  void read_timings(std::uint64_t first, std::uint64_t last, Decoded& decoded);

  McapChunks file_;
  double period_;
  ViewChannels channels_;
  std::vector<std::uint32_t> ends_;   // one past the last tick of each chunk of ticks
  std::vector<std::size_t> timings_;  // chunks of timings
  std::uint32_t ticks_ = 0;
  std::list<std::pair<std::size_t, std::shared_ptr<const Frames>>> recent_;  // the latest first
};

}  // namespace surefoot
