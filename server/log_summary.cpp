#include "server/log_summary.hpp"

#include "surefoot/base/background.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/config/config_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace surefoot::server {
namespace {

constexpr std::size_t kMostRanges = 8192;

}  // namespace

LogSummary::LogSummary(const std::string& path, const logging::LogHeader& header)
    : frames_(path, header), finder_(frames_.channels(), logging::body_names(header)) {
  if (frames_.num_lost() > 0) {
    damage_.push_back(std::to_string(frames_.num_lost()) +
                      (frames_.num_lost() == 1
                           ? " piece of the log can't be read, nor from when it is"
                           : " pieces of the log can't be read, nor from when they are"));
  }
  thread_ = std::thread([this] { run(); });
}

LogSummary::~LogSummary() {
  stopping_ = true;
  thread_.join();
}

void LogSummary::run() {
  become_background("log-summary");
  for (std::size_t chunk = 0; chunk < frames_.num_chunks() && !stopping_; ++chunk) {
    const auto read = frames_.chunk(chunk);
    const std::lock_guard lock(mutex_);
    add(*read);
  }
  if (stopping_) return;
  if (!frames_.complete()) add_end();
  known_ = frames_.end_tick();
}

void LogSummary::add_end() {
  const double time = frames_.period() * (frames_.end_tick() - 1);
  const std::lock_guard lock(mutex_);
  events_.push_back(
      text_event(time, "damage", formatted("%.4f s: ", time) + std::string(kNeverClosed)));
}

void LogSummary::add(const LogChunk& chunk) {
  add_damage(chunk);
  for (const logged::Change& change : chunk.changes) add(change);
  for (const ViewFrame& frame : chunk.frames) {
    for (const std::string& event : finder_.see(frame)) events_.push_back(event);
    add(frame);
  }
  if (!chunk.frames.empty()) known_ = chunk.frames.back().tick + 1;
}

void LogSummary::add_damage(const LogChunk& chunk) {
  const auto tell = [&](const char* what, const std::string& why) {
    if (why.empty()) return;
    std::ostringstream text;
    text << std::fixed << std::setprecision(4) << what << chunk.from << " s to " << chunk.to
         << " s can't be read: " << why;
    damage_.push_back(text.str());
    events_.push_back(text_event(chunk.from, "damage", text.str()));
  };
  tell(chunk.frames.empty() ? "" : "some ticks of ", chunk.problem);
  tell("timings of ", chunk.timing_problem);
}

std::size_t LogSummary::place(std::uint32_t tick) const {
  return (std::max(tick, frames_.first_tick()) - frames_.first_tick()) / stretch_;
}

void LogSummary::add(const ViewFrame& frame) {
  while (place(frame.tick) >= kMostRanges) coarsen();
  const std::size_t number = place(frame.tick);
  while (ranges_.size() <= number) ranges_.emplace_back().all.clear(frame.floats.size());
  Range& range = ranges_[number];
  if (range.first.floats.empty()) range.first = frame;
  range.all.add(frame.floats);
}

void LogSummary::coarsen() {
  for (std::size_t i = 0; i < ranges_.size(); i += 2) {
    Range& range = ranges_[i];
    if (i + 1 < ranges_.size()) {
      range.all.add(ranges_[i + 1].all);
      if (range.first.floats.empty()) range.first = std::move(ranges_[i + 1].first);
    }
    if (i > 0) ranges_[i / 2] = std::move(range);
  }
  ranges_.resize((ranges_.size() + 1) / 2);
  stretch_ *= 2;
}

void LogSummary::add(const logged::Change& change) {
  finder_.acts(change);
  events_.push_back(text_event(change.time, "change", change.text));
  if (change.stack.empty()) return;
  try {
    add_order(change);
  } catch (const Error& error) {
    damage_.push_back("the order of the levels after a change can't be read: " +
                      std::string(error.what()));
  }
}

void LogSummary::add_order(const logged::Change& change) {
  ViewOrder order{static_cast<std::uint32_t>(std::llround(change.time / frames_.period())), {}};
  const config::ConfigNode tree = config::parse_yaml(change.stack, "/changes");
  const config::ConfigNode* levels = tree.find("levels");
  for (std::size_t i = 0; levels != nullptr && i < levels->items.size(); ++i) {
    const config::ConfigNode* name = levels->items[i].find("name");
    if (name != nullptr) order.levels.push_back(name->text);
  }
  orders_.push_back(std::move(order));
}

std::uint32_t LogSummary::stretch() {
  const std::lock_guard lock(mutex_);
  return stretch_;
}

bool LogSummary::range(std::uint32_t first, std::uint32_t last, FrameRange& range) {
  if (last < frames_.first_tick() || std::min(last, frames_.end_tick() - 1) >= known_) return false;
  const std::lock_guard lock(mutex_);
  range.clear(frames_.channels().floats);
  for (std::size_t i = place(first); i <= place(last) && i < ranges_.size(); ++i) {
    range.add(ranges_[i].all);
  }
  return true;
}

bool LogSummary::frame_near(std::uint32_t tick, ViewFrame& frame) {
  const std::lock_guard lock(mutex_);
  const std::size_t number = place(tick);
  if (number >= ranges_.size() || ranges_[number].first.floats.empty()) return false;
  frame = ranges_[number].first;
  return true;
}

std::vector<std::string> LogSummary::damage() {
  const std::lock_guard lock(mutex_);
  return damage_;
}

std::string LogSummary::events_json() {
  const std::lock_guard lock(mutex_);
  return json_list(events_);
}

std::vector<ViewOrder> LogSummary::orders() {
  const std::lock_guard lock(mutex_);
  return orders_;
}

}  // namespace surefoot::server
