#include "app/live_feed.hpp"

#include "app/run_log.hpp"
#include "app/stack_text.hpp"
#include "app/view_tasks.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/logging/json_text.hpp"
#include "surefoot/view/web_answer.hpp"
#include "surefoot/view/web_guard.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace surefoot {
namespace {

constexpr std::size_t kRingTicks = 1024;
constexpr std::size_t kRecentFrames = 800;
constexpr std::chrono::milliseconds kStatusInterval{250};
constexpr std::chrono::milliseconds kMeasureInterval{1000};

std::string text_of_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void vector_member(JsonText& json, std::string_view name, const auto& vector) {
  json.key(name).array();
  for (const double number : vector) json.value(number);
  json.end_array();
}

void force_member(JsonText& json, std::string_view name, const OutsideForce& force,
                  const std::vector<std::string>& bodies) {
  json.key(name);
  if (force.body < 0) {
    json.null();
    return;
  }
  const std::string& body = bodies.at(static_cast<std::size_t>(force.body));
  json.object().member("body", std::string_view(body)).member("given", force.given);
  vector_member(json, "force", force.force);
  json.end_object();
}

}  // namespace

LiveFeed::LiveFeed(const Scenario& scenario, LiveOperator& wishes, std::string recording)
    : operator_(wishes),
      robot_(text_of_file(scenario.robot.urdf_path), scenario.robot.mesh_root),
      recording_(std::move(recording)) {
  session_.start = random_token();
  session_.mode = "live";
  session_.version = build_info().version;
  session_.title =
      scenario.name + (scenario.seed == 0 ? "" : ", seed " + std::to_string(scenario.seed));
  session_.period = scenario.controller.period;
  session_.meshes = robot_.meshes();
  session_.limits = wishes.limits();
  session_.can_command = true;
}

void LiveFeed::begin(const RunParts& parts, const StackOptions& stack, double friction) {
  auto channels =
      std::make_shared<ViewChannels>(tick_channels(parts.header.level_names, parts.plant.truth()));
  if (!ring_) {  // nobody serves yet
    ViewTick example;
    example.truth = parts.plant.truth();
    ring_.emplace(kRingTicks, example);
  }
  const std::lock_guard lock(mutex_);
  if (!packings_.empty()) ++generation_;
  session_.header = to_json(parts.header);
  session_.channels = *channels;
  session_.rows = parts.controller.row_names();
  session_.bodies = parts.plant.bodies();
  session_.orders = {{0, parts.header.level_names}};
  session_.tasks = view_tasks(stack, parts.header.level_names);
  session_.friction = friction;
  session_.generation = generation_;
  packings_[generation_] =
      std::make_shared<Packing>(Packing{std::move(channels), {parts.header.level_names, {}}});
  ended_.clear();
  is_news_ = true;
}

void LiveFeed::put(std::uint32_t number, const TickRecord& tick, const GroundTruth& truth,
                   const TickTiming& timing, const OutsideForces& forces) {
  ViewTick* place = ring_->next_to_write();
  if (place == nullptr) {
    ++lost_;
    return;
  }
  place->number = number;
  place->generation = generation_.load(std::memory_order_relaxed);
  place->lost = std::exchange(lost_, 0);
  place->record = tick;
  place->truth = truth;
  place->timing = timing;
  place->forces = forces;
  ring_->written();
}

void LiveFeed::set_control(const StackOptions& stack, double friction, std::uint32_t tick) {
  const std::lock_guard lock(mutex_);
  const Packing& before = *packings_.rbegin()->second;
  auto next = std::make_shared<Packing>(Packing{before.channels, {level_names(stack), {}}});
  session_.tasks = view_tasks(stack, session_.channels.level_names);
  session_.friction = friction;
  if (session_.orders.back().levels != next->names.levels) {
    session_.orders.push_back({tick, next->names.levels});
  }
  session_.generation = ++generation_;
  packings_[generation_] = std::move(next);
  is_news_ = true;
}

void LiveFeed::set_pace(bool paused, double speed) {
  paused_ = paused;
  speed_ = speed;
  is_news_ = true;
}

void LiveFeed::set_ended(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  ended_ = reason;
  is_news_ = true;
}

void LiveFeed::show(const logged::Change& change) {
  std::string text;
  JsonText(text)
      .object()
      .member("type", "change")
      .member("time", change.time)
      .member("kind", std::string_view(change.kind))
      .member("text", std::string_view(change.text))
      .end_object();
  const std::lock_guard lock(mutex_);
  outbox_.push_back(std::move(text));
  is_news_ = true;
}

void LiveFeed::tell(const std::string& notice) {
  std::string text;
  JsonText(text)
      .object()
      .member("type", "notice")
      .member("text", std::string_view(notice))
      .end_object();
  const std::lock_guard lock(mutex_);
  outbox_.push_back(std::move(text));
}

