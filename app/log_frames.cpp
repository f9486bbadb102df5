#include "app/log_frames.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
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
  bool is_whole = false, has_truth = false;

  void take(const McapMessage& message) {
    const std::string& topic = message.channel->topic;
    const auto decode = [&](auto& signal) { logged::Decoder::decode(message.data, signal); };
    if (topic == "/readings") decode(record.reading);
    if (topic == "/health") decode(record.health);
    if (topic == "/user") decode(record.user);
    if (topic == "/state") decode(record.state);
    if (topic == "/plan") decode(record.plan);
    if (topic == "/model") decode(record.model);
    if (topic == "/hierarchy") decode(hierarchy);
    if (topic == "/truth") decode(truth);
    if (topic == "/command") decode(record.command);
    is_whole = is_whole || topic == "/command";
    has_truth = has_truth || topic == "/truth";
  }
};

}  // namespace

struct LogFrames::Decoded {
  std::map<std::uint64_t, GrowingTick> ticks;  // by log time
  std::map<std::uint64_t, TickTiming> timings;
};

LogFrames::LogFrames(const std::string& path, const LogHeader& header)
    : file_(path), period_(header.control_period) {
  channels_.level_names = header.level_names;
  find_ticks(path);
  learn_channels(path);
}

std::uint32_t LogFrames::tick_at(std::uint64_t time) const {
  return static_cast<std::uint32_t>(std::llround(1e-9 * static_cast<double>(time) / period_));
}

// Ticks come by their time; where it goes back the timings begin, which stand apart.
void LogFrames::find_ticks(const std::string& path) {
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < file_.chunks().size(); ++i) {
    const McapChunk& chunk = file_.chunks()[i];
    if (!timings_.empty() || (i > 0 && chunk.first_time < last)) {
      timings_.push_back(i);
    } else {
      ends_.push_back(tick_at(chunk.last_time) + 1);
      last = chunk.last_time;
    }
  }
  if (ends_.empty()) {
    throw FileError(path + ": the log holds no ticks; record the run anew");
  }
  ticks_ = ends_.back();
}

// From the first chunks that hold a whole tick, whose truth has the sizes of MuJoCo's vectors.
void LogFrames::learn_channels(const std::string& path) {
  GroundTruth truth;
  bool is_whole = false;
  for (std::size_t i = 0; i < ends_.size() && !is_whole; ++i) {
    GrowingTick tick;
    file_.read(i, [&](const McapMessage& message) { tick.take(message); });
    if (tick.has_truth) truth = tick.truth;
    is_whole = tick.is_whole;
  }
  if (!is_whole) throw FileError(path + ": the log holds no whole tick; record the run anew");
  channels_ = tick_channels(channels_.level_names, truth);
  if (!timings_.empty()) file_.read(timings_.front(), [](const McapMessage&) {});
  for (std::size_t i = ends_.size(); i > 0; --i) {  // the last may be cut off
    const auto frames = chunk(i - 1);
    if (frames->empty()) continue;
    ticks_ = frames->back().tick + 1;
    break;
  }
}

std::size_t LogFrames::chunk_of(std::uint32_t tick) const {
  const auto found = std::ranges::upper_bound(ends_, tick);
  return std::min(static_cast<std::size_t>(found - ends_.begin()), ends_.size() - 1);
}

// A tick's messages may go on in the next chunk; then it belongs to the chunk where they begin.
LogFrames::Frames LogFrames::decode(std::size_t number, Changes* changes) {
  const std::vector<McapChunk>& places = file_.chunks();
  const std::uint64_t last = places[number].last_time;
  const bool has_before = number > 0;
  const std::uint64_t before = has_before ? places[number - 1].last_time : 0;
  Decoded decoded;
  const auto take = [&](const McapMessage& message) {
    if ((has_before && message.log_time <= before) || message.log_time > last) return;
    if (changes != nullptr && message.channel->topic == "/changes") {
      logged::Decoder::decode(message.data, changes->emplace_back());
    }
    decoded.ticks[message.log_time].take(message);
  };
  file_.read(number, take);
  const std::size_t next = number + 1;
  if (next < ends_.size() && places[next].first_time == last) file_.read(next, take);
  read_timings(places[number].first_time, last, decoded);

  Frames frames;
  for (const auto& [time, tick] : decoded.ticks) {
    if (!tick.is_whole) continue;
    const auto timing = decoded.timings.find(time);
    to_frame({.number = tick_at(time),
              .record = tick.record,
              .hierarchy = tick.hierarchy,
              .truth = tick.has_truth ? &tick.truth : nullptr,
              .timing = timing == decoded.timings.end() ? nullptr : &timing->second},
             channels_, frames.emplace_back());
  }
  return frames;
}

void LogFrames::read_timings(std::uint64_t first, std::uint64_t last, Decoded& decoded) {
  for (const std::size_t chunk : timings_) {
    const McapChunk& place = file_.chunks()[chunk];
    if (place.last_time < first || place.first_time > last) continue;
    file_.read(chunk, [&](const McapMessage& message) {
      if (message.log_time < first || message.log_time > last) return;
      if (message.channel->topic != "/timings") return;
      logged::Decoder::decode(message.data, decoded.timings[message.log_time]);
    });
  }
}

std::shared_ptr<const LogFrames::Frames> LogFrames::chunk(std::size_t number, Changes* changes) {
  const auto known =
      std::ranges::find(recent_, number, [](const auto& entry) { return entry.first; });
  if (known != recent_.end() && changes == nullptr) {
    recent_.splice(recent_.begin(), recent_, known);
    return recent_.front().second;
  }
  auto frames = std::make_shared<Frames>();
  try {
    *frames = decode(number, changes);
  } catch (const FileError&) {  // the rest of the log is still good
  } catch (const JsonError&) {
  }
  if (known == recent_.end()) recent_.emplace_front(number, frames);
  if (recent_.size() > kKeptChunks) recent_.pop_back();
  return frames;
}

const ViewFrame* LogFrames::frame(std::uint32_t tick) {
  const std::shared_ptr<const Frames> frames = chunk(chunk_of(tick));
  const auto found = std::ranges::lower_bound(*frames, tick, {}, &ViewFrame::tick);
  return found == frames->end() || found->tick != tick ? nullptr : &*found;
}

}  // namespace surefoot
