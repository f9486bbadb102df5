#include "server/log_frames.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/evaluation/alignment_fields.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/mcap_format.hpp"
#include "surefoot/logging/message_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace surefoot::server {
namespace {

constexpr std::size_t kKeptChunks = 32;
constexpr double kMostTicks = std::numeric_limits<std::uint32_t>::max();

/// A tick that is being read, message by message.
struct GrowingTick {
  explicit GrowingTick(const logging::LogRobot& of) : robot(of) {
    size_joints(record, std::ssize(robot.joint_names), robot.num_legs);
  }

  const logging::LogRobot& robot;
  TickRecord record;
  logged::Hierarchy hierarchy;
  simulation::GroundTruth truth;
  evaluation::Alignment alignment;  // a log from before it has none
  bool has_begin = false, has_end = false, has_truth = false, is_damaged = false;

  /// A tick begins with its readings and ends with its command; either may be lost.
  [[nodiscard]] bool is_whole() const { return has_begin && has_end && !is_damaged; }

  /// Throws JsonError where the message is malformed.
  void take(const logging::McapMessage& message) {
    const std::string& topic = message.channel->topic;
    has_begin = has_begin || topic == "/readings";
    has_end = has_end || topic == "/command";
    if (logging::decode_signal(message, robot, record)) return;
    if (topic == "/hierarchy") {
      logged::Decoder::decode(message.data, hierarchy);
      record.hierarchy.status = hierarchy.status;
    }
    if (topic == "/truth") {
      logged::Decoder::decode(message.data, truth, robot.num_legs);
      logged::check_joints(truth, robot.joint_names.size());
    }
    has_truth = has_truth || topic == "/truth";
    if (topic == "/alignment") logged::Decoder::decode(message.data, alignment);
  }
};

std::string text_of(const logging::McapMessage& message, const logging::JsonError& error) {
  return "a message on " + message.channel->topic + " is not what it should be: " + error.what();
}

double seconds(std::uint64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

}  // namespace

struct LogFrames::Decoded {
  explicit Decoded(const logging::LogRobot& of) : robot(of) {}

  const logging::LogRobot& robot;
  std::map<std::uint64_t, GrowingTick> ticks;  // by log time
  std::map<std::uint64_t, logged::Timing> timings;