WebAnswer LiveFeed::get(std::string_view path, const Query&) {
  if (path == "/api/session") return {200, "application/json", session()};
  if (path == "/api/frames" || path == "/api/events") {
    return refusal(404, "only a log has these; a live run sends its frames to /api/live");
  }
  return robot_.get(path);
}

std::string LiveFeed::session() {
  ViewSession copy;
  {
    const std::lock_guard lock(mutex_);
    copy = session_;
  }
  copy.ticks = tick_;
  return to_json(copy);
}

std::shared_ptr<const LiveFeed::Packing> LiveFeed::packing(std::uint32_t generation) {
  const std::lock_guard lock(mutex_);
  packings_.erase(packings_.begin(), packings_.lower_bound(generation));
  return packings_.begin()->second;
}

std::vector<SharedBlock> LiveFeed::blocks() {
  std::vector<SharedBlock> blocks;
  std::shared_ptr<std::string> bytes;
  std::shared_ptr<const Packing> packing_now;
  for (const ViewTick* tick = ring_->next_to_read(); tick != nullptr;
       tick = ring_->next_to_read()) {
    if (blocks.empty() || blocks.back().generation != tick->generation) {
      packing_now = packing(tick->generation);
      bytes = std::make_shared<std::string>();
      blocks.push_back({.frames = 0, .generation = tick->generation, .lost = 0, .bytes = bytes});
    }
    HierarchyNamer namer(packing_now->names);
    if (tick->number < tick_) start_.reset();
    if (!start_) start_ = start_alignment(tick->truth, tick->record.state);
    to_frame({tick->number, tick->record, namer.name(tick->record.hierarchy), &tick->truth,
              &tick->timing, start_ ? &*start_ : nullptr},
             *packing_now->channels, frame_);
    pack(frame_, *bytes);
    ++blocks.back().frames;
    blocks.back().lost += tick->lost;
    if (tick->number == 0) recent_.clear();
    tick_ = tick->number + 1;
    time_ = tick->record.reading.time;
    user_ = tick->record.user;
    forces_ = tick->forces;
    ring_->read();
  }
  recent_.insert(recent_.end(), blocks.begin(), blocks.end());
  std::size_t frames = 0;
  for (const SharedBlock& block : recent_) frames += block.frames;
  while (!recent_.empty() && frames - recent_.front().frames >= kRecentFrames) {
    frames -= recent_.front().frames;
    recent_.pop_front();
  }
  return blocks;
}

std::vector<SharedBlock> LiveFeed::welcome() {
  std::vector<SharedBlock> blocks(recent_.begin(), recent_.end());
  for (SharedBlock& block : blocks) block.lost = 0;  // not lost to this page: it was not there
  return blocks;
}

void LiveFeed::measure() {
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> passed = now - measured_;
  if (now - measured_ < kMeasureInterval) return;
  real_factor_ = std::max(0.0, time_ - measured_time_) / passed.count();
  measured_ = now;
  measured_time_ = time_;
}

std::vector<std::string> LiveFeed::messages(std::size_t clients) {
  measure();
  std::vector<std::string> messages;
  {
    const std::lock_guard lock(mutex_);
    messages.swap(outbox_);
  }
  const Clock::time_point now = Clock::now();
  if (is_news_.exchange(false) || now >= next_status_) {
    messages.push_back(status(clients));
    next_status_ = now + kStatusInterval;
  }
  return messages;
}

std::string LiveFeed::status(std::size_t clients) {
  std::string text;
  JsonText json(text);
  json.object()
      .member("type", "status")
      .member("paused", paused_.load())
      .member("speed", speed_.load())
      .member("real_factor", real_factor_)
      .member("time", time_)
      .member("tick", tick_)
      .member("clients", clients)
      .member("can_command", true)
      .member("recording", std::string_view(recording_))
      .member("generation", generation_.load())
      .member("undo", operator_.undo_count());
  const std::optional<UserCommand> wanted = operator_.walk_wanted();
  const UserCommand& walk = wanted.value_or(user_);
  json.key("command").object().member("walk", walk.walk);
  vector_member(json, "velocity", walk.velocity);
  json.member("yaw_rate", walk.yaw_rate)
      .member("height", walk.height)
      .member("by", wanted ? "operator" : "scenario")
      .end_object();
  const std::lock_guard lock(mutex_);
  json.key("ended");
  ended_.empty() ? json.null() : json.value(std::string_view(ended_));
  force_member(json, "push", forces_.push, session_.bodies);
  force_member(json, "pull", forces_.pull, session_.bodies);
  json.member("pull_is_weaker", forces_.is_weaker).member("newton_seconds_left", forces_.store);
  json.end_object();
  return text;
}

std::string LiveFeed::command(const ViewCommand& command) {
  is_news_ = true;
  return operator_.command(command);
}

}  // namespace surefoot
