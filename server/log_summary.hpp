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

/// What is known of a whole log: over stretches of it the least and greatest of every channel and a
/// frame of each, what happened, and what is damaged. Found on a thread of its own, from front to
/// back, in bounded memory: about 100 MB for logs of an hour and more.
class LogSummary {
 public:
  /// Throws FileError as LogFrames.
  LogSummary(const std::string& path, const logging::LogHeader& header);
  ~LogSummary();

  /// One past the last tick that is known by now.
  [[nodiscard]] std::uint32_t end_tick() const { return known_.load(); }
  /// Ticks of a stretch: more, the longer the log is.
  [[nodiscard]] std::uint32_t stretch();
  /// Gets the range of the stretches that ticks `first` to `last` lie in; false where it is not
  /// known yet.
  [[nodiscard]] bool range(std::uint32_t first, std::uint32_t last, FrameRange& range);
  /// Gets the frame that is kept of the stretch of a tick; false where there is none, or not yet.
  [[nodiscard]] bool frame_near(std::uint32_t tick, ViewFrame& frame);
  /// Sentences on what can't be read, so far.
  [[nodiscard]] std::vector<std::string> damage();
  /// So far, as JSON: plan events as [time, number, leg or null], what else happened as
  /// {"time", "kind", "text"}.
  [[nodiscard]] std::string events_json();
  /// The orders of the levels so far, but the first.
  [[nodiscard]] std::vector<ViewOrder> orders();

 private:
  struct Range {
    FrameRange all;
    ViewFrame first;  // without floats: there is none
  };

  void run();
  /// Of the stretch of a tick.
  [[nodiscard]] std::size_t place(std::uint32_t tick) const;
  void add(const ViewFrame& frame);
  void add(const LogChunk& chunk);
  void add(const logged::Change& change);
  void add_order(const logged::Change& change);
  void add_damage(const LogChunk& chunk);
  /// Of a log that was not closed.
  void add_end();
  void coarsen();

  LogFrames frames_;
  EventFinder finder_;

  std::mutex mutex_;  // of what follows
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
