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

/// Text on a log without its regular end.
inline constexpr std::string_view kNeverClosed = "the log was never closed, or is cut off";

/// The readable content of a chunk.
struct LogChunk {
  std::vector<ViewFrame> frames;  ///< by tick; those whose messages can be read
  std::vector<logged::Change> changes;
  double from = 0.0, to = 0.0;  ///< times of its first and last message [s]
  std::string problem;          ///< why ticks are missing; empty: none are
  std::string timing_problem;   ///< why their timings are; empty: none are
};

/// The text of an error without the path at its beginning: pages must not learn this machine's
/// folders.
[[nodiscard]] std::string without_path(const std::string& text, const std::string& path);

/// The frames of a log, read from its chunks on request; few are kept. Damaged ones are left out.
class LogFrames {
 public:
  /// Throws FileError if the file can't be read or holds no whole tick.
  LogFrames(const std::string& path, const logging::LogHeader& header);

  [[nodiscard]] const ViewChannels& channels() const { return channels_; }
  /// A tick's number is its time in periods. The first is where the clock begins, or 0 where an
  /// earlier piece may be lost.
  [[nodiscard]] std::uint32_t first_tick() const { return first_tick_; }
  /// One past the last.
  [[nodiscard]] std::uint32_t end_tick() const { return end_tick_; }
  [[nodiscard]] bool complete() const { return file_.complete(); }
  /// End of what was found in the file [bytes].
  [[nodiscard]] std::uint64_t end_byte() const { return file_.end(); }
  [[nodiscard]] double period() const { return period_; }
  /// The run's outcome at the end of the log (JSON); empty: none.
  [[nodiscard]] std::string outcome() { return file_.attachment("summary.json"); }

  /// Number of gaps whose times can't be read.
  [[nodiscard]] std::size_t num_lost() const { return num_lost_; }
  [[nodiscard]] std::size_t num_chunks() const { return ends_.size(); }
  /// Number of the chunk with a tick.
  [[nodiscard]] std::size_t chunk_of(std::uint32_t tick) const;
  [[nodiscard]] std::shared_ptr<const LogChunk> chunk(std::size_t number);
  /// The frame of a tick, valid until the next call; null: it can't be read.
  [[nodiscard]] const ViewFrame* frame(std::uint32_t tick);

 private:
  struct Decoded;

  /// A chunk with new ticks: those later than `before`, up to `last` [ns].
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
  logging::LogRobot robot_;
  std::optional<tasks::FrictionCone> cone_;
  ViewChannels channels_;
  std::optional<evaluation::StartAlignment> start_;
  std::vector<std::size_t> usable_;  // chunks with possible times
  std::vector<Place> places_;
  std::vector<std::uint32_t> ends_;  // one past the last tick of each place
  std::size_t num_lost_ = 0;
  std::uint32_t first_tick_ = 0, end_tick_ = 0;
  std::list<std::pair<std::size_t, std::shared_ptr<const LogChunk>>> recent_;  // most recent first
};

}  // namespace surefoot::server
