#include "app/log_frames.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/mcap_format.hpp"
#include "surefoot/logging/message_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot {
namespace {

constexpr std::size_t kKeptChunks = 32;

/// A tick as its messages come.
struct GrowingTick {
  TickRecord record;
  logged::Hierarchy hierarchy;
  GroundTruth truth;
  bool is_whole = false, has_truth = false, is_damaged = false;

  /// Throws JsonError where the message is not what it should be.
  void take(const McapMessage& message) {
    const std::string& topic = message.channel->topic;
    is_whole = is_whole || topic == "/command";
    if (decode_signal(message, record)) return;
    if (topic == "/hierarchy") logged::Decoder::decode(message.data, hierarchy);
    if (topic == "/truth") logged::Decoder::decode(message.data, truth);
    has_truth = has_truth || topic == "/truth";
  }
};

double seconds(std::uint64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

}  // namespace

struct LogFrames::Decoded {
  std::map<std::uint64_t, GrowingTick> ticks;  // by log time
  std::map<std::uint64_t, logged::Timing> timings;
  std::string timing_problem;
};

LogFrames::LogFrames(const std::string& path, const LogHeader& header)
    : path_(path), file_(path), period_(header.control_period), cone_(friction_cone_of(header)) {
  if (!(period_ > 0.0)) throw FileError(path + ": the header's control_period is no time");
  channels_.level_names = header.level_names;
  find_ticks(path);
  learn_channels(path);
}

std::uint32_t LogFrames::tick_at(std::uint64_t time) const {
  return static_cast<std::uint32_t>(std::llround(seconds(time) / period_));
}

// Ticks come by their time; where it goes back the timings begin, which stand apart. A chunk whose
// times can't be is left out: its header is damaged.
void LogFrames::find_ticks(const std::string& path) {
  num_lost_ = file_.num_lost();
  for (std::size_t i = 0; i < file_.chunks().size(); ++i) {
    const McapChunk& chunk = file_.chunks()[i];
    if (!mcap::can_be_times(chunk.first_time, chunk.last_time)) {
      ++num_lost_;
    } else if (!timings_.empty() ||
               (!places_.empty() && chunk.first_time <= place(places_.size() - 1).first_time)) {
      timings_.push_back(i);
    } else {
      places_.push_back(i);
      ends_.push_back(tick_at(chunk.last_time) + 1);
    }
  }
  if (ends_.empty()) {
    throw FileError(path + ": the log " + (file_.complete() ? "" : "is cut off, and ") +
                    "holds no ticks; record the run anew");
  }
  if (num_lost_ == 0) first_tick_ = tick_at(place(0).first_time);
  end_tick_ = ends_.back();
}

// From the first chunk that can be read and holds a whole tick, whose truth has the sizes of
// MuJoCo's vectors.
void LogFrames::learn_channels(const std::string& path) {
  GroundTruth truth;
  bool is_whole = false;
  std::string problem;
  for (std::size_t i = 0; i < ends_.size() && !is_whole; ++i) {
    GrowingTick tick;
    try {
      file_.read(places_[i], [&](const McapMessage& message) { tick.take(message); });
    } catch (const Error& error) {
      problem = "; " + without_path(error);
    }
    if (tick.has_truth) truth = tick.truth;
    is_whole = tick.is_whole;
  }
  if (!is_whole) {
    throw FileError(path + ": the log holds no whole tick; record the run anew" + problem);
  }
  channels_ = tick_channels(channels_.level_names, truth);
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
  Decoded decoded;
  LogChunk unused;
  read_ticks(0, decoded, unused);
  if (decoded.ticks.empty()) return;
  first_tick_ = std::min(first_tick_, tick_at(decoded.ticks.begin()->first));
  const GrowingTick& first = decoded.ticks.begin()->second;
  if (first.is_whole && !first.is_damaged && first.has_truth)
    start_ = start_alignment(first.truth, first.record.state);
}

std::size_t LogFrames::chunk_of(std::uint32_t tick) const {
  const auto found = std::ranges::upper_bound(ends_, tick);
  return std::min(static_cast<std::size_t>(found - ends_.begin()), ends_.size() - 1);
}

LogChunk LogFrames::decode(std::size_t number) {
  const McapChunk& span = place(number);
  LogChunk chunk;
  chunk.from = seconds(span.first_time);
  chunk.to = seconds(span.last_time);
  Decoded decoded;
  read_ticks(number, decoded, chunk);
  read_timings(span.first_time, span.last_time, decoded);
  chunk.timing_problem = decoded.timing_problem;
  for (const auto& [time, tick] : decoded.ticks) {
    if (!tick.is_whole || tick.is_damaged) continue;
    const auto timing = decoded.timings.find(time);
    to_frame({.number = tick_at(time),
              .record = tick.record,
              .hierarchy = tick.hierarchy,
              .cone = cone_,
              .truth = tick.has_truth ? &tick.truth : nullptr,
              .timing = timing == decoded.timings.end() ? nullptr : &timing->second,
              .start = start_ ? &*start_ : nullptr},
             channels_, chunk.frames.emplace_back());
  }
  return chunk;
}

// What a page is told says nothing of this machine's folders.
std::string LogFrames::without_path(const Error& error) const {
  const std::string text = error.what(), prefix = path_ + ": ";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

// A tick's messages may go on in the next chunk; then it belongs to the chunk where they begin.
void LogFrames::read_ticks(std::size_t number, Decoded& decoded, LogChunk& chunk) {
  const std::uint64_t last = place(number).last_time;
  const bool has_before = number > 0;
  const std::uint64_t before = has_before ? place(number - 1).last_time : 0;
  const auto take = [&](const McapMessage& message) {
    if ((has_before && message.log_time <= before) || message.log_time > last) return;
    GrowingTick& tick = decoded.ticks[message.log_time];
    try {
      tick.take(message);
      if (message.channel->topic != "/changes") return;
      logged::Change change;
      logged::Decoder::decode(message.data, change);
      chunk.changes.push_back(std::move(change));
    } catch (const JsonError& error) {
      tick.is_damaged = true;
      chunk.problem =
          "a message on " + message.channel->topic + " is not what it should be: " + error.what();
    }
  };
  try {
    file_.read(places_[number], take);
  } catch (const FileError& error) {
    chunk.problem = without_path(error);
  }
  const std::size_t next = number + 1;
  if (next == places_.size() || place(next).first_time != last) return;
  try {
    file_.read(places_[next], take);
  } catch (const FileError&) {  // told of that chunk
  }
}

void LogFrames::read_timings(std::uint64_t first, std::uint64_t last, Decoded& decoded) {
  for (const std::size_t chunk : timings_) {
    const McapChunk& place = file_.chunks()[chunk];
    if (place.last_time < first || place.first_time > last) continue;
    try {
      file_.read(chunk, [&](const McapMessage& message) {
        if (message.log_time < first || message.log_time > last) return;
        if (message.channel->topic != "/timings") return;
        logged::Timing timing;
        logged::Decoder::decode(message.data, timing);
        decoded.timings[message.log_time] = std::move(timing);
      });
    } catch (const Error& error) {  // the ticks are still good
      decoded.timing_problem = without_path(error);
    }
  }
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

}  // namespace surefoot
