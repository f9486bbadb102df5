#pragma once

#include "server/event_finder.hpp"
#include "server/frame_range.hpp"
#include "server/log_frames.hpp"
#include "server/view_session.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace surefoot::server {

/// Summary of a whole log: least and greatest of every channel and one frame for each stretch of
/// it, events, and damage. Computed on its own thread, from front to back, in bounded memory: about
/// 100 MB for logs of an hour and more.
class LogSummary {
 public:
  /// Throws FileError as LogFrames.
  LogSummary(const std::string& path, const logging::LogHeader& header);
  ~LogSummary();

  /// One past the last summarised tick.
  [[nodiscard]] std::uint32_t end_tick() const { return known_.load(); }
  /// Ticks of a stretch; it grows with the log.
  [[nodiscard]] std::uint32_t stretch();
  /// Gets the range of the stretches with ticks `first` to `last`; false: not known yet.
  [[nodiscard]] bool range(std::uint32_t first, std::uint32_t last, FrameRange& range);
  /// Gets the kept frame of a tick's stretch; false: none, or not yet.
  [[nodiscard]] bool frame_near(std::uint32_t tick, ViewFrame& frame);
  /// Sentences on what can't be read, so far.
  [[nodiscard]] std::vector<std::string> damage();
  /// Events so far, as JSON: plan events [time, number, leg or null], others {"time", "kind",
  /// "text"}.
  [[nodiscard]] std::string events_json();
  /// The orders of the levels so far, without the first.
  [[nodiscard]] std::vector<ViewOrder> orders();

 private:
  struct Range {
    FrameRange all;
    ViewFrame first;  // without floats: none
  };

  void run();
  /// Number of the stretch of a tick.
  [[nodiscard]] std::size_t place(std::uint32_t tick) const;
  void add(const ViewFrame& frame);
  void add(const LogChunk& chunk);
  void add(const logged::Change& change);
  void add_order(const logged::Change& change);
  void add_damage(const LogChunk& chunk);
  /// Adds the mark at the end of a log that was not closed.
  void add_end();
  void coarsen();

  LogFrames frames_;
  EventFinder finder_;

  std::mutex mutex_;  // guards what follows
  std::vector<Range> ranges_;
  std::uint32_t stretch_ = 64;
  std::vector<std::string> events_;
  std::vector<ViewOrder> orders_;
  std::vector<std::string> damage_;

  std::atomic<std::uint32_t> known_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace surefoot::server