  /// A malformed message costs its tick, or the timings of it.
  void take(const logging::McapMessage& message, LogChunk& chunk);
  void take_timing(const logging::McapMessage& message, LogChunk& chunk);
};

void LogFrames::Decoded::take(const logging::McapMessage& message, LogChunk& chunk) {
  if (message.channel->topic == "/timings") return take_timing(message, chunk);
  GrowingTick& tick = ticks.try_emplace(message.log_time, robot).first->second;
  try {
    tick.take(message);
    if (message.channel->topic != "/changes") return;
    logged::Change change;
    logged::Decoder::decode(message.data, change);
    chunk.changes.push_back(std::move(change));
  } catch (const logging::JsonError& error) {
    tick.is_damaged = true;
    chunk.problem = text_of(message, error);
  }
}

void LogFrames::Decoded::take_timing(const logging::McapMessage& message, LogChunk& chunk) {
  try {
    logged::Timing timing;
    logged::Decoder::decode(message.data, timing);
    timings[message.log_time] = timing;
  } catch (const logging::JsonError& error) {
    chunk.timing_problem = text_of(message, error);
  }
}

std::string without_path(const std::string& text, const std::string& path) {
  const std::string prefix = path + ": ";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

LogFrames::LogFrames(const std::string& path, const logging::LogHeader& header)
    : path_(path),
      file_(path),
      period_(header.control_period),
      robot_(header.robot),
      cone_(explain::friction_cone_of(header)) {
  if (!(period_ > 0.0)) throw FileError(path + ": the header's control_period is no time");
  channels_.level_names = header.level_names;
  find_ticks(path);
  learn_channels(path, header);
}

std::uint32_t LogFrames::tick_at(std::uint64_t time) const {
  return static_cast<std::uint32_t>(std::llround(seconds(time) / period_));
}

// A message outside of chunks has no checksum for its time. It is wrong if it is far beyond those
// of its neighbours; after a jump of the clock, the next ticks would continue from it.
bool LogFrames::has_wrong_times(std::size_t chunk) const {
  const std::vector<logging::McapChunk>& all = file_.chunks();
  const auto [first, last] = std::pair(all[chunk].first_time, all[chunk].last_time);
  const bool can_be = all[chunk].has_sure_times || logging::mcap::can_be_times(first, last);
  if (!can_be || seconds(last) / period_ >= kMostTicks) return true;
  if (!all[chunk].is_bare || first != last || first < logging::mcap::kMaxChunkTime) return false;
  const std::uint64_t least = first - logging::mcap::kMaxChunkTime;
  if (!places_.empty()) return places_.back().last < least;
  return chunk + 1 < all.size() && all[chunk + 1].first_time < least;
}

// Ticks are sorted by time. Where it goes back, the timings begin, usually in their own chunks;
// another writer may put the last ticks and the first timings into one. A chunk with impossible
// times has a damaged header and is left out.
void LogFrames::find_ticks(const std::string& path) {
  num_lost_ = file_.num_lost();
  for (std::size_t i = 0; i < file_.chunks().size(); ++i) {
    const logging::McapChunk& chunk = file_.chunks()[i];
    if (has_wrong_times(i)) {
      ++num_lost_;
      continue;
    }
    usable_.push_back(i);
    if (places_.empty() || chunk.last_time > places_.back().last) {
      places_.push_back({.chunk = i,
                         .before = places_.empty() ? 0 : places_.back().last,
                         .last = chunk.last_time,
                         .has_before = !places_.empty()});
      ends_.push_back(tick_at(chunk.last_time) + 1);
    }
  }
  if (ends_.empty()) {
    throw FileError(path + ": the log " + (file_.complete() ? "" : "is cut off, and ") +
                    "holds no ticks; record the run anew");
  }
  if (num_lost_ == 0) first_tick_ = tick_at(file_.chunks()[places_[0].chunk].first_time);
  end_tick_ = ends_.back();
}

// Uses the first readable place with a whole tick, whose truth has the sizes of MuJoCo's vectors.
void LogFrames::learn_channels(const std::string& path, const logging::LogHeader& header) {
  simulation::GroundTruth truth;
  bool is_whole = false;
  std::string problem;
  for (std::size_t i = 0; i < places_.size() && !is_whole; ++i) {
    Decoded decoded(robot_);
    LogChunk unused;
    read_place(i, decoded, unused);
    if (!unused.problem.empty()) problem = "; " + unused.problem;
    for (const auto& [time, tick] : decoded.ticks) {
      if (tick.has_truth) truth = tick.truth;
      is_whole = is_whole || tick.is_whole();
    }
  }
  if (!is_whole) {
    throw FileError(path + ": the log holds no whole tick; record the run anew" + problem);
  }
  channels_ = tick_channels(header, truth);
  find_start();
  for (std::size_t i = ends_.size(); i > 0; --i) {  // the last may be cut off
    const auto last = chunk(i - 1);
    if (last->frames.empty()) continue;
    end_tick_ = last->frames.back().tick + 1;
    return;
  }
  throw FileError(path + ": no tick of the log can be read; record the run anew" + problem);
}

void LogFrames::find_start() {
  Decoded decoded(robot_);
  LogChunk unused;
  read_place(0, decoded, unused);
  if (decoded.ticks.empty()) return;
  first_tick_ = std::min(first_tick_, tick_at(decoded.ticks.begin()->first));
  const GrowingTick& first = decoded.ticks.begin()->second;
  const bool is_dropped = std::ranges::any_of(decoded.ticks, [](const auto& entry) {
    return evaluation::estimate_restarts(entry.second.record);
  });
  if (first.is_whole() && first.has_truth && !is_dropped)
    start_ = evaluation::start_alignment(first.truth, first.record.state);
}

std::size_t LogFrames::chunk_of(std::uint32_t tick) const {
  const auto found = std::ranges::upper_bound(ends_, tick);
  return std::min(static_cast<std::size_t>(found - ends_.begin()), ends_.size() - 1);
}

LogChunk LogFrames::decode(std::size_t number) {
  const Place& place = places_[number];
  LogChunk chunk;
  chunk.from = seconds(std::max(place.before, file_.chunks()[place.chunk].first_time));
  chunk.to = seconds(place.last);
  Decoded decoded(robot_);
  read_place(number, decoded, chunk);
  for (const auto& [time, tick] : decoded.ticks) {
    if (!tick.is_whole()) continue;
    const auto timing = decoded.timings.find(time);
    to_frame({.number = tick_at(time),
              .record = tick.record,
              .hierarchy = tick.hierarchy,
              .cone = cone_,
              .truth = tick.has_truth ? &tick.truth : nullptr,
              .timing = timing == decoded.timings.end() ? nullptr : &timing->second,
              .alignment = &tick.alignment,
              .start = start_ ? &*start_ : nullptr},
             channels_, chunk.frames.emplace_back());
  }
  return chunk;
}

// Messages of a place may be in any chunk: a tick may begin or end in the next one, and timings are
// separate. Damage in the chunks of other places is reported there.
void LogFrames::read_place(std::size_t number, Decoded& decoded, LogChunk& chunk) {
  const Place& place = places_[number];
  for (const std::size_t i : usable_) {
    const logging::McapChunk& one = file_.chunks()[i];
    const bool is_before = place.has_before && one.last_time <= place.before;
    if (is_before || one.first_time > place.last) continue;
    try {
      read_chunk(i, place, decoded, chunk);
    } catch (const Error& error) {
      const bool has_ticks = std::ranges::find(places_, i, &Place::chunk) != places_.end();
      if (i == place.chunk) chunk.problem = without_path(error.what(), path_);
      if (!has_ticks)
        chunk.timing_problem = without_path(error.what(), path_);  // the ticks are good
    }
  }
}

void LogFrames::read_chunk(std::size_t index, const Place& place, Decoded& decoded,
                           LogChunk& chunk) {
  file_.read(index, [&](const logging::McapMessage& message) {
    const std::uint64_t time = message.log_time;
    if ((place.has_before && time <= place.before) || time > place.last) return;
    decoded.take(message, chunk);
  });
}

std::shared_ptr<const LogChunk> LogFrames::chunk(std::size_t number) {
  const auto known =
      std::ranges::find(recent_, number, [](const auto& entry) { return entry.first; });
  if (known != recent_.end()) {
    recent_.splice(recent_.begin(), recent_, known);
    return recent_.front().second;
  }
  recent_.emplace_front(number, std::make_shared<LogChunk>(decode(number)));
  if (recent_.size() > kKeptChunks) recent_.pop_back();
  return recent_.front().second;
}

const ViewFrame* LogFrames::frame(std::uint32_t tick) {
  const std::vector<ViewFrame>& frames = chunk(chunk_of(tick))->frames;
  const auto found = std::ranges::lower_bound(frames, tick, {}, &ViewFrame::tick);
  return found == frames.end() || found->tick != tick ? nullptr : &*found;
}

}  // namespace surefoot::server
