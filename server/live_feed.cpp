#include "server/live_feed.hpp"

#include "server/view_tasks.hpp"
#include "server/web_answer.hpp"
#include "server/web_guard.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/run_log.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/gaits/parts/calibration_motion.hpp"
#include "surefoot/logging/json_text.hpp"
#include "surefoot/logging/logged_timing.hpp"
#include "surefoot/model/urdf.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ranges>

namespace surefoot::server {
namespace {

constexpr std::size_t kRingTicks = 1024;
constexpr std::size_t kWelcomeFrames = 800;  // sent to a new page
constexpr double kHistory = 122.0;           // what it can request: two minutes and a little [s]
constexpr std::chrono::milliseconds kStatusInterval{250};
constexpr std::chrono::milliseconds kMeasureInterval{1000};

void vector_member(logging::JsonText& json, std::string_view name, const auto& vector) {
  json.key(name).array();
  for (const double number : vector) json.value(number);
  json.end_array();
}

std::uint32_t ticks_of(double seconds, double period) {
  return static_cast<std::uint32_t>(std::ceil(seconds / period));
}

}  // namespace

LiveFeed::LiveFeed(const config::Scenario& scenario, LiveOperator& wishes, std::string recording)
    : operator_(wishes),
      robot_(model::urdf_text(scenario.robot), model::mesh_folders(scenario.robot)),
      history_(ticks_of(kHistory, scenario.controller.period)),
      recording_(std::move(recording)),
      calibration_(
          gaits::CalibrationMotion(scenario.controller.planner.calibration, scenario.robot.scale)
              .duration()) {
  session_.start = random_token();
  session_.mode = "live";
  session_.version = build_info().version;
  session_.title =
      scenario.name + (scenario.seed == 0 ? "" : ", seed " + std::to_string(scenario.seed));
  session_.period = scenario.controller.period;
  session_.meshes = robot_.meshes();
  session_.limits = wishes.limits();
  session_.gaits = wishes.gaits();
}

void LiveFeed::begin(const closed_loop::RunParts& parts, const control::StackOptions& stack,
                     double friction) {
  ViewRun begun{.header = to_json(parts.header),
                .channels = tick_channels(parts.header, parts.plant.truth()),
                .rows = parts.controller.row_names(),
                .orders = {{0, parts.header.level_names}},
                .tasks = view_tasks(stack, parts.header.level_names, operator_.reach()),
                .bodies = parts.plant.bodies(),
                .friction = friction};
  const auto cone = explain::friction_cone_of(stack);
  if (ring_) {
    return hand_over([this, begun, cone] {
      cone_ = cone;
      begin_again(begun);
    });
  }
  cone_ = cone;
  ViewTick example;  // there is no server yet
  example.truth = parts.plant.truth();
  ring_.emplace(kRingTicks, example);
  begin_again(std::move(begun));
  session_.begun = session_.generation = 0;
}

void LiveFeed::begin_again(ViewRun begun) {
  static_cast<ViewRun&>(session_) = std::move(begun);
  session_.begun = ++session_.generation;
  names_ = {session_.channels.level_names, {}};
  std::vector<std::string> bodies = session_.bodies;
  bodies.insert(bodies.begin(), "world");
  finder_.emplace(session_.channels, std::move(bodies));
  events_.clear();
  changes_ = 0;
  past_.clear();
  history_.clear();
  aligner_ = {};
  calibrates_till_.reset();
  ended_.clear();
  tick_ = 0;
  time_ = 0.0;
  user_ = UserCommand();
}

void LiveFeed::put(std::uint32_t number, const TickRecord& tick,
                   const simulation::GroundTruth& truth, const TickTiming& timing) {
  ViewTick* place = ring_->next_to_write();
  if (place == nullptr) {
    ++lost_;
    return;
  }
  place->number = number;
  place->lost = std::exchange(lost_, 0);
  place->news = handed_;
  place->record = tick;
  place->truth = truth;
  place->timing = timing;
  ring_->written();
}

void LiveFeed::set_control(const control::StackOptions& stack, double friction,
                           std::uint32_t tick) {
  hand_over([this, stack, friction, tick] {
    session_.tasks = view_tasks(stack, session_.channels.level_names, operator_.reach());
    session_.friction = friction;
    names_ = {config::level_names(stack), {}};
    if (session_.orders.back().levels != names_.levels) {
      session_.orders.push_back({tick, names_.levels});
    }
    ++session_.generation;
  });
}

void LiveFeed::set_pace(bool paused, double speed) {
  paused_ = paused;
  speed_ = speed;
  is_news_ = true;
}

void LiveFeed::set_ended(const std::string& reason) {
  hand_over([this, reason] { ended_ = reason; });
}

void LiveFeed::set_recording(const std::string& path) {
  hand_over([this, path] { recording_ = path; });
}

void LiveFeed::show(const logged::Change& change) {
  hand_over([this, change] {
    finder_->acts(change);
    ++changes_;
    add_event(change.time, text_event(change.time, "change", change.text));
  });
}

void LiveFeed::add_event(double time, const std::string& event) {
  past_.emplace_back(time, event);
  events_.push_back(event);
}

void LiveFeed::notify(const std::string& notice) {
  hand_over([this, notice] {
    logging::JsonText(notices_.emplace_back())
        .object()
        .member("type", "notice")
        .member("text", std::string_view(notice))
        .end_object();
  });
}

void LiveFeed::hand_over(std::function<void()> take) { mailbox_.put({++handed_, std::move(take)}); }

void LiveFeed::fetch_news() {
  for (News& news : mailbox_.take()) news_.push_back(std::move(news));
}

void LiveFeed::take_news() {
  news_.front().take();
  taken_ = news_.front().number;
  news_.pop_front();
  is_news_ = true;
}

void LiveFeed::take_news_before(const ViewTick& tick) {
  if (taken_ < tick.news) fetch_news();
  while (taken_ < tick.news) take_news();
}

WebAnswer LiveFeed::get(std::string_view path, const Query& query) {
  if (path == "/api/session") {
    session_.first_tick = history_.first_tick();
    session_.ticks = tick_;
    return {200, "application/json", to_json(session_)};
  }
  if (path == "/api/events") {
    return {200, "application/json", json_list(std::views::values(past_))};
  }
  if (path != "/api/frames") return robot_.get(path);
  return answer_frames(query, [this](const FrameRequest& asked) {
    return history_.block(asked, session_.generation, session_.channels.floats, session_.period);
  });
}

// News from before a tick are taken before it. The ring already holds all ticks that are older than
// the fetched news, so the remaining news are taken after the last tick.
std::vector<SharedBlock> LiveFeed::blocks() {
  std::vector<SharedBlock> blocks;
  std::shared_ptr<std::string> bytes;
  fetch_news();
  for (const ViewTick* tick = ring_->next_to_read(); tick != nullptr;
       tick = ring_->next_to_read()) {
    take_news_before(*tick);
    if (blocks.empty() || blocks.back().generation != session_.generation) {
      bytes = std::make_shared<std::string>();
      blocks.push_back({.frames = 0, .generation = session_.generation, .lost = 0, .bytes = bytes});
    }
    take(*tick, *bytes);
    ++blocks.back().frames;
    blocks.back().lost += tick->lost;
    ring_->read();
  }
  while (!news_.empty()) take_news();
  if (bytes) bytes->shrink_to_fit();
  keep(blocks);
  return blocks;
}

void LiveFeed::keep(const std::vector<SharedBlock>& blocks) {
  for (const SharedBlock& block : blocks) {
    if (block.generation >= session_.begun) history_.add(block);
  }
  while (!past_.empty() && past_.front().first < history_.first_time()) past_.pop_front();
}

void LiveFeed::take(const ViewTick& tick, std::string& bytes) {
  const evaluation::Alignment& alignment = aligner_.update(tick.truth, tick.record);
  const auto& start = aligner_.start();
  see_calibration(tick.record);
  logging::HierarchyNamer namer(names_);
  const logged::Timing timing = logged::timing_of(tick.timing, names_.levels);
  to_frame({tick.number, tick.record, namer.name(tick.record.hierarchy), cone_, &tick.truth,
            &timing, &alignment, start ? &*start : nullptr},
           session_.channels, frame_);
  for (const std::string& event : finder_->see(frame_)) add_event(frame_.time, event);
  pack(frame_, bytes);
  tick_ = tick.number + 1;
  time_ = tick.record.reading.time;
  user_ = tick.record.user;
}

void LiveFeed::see_calibration(const TickRecord& tick) {
  const double time = tick.reading.time;
  if (tick.plan.calibration == CalibrationStage::none) {
    calibrates_till_.reset();
  } else if (!calibrates_till_ || evaluation::estimate_restarts(tick)) {
    calibrates_till_ = time + calibration_;
  }
}

std::vector<SharedBlock> LiveFeed::welcome() { return history_.newest(kWelcomeFrames); }

void LiveFeed::measure() {
  const Clock::time_point now = Clock::now();
  const Pace pace{paused_.load(), speed_.load(), session_.begun};
  if (pace != pace_) {  // also at first
    pace_ = pace;
    measured_ = now;
    measured_time_ = time_;
    real_factor_ = 0.0;
  }
  const std::chrono::duration<double> passed = now - measured_;
  if (now - measured_ < kMeasureInterval) return;
  real_factor_ = std::max(0.0, time_ - measured_time_) / passed.count();
  measured_ = now;
  measured_time_ = time_;
}

std::vector<std::string> LiveFeed::messages(std::size_t clients) {
  std::vector<std::string> messages;
  const Clock::time_point now = Clock::now();
  if (is_news_.exchange(false) || now >= next_status_) {
    messages.push_back(status(clients));
    next_status_ = now + kStatusInterval;
  }
  // After the status, which says whether the run has begun again.
  std::ranges::move(std::exchange(notices_, {}), std::back_inserter(messages));
  if (!events_.empty()) {
    messages.push_back(R"({"type":"events","events":)" + json_list(std::exchange(events_, {})) +
                       "}");
  }
  return messages;
}

std::string LiveFeed::status(std::size_t clients) {
  measure();
  std::string text;
  logging::JsonText json(text);
  json.object()
      .member("type", "status")
      .member("paused", pace_->paused)
      .member("speed", pace_->speed)
      .member("real_factor", real_factor_)
      .member("time", time_)
      .member("tick", tick_)
      .member("clients", clients)
      .member("recording", std::string_view(recording_))
      .member("generation", session_.generation)
      .member("begun", session_.begun)
      .member("changes", changes_);
  const std::optional<UserCommand> wanted = operator_.walk_wanted();
  const UserCommand& walk = wanted.value_or(user_);
  json.key("command").object().member("walk", walk.walk);
  vector_member(json, "velocity", walk.velocity);
  json.member("yaw_rate", walk.yaw_rate)
      .member("height", walk.height)
      .member("gait", operator_.gait_name(walk.gait))
      .member("by", wanted ? "operator" : "scenario")
      .end_object();
  json.key("calibrating");
  calibrates_till_ ? json.value(std::max(0.0, *calibrates_till_ - time_)) : json.null();
  json.key("ended");
  ended_.empty() ? json.null() : json.value(std::string_view(ended_));
  json.end_object();
  return text;
}

std::string LiveFeed::command(const ViewCommand& command) {
  is_news_ = true;
  return operator_.command(command);
}

}  // namespace surefoot::server
