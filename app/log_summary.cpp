#include "app/log_summary.hpp"

#include "surefoot/config/config_tree.hpp"
#include "surefoot/logging/json_text.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr std::size_t kMostRanges = 2048;

void widen(const std::vector<float>& values, std::vector<float>& bound, auto&& wider) {
  for (std::size_t i = 0; i < bound.size(); ++i) bound[i] = wider(bound[i], values[i]);
}

// What is not a number is passed over.
float less(float a, float b) { return std::fmin(a, b); }
float more(float a, float b) { return std::fmax(a, b); }

std::size_t offset_of(const ViewChannels& channels, std::string_view name) {
  const auto found = std::ranges::find(channels.channels, name, &ViewChannel::name);
  return found == channels.channels.end() ? 0 : found->offset;
}

std::string text_event(double time, std::string_view text) {
  std::string out;
  JsonText(out).object().member("time", time).member("text", text).end_object();
  return out;
}

std::string_view name_in(const auto& names, float number) {
  const auto index = static_cast<std::size_t>(std::max(number, 0.0F));
  return index < names.size() ? names[index] : std::string_view("unknown");
}

}  // namespace

LogSummary::LogSummary(const std::string& path, const LogHeader& header)
    : frames_(path, header),
      event_(offset_of(frames_.channels(), "plan.event")),
      mode_(offset_of(frames_.channels(), "command.mode")),
      cause_(offset_of(frames_.channels(), "command.cause")) {
  for (const std::string_view leg : kLegNames) {
    phases_.push_back(offset_of(frames_.channels(), "plan.feet." + std::string(leg) + ".phase"));
  }
  thread_ = std::thread([this] { run(); });
}

LogSummary::~LogSummary() {
  stopping_ = true;
  thread_.join();
}

void LogSummary::run() {
  for (std::size_t chunk = 0; chunk < frames_.num_chunks() && !stopping_; ++chunk) {
    LogFrames::Changes changes;
    const auto frames = frames_.chunk(chunk, &changes);
    const std::lock_guard lock(mutex_);
    for (const logged::Change& change : changes) add(change);
    for (const ViewFrame& frame : *frames) {
      add_events(frame);
      add(frame);
    }
    if (!frames->empty()) known_ = frames->back().tick + 1;
  }
  if (!stopping_) known_ = frames_.ticks();
}

void LogSummary::add(const ViewFrame& frame) {
  while (frame.tick / stretch_ >= kMostRanges) coarsen();
  const std::size_t place = frame.tick / stretch_;
  while (ranges_.size() <= place) {
    ranges_.push_back({std::vector<float>(frame.floats.size(), NAN),
                       std::vector<float>(frame.floats.size(), NAN)});
  }
  widen(frame.floats, ranges_[place].least, less);
  widen(frame.floats, ranges_[place].greatest, more);
}

void LogSummary::coarsen() {
  for (std::size_t i = 0; i < ranges_.size(); i += 2) {
    Range& range = ranges_[i];
    if (i + 1 < ranges_.size()) {
      widen(ranges_[i + 1].least, range.least, less);
      widen(ranges_[i + 1].greatest, range.greatest, more);
    }
    if (i > 0) ranges_[i / 2] = std::move(range);
  }
  ranges_.resize((ranges_.size() + 1) / 2);
  stretch_ *= 2;
}

void LogSummary::add_events(const ViewFrame& frame) {
  const std::vector<float>& now = frame.floats;
  const bool has_last = last_.size() == now.size();
  if (now[event_] != 0.0F) {
    std::string_view leg;
    for (std::size_t k = 0; has_last && k < phases_.size(); ++k) {
      if (now[phases_[k]] != last_[phases_[k]]) leg = kLegNames[k];
    }
    std::string& text = events_.emplace_back();
    JsonText json(text);
    json.array().value(frame.time).value(static_cast<int>(now[event_]));
    leg.empty() ? json.null() : json.value(leg);
    json.end_array();
  }
  if (has_last && now[mode_] != last_[mode_]) {
    std::string text = "command mode: " + std::string(name_in(logged::kModeNames, now[mode_]));
    if (now[cause_] != 0.0F) {
      text += ", cause: " + std::string(name_in(logged::kCauseNames, now[cause_]));
    }
    events_.push_back(text_event(frame.time, text));
  }
  last_ = now;
}

void LogSummary::add(const logged::Change& change) {
  events_.push_back(text_event(change.time, change.text));
  if (change.stack.empty()) return;
  ViewOrder order{static_cast<std::uint32_t>(std::llround(change.time / frames_.period())), {}};
  const ConfigNode tree = parse_yaml(change.stack, "/changes");
  const ConfigNode* levels = tree.find("levels");
  for (std::size_t i = 0; levels != nullptr && i < levels->items.size(); ++i) {
    const ConfigNode* name = levels->items[i].find("name");
    if (name != nullptr) order.levels.push_back(name->text);
  }
  orders_.push_back(std::move(order));
}

std::uint32_t LogSummary::stretch() {
  const std::lock_guard lock(mutex_);
  return stretch_;
}

bool LogSummary::range(std::uint32_t first, std::uint32_t last, std::vector<float>& least,
                       std::vector<float>& greatest) {
  if (std::min(last, frames_.ticks() - 1) >= known_) return false;
  const std::lock_guard lock(mutex_);
  least.assign(frames_.channels().floats, NAN);
  greatest = least;
  for (std::size_t i = first / stretch_; i <= last / stretch_ && i < ranges_.size(); ++i) {
    widen(ranges_[i].least, least, less);
    widen(ranges_[i].greatest, greatest, more);
  }
  return true;
}

std::string LogSummary::events_json() {
  const std::lock_guard lock(mutex_);
  std::string text = "[";
  for (const std::string& event : events_) text += (text.size() > 1 ? "," : "") + event;
  return text + "]";
}

std::vector<ViewOrder> LogSummary::orders() {
  const std::lock_guard lock(mutex_);
  return orders_;
}

}  // namespace surefoot
