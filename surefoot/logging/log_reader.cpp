#include "surefoot/logging/log_reader.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/log_header_reader.hpp"
#include "surefoot/logging/logged_timing.hpp"
#include "surefoot/logging/message_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

namespace surefoot::logging {
namespace {

constexpr std::string_view kHeaderName = "header.json";
constexpr std::string_view kSummaryName = "summary.json";

/// Levels by their numbers in the header, in any order at the tick; levels missing there by their
/// place in the message.
class LevelNumbers {
 public:
  LevelNumbers(const std::vector<std::string>& header, const logged::Hierarchy& named)
      : header_(header), named_(named) {}

  [[nodiscard]] std::int16_t of(const std::string& level) const {
    const auto found = std::ranges::find(header_, level);
    if (found != header_.end()) return static_cast<std::int16_t>(found - header_.begin());
    const auto in_message = std::ranges::find(named_.levels, level, &logged::Level::name);
    return static_cast<std::int16_t>(in_message - named_.levels.begin());
  }

 private:
  const std::vector<std::string>& header_;
  const logged::Hierarchy& named_;
};

void add_blockers(const logged::Hierarchy& named, const LevelNumbers& numbers,
                  HierarchyReport& report) {
  report.blocking_is_known = named.blocking_is_known;
  const std::size_t count = std::min(named.blocked_by.size(), kMaxReportedBlockers);
  report.num_blocking = static_cast<std::int32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const logged::BlockingRow& row = named.blocked_by[i];
    report.blocking[i] = row.report;
    report.blocking[i].level = numbers.of(row.level);
    report.blocking[i].by_level = numbers.of(row.by);
  }
}

void set_change(const std::vector<std::string>& names, LevelChange change,
                const logged::Hierarchy& named, const LevelNumbers& numbers,
                LevelSwitchReport& report) {
  for (const std::string& name : names) {
    const auto level = static_cast<std::size_t>(numbers.of(name));
    if (level >= std::min(named.levels.size(), report.change.size()))
      throw JsonError{"a switch of the level \"" + name + "\", which is none of the levels"};
    report.change[level] = change;
  }
}

void add_switch(const logged::Hierarchy& named, const LevelNumbers& numbers,
                HierarchyReport& report) {
  report.transition_share = named.transition_share;
  if (named.level_switches.empty()) return;
  const logged::LevelSwitch& change = named.level_switches.front();
  report.level_switch.begins = true;
  report.level_switch.duration = change.duration;
  set_change(change.add, LevelChange::comes, named, numbers, report.level_switch);
  set_change(change.remove, LevelChange::goes, named, numbers, report.level_switch);
}

/// After an early stop the level it happened in, and those below, have no residual.
void forget_unsolved(const logged::Hierarchy& named, const LevelNumbers& numbers,
                     HierarchyReport& report) {
  if (named.status != kIterationCap || named.failed_level < 0) return;
  for (auto i = static_cast<std::size_t>(named.failed_level); i < named.levels.size(); ++i) {
    const auto number = static_cast<std::size_t>(numbers.of(named.levels[i].name));
    if (number < report.levels.size()) report.levels[number].residual = kNaN;
  }
}

HierarchyReport without_names(const logged::Hierarchy& named,
                              const std::vector<std::string>& header) {
  const LevelNumbers numbers(header, named);
  HierarchyReport report;
  report.status = named.status;
  const auto failed = static_cast<std::size_t>(named.failed_level);
  report.failed_level = named.failed_level;
  if (named.failed_level >= 0) {
    report.failed_level = failed < named.levels.size() ? numbers.of(named.levels[failed].name)
                                                       : static_cast<std::int32_t>(kMaxLevels);
  }
  report.borderline = named.borderline;
  report.num_levels = static_cast<std::int32_t>(std::min(named.levels.size(), kMaxLevels));
  report.num_active = static_cast<std::int32_t>(std::min(named.active.size(), kMaxReportedRows));
  for (std::size_t i = 0; i < static_cast<std::size_t>(report.num_levels); ++i) {
    const auto number = static_cast<std::size_t>(numbers.of(named.levels[i].name));
    if (number < report.levels.size()) report.levels[number] = named.levels[i].report;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(report.num_active); ++i) {
    const logged::Row& row = named.active[i];
    report.active[i] = {.level = numbers.of(row.level),
                        .state = static_cast<std::int16_t>(row.state),
                        .id = row.id,
                        .by = row.by};
  }
  report.num_missed = static_cast<std::int32_t>(std::min(named.missed.size(), kMaxReportedMisses));
  for (std::size_t i = 0; i < static_cast<std::size_t>(report.num_missed); ++i) {
    const logged::MissedRow& row = named.missed[i];
    report.missed[i] = {.level = numbers.of(row.level), .id = row.id, .by = row.by};
  }
  forget_unsolved(named, numbers, report);
  add_blockers(named, numbers, report);
  add_switch(named, numbers, report);
  return report;
}

template <typename T>
struct SignalTopic {
  std::string_view name;
  T TickRecord::* signal;
};

constexpr std::tuple kSignals{
    SignalTopic{"/readings", &TickRecord::reading}, SignalTopic{"/health", &TickRecord::health},
    SignalTopic{"/user", &TickRecord::user},        SignalTopic{"/state", &TickRecord::state},
    SignalTopic{"/plan", &TickRecord::plan},        SignalTopic{"/model", &TickRecord::model},
    SignalTopic{"/command", &TickRecord::command},
};

bool is_signal(std::string_view topic) {
  return std::apply([&](const auto&... one) { return ((topic == one.name) || ...); }, kSignals);
}

/// A channel of the recorder.
bool is_own(std::string_view topic) {
  return is_signal(topic) || topic == "/hierarchy" || topic == "/timings";
}

}  // namespace

