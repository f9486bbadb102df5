#pragma once

#include "server/view_tick.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/mcap_chunks.hpp"

#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot::server {

/// What is said of a log that does not end as a log does.
inline constexpr std::string_view kNeverClosed = "the log was never closed, or is cut off";

/// What a chunk of a log holds, as far as it can be read.
struct LogChunk {
  std::vector<ViewFrame> frames;  ///< by tick; those whose messages can be read
  std::vector<logged::Change> changes;
  double from = 0.0, to = 0.0;  ///< times of its first and last message [s]
  std::string problem;          ///< why ticks are missing; empty: none are
  std::string timing_problem;   ///< why their timings are; empty: none are
};

/// The text of an error without the path that it begins with: a page learns nothing of this machine's
/// folders.
[[nodiscard]] std::string without_path(const std::string& text, const std::string& path);

/// The frames of a log, read from its chunks as they are asked for; few are kept in memory. What is
/// damaged is left out.
class LogFrames {
 public:
  /// Throws FileError if the file can't be read or holds no whole tick.
  LogFrames(const std::string& path, const logging::LogHeader& header);

  [[nodiscard]] const ViewChannels& channels() const { return channels_; }
  /// The number of a tick is its time in periods: the first is that at which the clock begins, or 0
  /// where a piece is lost that may have stood before it.
  [[nodiscard]] std::uint32_t first_tick() const { return first_tick_; }
  /// One past the last.
  [[nodiscard]] std::uint32_t end_tick() const { return end_tick_; }
  [[nodiscard]] bool complete() const { return file_.complete(); }
  /// Where what was found in the file ends [bytes].
  [[nodiscard]] std::uint64_t end_byte() const { return file_.end(); }
  [[nodiscard]] double period() const { return period_; }
  /// Of the run, as its recorder closed the log with it (JSON); empty without one.
  [[nodiscard]] std::string outcome() { return file_.attachment("summary.json"); }

  /// Places where one chunk or more stood of which not even the times can be read.
  [[nodiscard]] std::size_t num_lost() const { return num_lost_; }
  [[nodiscard]] std::size_t num_chunks() const { return ends_.size(); }
  /// Of the chunk that has a tick.
  [[nodiscard]] std::size_t chunk_of(std::uint32_t tick) const;
  [[nodiscard]] std::shared_ptr<const LogChunk> chunk(std::size_t number);
  /// The frame of a tick; null where it can't be read. Stays valid until the next call.
  [[nodiscard]] const ViewFrame* frame(std::uint32_t tick);

 private:
  struct Decoded;

  /// A chunk that has ticks later than all before it, with the times of these ticks: later than
  /// `before`, up to `last` [ns].
  struct Place {
    std::size_t chunk = 0;
    std::uint64_t before = 0, last = 0;
    bool has_before = false;
  };

  [[nodiscard]] std::uint32_t tick_at(std::uint64_t time) const;
  [[nodiscard]] bool has_wrong_times(std::size_t chunk) const;
  void find_ticks(const std::string& path);
  void learn_channels(const std::string& path, const logging::LogHeader& header);
  void find_start();
  [[nodiscard]] LogChunk decode(std::size_t number);
  void read_place(std::size_t number, Decoded& decoded, LogChunk& chunk);
  void read_chunk(std::size_t index, const Place& place, Decoded& decoded, LogChunk& chunk);

  std::string path_;
  logging::McapChunks file_;
  double period_;
  std::optional<tasks::FrictionCone> cone_;
  ViewChannels channels_;
  std::optional<evaluation::StartAlignment> start_;
  std::vector<std::size_t> usable_;  // chunks whose times can be
  std::vector<Place> places_;
  std::vector<std::uint32_t> ends_;  // of each of them: one past its last tick
  std::size_t num_lost_ = 0;
  std::uint32_t first_tick_ = 0, end_tick_ = 0;
  std::list<std::pair<std::size_t, std::shared_ptr<const LogChunk>>> recent_;  // the latest first
};

}  // namespace surefoot::server