bool decode_signal(const McapMessage& message, const LogRobot& robot, TickRecord& tick) {
  const auto decode = [&](const auto& one) {
    if (message.channel->topic != one.name) return false;
    logged::Decoder::decode(message.data, tick.*one.signal, robot.num_legs);
    logged::check_joints(tick.*one.signal, robot.joint_names.size());
    return true;
  };
  return std::apply([&](const auto&... one) { return (decode(one) || ...); }, kSignals);
}

LogReader::LogReader(const std::string& path, Other other)
    : path_(path), file_(path), other_(std::move(other)) {
  const auto header = file_.attachments().find(std::string(kHeaderName));
  if (header == file_.attachments().end()) refuse_without_header();
  header_ = read_log_header(path, header->second);
  clock_ = TickClock(header_.control_period);
  for (const auto& [name, data] : file_.attachments()) {
    if (name != kHeaderName && name != kSummaryName)
      header_.attachments.push_back({name, "", data});
  }
}

void LogReader::refuse_without_header() const {
  if (file_.damage().empty()) {
    throw FileError(
        path_ +
        ": an MCAP file, but it does not begin with a header of surefoot; a log made by "
        "surefoot would be valid");
  }
  const std::string lost = path_ + ": " + file_.damage();
  if (file_.losses().empty())
    throw FileError(lost +
                    ", before its header was whole, so that nothing of the run can be read; "
                    "record the run anew");
  throw FileError(lost +
                  ", so that its header.json is lost, which says what run it is; the messages in "
                  "it can be read by other readers of MCAP, but not by surefoot: record the run "
                  "anew");
}

void LogReader::skip_until(double time) {
  skipped_until_ = time > 0.0 ? static_cast<std::uint64_t>(std::llround(1e9 * time)) : 0;
}

bool LogReader::next(TickRecord& tick) {
  size_joints(tick, std::ssize(header_.robot.joint_names), header_.robot.num_legs);
  McapMessage message;
  try {
    while (file_.next(message)) {
      const bool is_other = !is_own(message.channel->topic);
      if (message.log_time < skipped_until_ && !is_other) continue;
      if (is_rest_of_lost_tick(message)) continue;
      if (take(message, tick)) return end_tick(message.log_time);
    }
  } catch (const JsonError& error) {
    throw FileError(path_ + ": a message on " + message.channel->topic +
                    " is not what it should be: " + error.what());
  }
  return false;
}

// A lost part may contain the start of a tick; the next tick starts with its readings.
bool LogReader::is_rest_of_lost_tick(const McapMessage& message) {
  if (known_losses_ != file_.losses().size()) in_lost_tick_ = true;
  for (; known_losses_ < file_.losses().size(); ++known_losses_) {
    const McapLoss& loss = file_.losses()[known_losses_];
    if (loss.may_hold_messages) clock_.lose(first_time(loss));
  }
  const std::string& topic = message.channel->topic;
  if (topic == "/readings") in_lost_tick_ = false;
  return in_lost_tick_ && (topic == "/hierarchy" || is_signal(topic));
}

bool LogReader::end_tick(std::uint64_t time) {
  clock_.add(1e-9 * static_cast<double>(time));
  tick_time_ = time;
  return true;
}

// Timings follow all ticks, one a tick.
bool LogReader::may_go_on() const {
  const std::uint64_t last = tick_time_.value_or(0);
  const bool has_timings = !timings_.empty();
  if (has_timings && latest_timing() > last) return true;
  const bool may_hold_ticks = std::ranges::any_of(file_.losses(), [&](const McapLoss& loss) {
    return loss.may_hold_messages && (loss.has_times ? loss.last_time > last : !has_timings);
  });
  return may_hold_ticks || (!file_.has_all_data() && !has_timings);
}

std::uint64_t LogReader::latest_timing() const {
  return static_cast<std::uint64_t>(std::llround(1e9 * timings_.back().time));
}

// True when the message completes a tick.
bool LogReader::take(const McapMessage& message, TickRecord& tick) {
  const std::string& topic = message.channel->topic;
  if (decode_signal(message, header_.robot, tick)) return topic == "/command";
  if (topic == "/hierarchy") {
    logged::Hierarchy named;
    logged::Decoder::decode(message.data, named);
    tick.hierarchy = without_names(named, header_.level_names);
    level_order_.clear();
    const LevelNumbers numbers(header_.level_names, named);
    for (const logged::Level& level : named.levels) {
      const std::int16_t number = numbers.of(level.name);
      if (static_cast<std::size_t>(number) < kMaxLevels) level_order_.push_back(number);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(tick.hierarchy.num_active); ++i) {
      const ActiveRow& row = tick.hierarchy.active[i];
      row_names_.try_emplace({row.level, row.id}, named.active[i].row);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(tick.hierarchy.num_missed); ++i) {
      const MissedEquality& row = tick.hierarchy.missed[i];
      row_names_.try_emplace({row.level, row.id}, named.missed[i].row);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(tick.hierarchy.num_blocking); ++i) {
      const BlockingRow& row = tick.hierarchy.blocking[i];
      row_names_.try_emplace({row.by_level, row.id}, named.blocked_by[i].row);
    }
  } else if (topic == "/timings") {
    logged::Timing named;
    logged::Decoder::decode(message.data, named);
    timings_.push_back(logged::timing_from(named, header_.level_names));
  } else if (other_) {
    other_(message);
  }
  return false;
}

std::string LogReader::summary() const {
  const auto summary = file_.attachments().find(std::string(kSummaryName));
  return summary == file_.attachments().end() ? "" : summary->second;
}

}  // namespace surefoot::logging
