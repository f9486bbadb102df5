#include "surefoot/explain/tick_explanation.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/explain/operator_text.hpp"
#include "surefoot/explain/outcome.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/logged_timing.hpp"
#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/message_decoder.hpp"
#include "surefoot/logging/scenario_forces.hpp"
#include "surefoot/logging/stop_text.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::logged {

// The members that are read of every /truth around the tick.
struct OutsideTruth {
  Quat q_SB = Quat::Identity();
  std::vector<double> xfrc_applied;
};

void fields(Decoder& field, OutsideTruth& truth) {
  field("q_SB", truth.q_SB, "");
  field("xfrc_applied", truth.xfrc_applied, "");
}

}  // namespace surefoot::logged

namespace surefoot::explain {

namespace {

constexpr double kJustBefore = 0.01;     // a change: the truth that gives its direction [s]
constexpr double kTimeTolerance = 1e-6;  // of a time that the user gives [s]
constexpr int kMaxRestartTicks = 400;    // a restart of the estimate comes within these first ticks

/// Estimated against true pose at the first tick of a log, whose truth comes before the second
/// tick.
std::optional<evaluation::StartAlignment> read_start(const std::string& path) {
  std::optional<simulation::GroundTruth> truth;
  logging::LogReader log(path, [&](const logging::McapMessage& message) {
    if (message.channel->topic == "/truth" && !truth)
      logged::Decoder::decode(message.data, truth.emplace());
  });
  TickRecord first, next;
  if (!log.next(first)) return std::nullopt;
  for (int tick = 1; tick < kMaxRestartTicks && log.next(next); ++tick) {
    if (evaluation::estimate_restarts(next)) return std::nullopt;
  }
  if (!truth || std::abs(truth->time - first.reading.time) > 1e-9) return std::nullopt;
  return evaluation::start_alignment(*truth, first.state);
}

std::uint64_t nanoseconds(double time) {
  return static_cast<std::uint64_t>(std::llround(1e9 * time));
}

/// The end of a log's duration, also as texts round it: 12.35 s for 12.3475 s.
bool is_end(double time, double end) {
  return time <= end + kTimeTolerance ||
         std::abs(time - 0.01 * std::round(100.0 * end)) <= kTimeTolerance;
}

/// The timing of a tick. Timings are behind all ticks, so the last chunks are read first.
std::optional<TickTiming> read_timing(const std::string& path, std::uint64_t time,
                                      const std::vector<std::string>& level_names) {
  logging::McapChunks file(path);
  std::optional<logged::Timing> found;
  for (std::size_t i = file.chunks().size(); i-- > 0 && !found;) {
    const logging::McapChunk& chunk = file.chunks()[i];
    if (time < chunk.first_time || time > chunk.last_time) continue;
    try {
      file.read(i, [&](const logging::McapMessage& message) {
        if (message.log_time != time || message.channel->topic != "/timings") return;
        logged::Timing timing;
        logged::Decoder::decode(message.data, timing);
        found = timing;
      });
    } catch (const Error&) {  // the tick is still good, and what was read before
    }
  }
  if (!found) return std::nullopt;
  return logged::timing_from(*found, level_names);
}

/// Follows the blends of hierarchies up to the one that a tick is in, and to its end.
class BlendWatch {
 public:
  /// Between two ticks: levels in another order, or other numbers of their tasks.
  void change(const logged::Change& change) {
    if (change.kind == "stack") change_ = change;
  }

  void see(const TickRecord& tick, const std::vector<std::int16_t>& order, bool follows) {
    const bool was_going_on = std::exchange(is_going_on_, tick.hierarchy.transition_share < 1.0);
    if (!follows) last_.reset();
    if (is_going_on_ && (!was_going_on || !follows)) begin(tick.reading.time);
    if (is_going_on_) return;
    last_ = NeighbourTick{tick, order, {}};
    if (!was_going_on || !follows) return;
    blend_.until = tick.reading.time;
    blend_.after = last_;
  }

  /// At the last tick seen.
  [[nodiscard]] bool is_going_on() const { return is_going_on_; }
  [[nodiscard]] const HierarchyBlend& blend() const { return blend_; }

 private:
  void begin(double time) {
    const bool is_by_change = time < change_.time + change_.duration;
    blend_ = {.until = kNaN,
              .change = is_by_change ? change_.text : "",
              .before = std::exchange(last_, std::nullopt),
              .after = {}};
  }

  bool is_going_on_ = false;
  logged::Change change_;
  HierarchyBlend blend_;
  std::optional<NeighbourTick> last_;  // the last tick outside of blends
};

/// How a run ended, from the summary of its log; empty: not known.
std::string end_text(const std::string& summary) {
  const Outcome outcome = read_outcome(summary);
  if (!outcome.known) return "";
  return (outcome.interrupted ? "the run was " : "the run ended: ") + outcome.reason;
}

/// Reads a log from `back` [s] before a time to `window` [s] after it.
class Search {
 public:
  Search(const std::string& path, double time, double back, double window = kEventWindow)
      : path_(path),
        time_(time),
        back_(back),
        window_(window),
        log_(path, [this](const logging::McapMessage& message) {
          if (message.channel->topic == "/truth") take_truth(message);
          if (message.channel->topic == "/changes") take_change(message);
        }) {
    found_.bodies = logging::body_names(log_.header());
    scenario_.emplace(found_.bodies);
  }

  /// Within the window.
  std::vector<NearbyEvent> events() {
    const bool has_ended = read();
    add_forces();
    if (has_ended) add_end();
    return std::move(found_.events);
  }

  TickExplanation run() {
    const bool has_ended = read();
    found_.log = path_;
    found_.header = log_.header();
    const double period = found_.header.control_period;
    found_.asked = time_;
    found_.is_behind_end =
        has_ended && time_ > nearest_ + 0.5001 * period && is_end(time_, nearest_ + period);
    if (!found_.is_behind_end && !(std::abs(nearest_ - time_) <= 0.5001 * period)) refuse();
    found_.forces = commanded_forces(friction_cone_of(found_.header), found_.tick,
                                     found_.header.robot.least_load());
    found_.header.attachments.clear();
    found_.row_names = log_.row_names();
    found_.timing = read_timing(path_, nanoseconds(nearest_), found_.header.level_names);
    found_.problem = log_.problem();
    if (found_.truth && std::abs(found_.truth->time - nearest_) > 1e-9) found_.truth.reset();
    if (found_.truth)
      found_.applied =
          logging::applied_forces(nearest_, found_.truth->xfrc_applied, found_.truth->q_SB);
    add_forces();
    if (has_ended) add_end();
    const auto start = found_.truth ? read_start(path_) : std::nullopt;
    if (start) found_.estimate = evaluation::aligned(*start, *found_.truth, found_.tick.state);
    return std::move(found_);
  }

  /// There is no earlier tick in the log that can be read.
  [[nodiscard]] bool saw_the_start() const {
    return first_ > time_ - back_ + 1.5 * log_.header().control_period;
  }

 private:
  /// To the end of the window, or of a blend that the tick is in; true: to the end of the log.
  bool read() {
    log_.skip_until(time_ - back_);
    std::optional<CommandMode> mode_before;
    bool has_ended = false;
    while (!(has_ended = !log_.next(tick_)) &&
           (tick_.reading.time <= time_ + window_ || is_in_blend_)) {
      see_blend();
      if (tick_.reading.time > time_ + window_) continue;
      if (is_near(tick_.reading.time)) {
        add_plan_events();
        if (mode_before && log_.follows())
          add_mode(*mode_before);
        else if (std::isinf(window_) && !stop_text().empty())
          add_mode(CommandMode::optimal);  // the log, or what is left after a gap, begins in a stop
      }
      mode_before = tick_.command.mode;
      if (std::isnan(first_)) first_ = tick_.reading.time;
      last_ = tick_.reading.time;
      if (!has_truth_) heading_ = yaw(tick_.state.q_WB.toRotationMatrix());
      if (!is_nearest()) continue;
      found_.tick = tick_;
      found_.order = log_.level_order();
      nearest_ = tick_.reading.time;
      find_blend();
    }
    return has_ended;
  }

  [[nodiscard]] bool is_nearest() const {
    return std::isnan(nearest_) ||
           std::abs(tick_.reading.time - time_) <= std::abs(nearest_ - time_);
  }

  [[nodiscard]] bool is_near(double time) const { return std::abs(time - time_) <= window_; }

  /// Of the tick to explain.
  void find_blend() {
    is_in_blend_ = blends_.is_going_on();
    found_.blend.reset();
    if (is_in_blend_) found_.blend = blends_.blend();
  }

  void see_blend() {
    blends_.see(tick_, log_.level_order(), log_.follows());
    const bool goes_on = log_.follows() && blends_.is_going_on();
    if (is_in_blend_ && log_.follows() && !goes_on) found_.blend = blends_.blend();
    is_in_blend_ = is_in_blend_ && goes_on;
  }

  void add_mode(CommandMode before) {
    const CommandMode now = tick_.command.mode;
    if (now == before) return;
    found_.events.push_back(
        {tick_.reading.time, logging::mode_text(now, stop_text()), "", "controller"});
  }

  [[nodiscard]] std::string stop_text() const {
    return logging::text_of_stop(tick_, log_.header().robot.joints());
  }

  /// Behind the last tick.
  void add_end() {
    const std::string text = end_text(log_.summary());
    if (!text.empty() && is_near(last_)) insert({last_, text, "", "run"});
  }

  void add_plan_events() {
    const auto& names = log_.header().event_names;
    const int num_legs = log_.header().robot.num_legs;
    for (const GaitEvent& event : tick_.plan.events) {
      const auto kind = static_cast<std::size_t>(event.kind);
      found_.events.push_back({tick_.reading.time,
                               kind < names.size() ? names[kind] : "event " + std::to_string(kind),
                               event.leg ? std::string(leg_name(*event.leg, num_legs)) : ""});
    }
  }

  /// Stands before the tick that has it first.
  void take_change(const logging::McapMessage& message) {
    logged::Change change;
    logged::Decoder::decode(message.data, change);
    scenario_->acts(change);
    blends_.change(change);
    if (!is_near(change.time)) return;
    found_.events.push_back({change.time, operator_text(change, heading_), "", "operator"});
  }

  /// The truth of a tick comes behind the tick's own messages, and before the next one's.
  void take_truth(const logging::McapMessage& message) {
    has_truth_ = true;
    see_forces(message);
    const double time = 1e-9 * static_cast<double>(message.log_time);
    if (!(time > time_ - kLyingWindow && time <= nearest_ + 1e-9)) return;
    simulation::GroundTruth truth;
    logged::Decoder::decode(message.data, truth, log_.header().robot.num_legs);
    if (!found_.touch) found_.touch.emplace();
    found_.touch->see(truth);
    if (std::abs(time - nearest_) <= 1e-9) found_.truth = truth;
  }

  void see_forces(const logging::McapMessage& message) {
    const double time = 1e-9 * static_cast<double>(message.log_time);
    if (!is_near(time) && !is_near(time + kJustBefore)) return;
    logged::OutsideTruth truth;
    logged::Decoder::decode(message.data, truth);
    heading_ = yaw(truth.q_SB.toRotationMatrix());
    if (!is_near(time)) return;
    scenario_->leave(time, truth.xfrc_applied);
    const auto changes = forces_.see(time, truth.xfrc_applied, truth.q_SB);
    begun_.insert(begun_.end(), changes.begun.begin(), changes.begun.end());
    ended_.insert(ended_.end(), changes.ended.begin(), changes.ended.end());
  }

  void insert(const NearbyEvent& event) {
    const auto later = std::ranges::upper_bound(found_.events, event.time, {}, &NearbyEvent::time);
    found_.events.insert(later, event);
  }

  /// Only the scenario's forces: the operator's are events of their own.
  void add_forces() {
    const auto add = [this](double time, const std::string& text) {
      insert({time, text, "", "outside"});
    };
    for (const logging::AppliedForce& force : begun_)
      add(force.from, logging::push_text(force, found_.bodies));
    for (const logging::AppliedForce& force : ended_)
      add(force.to, logging::push_end_text(force, found_.bodies));
  }

  [[noreturn]] void refuse() const {
    logging::LogReader whole(path_);
    TickRecord tick;
    double first = kNaN, last = kNaN;
    while (whole.next(tick)) {
      if (std::isnan(first)) first = tick.reading.time;
      last = tick.reading.time;
    }
    const std::string problem = whole.problem().empty() ? "" : "; " + whole.problem();
    if (std::isnan(first)) throw Error(path_ + ": the log holds no tick" + problem);
    const bool is_inside = first <= time_ && time_ <= last;
    const char* why = problem.empty() ? " s, where the clock skips: the controller was not called"
                                      : " s, where no tick can be read";
    throw Error(path_ + ": no tick at " + formatted("%.6g", time_) + (is_inside ? why : " s") +
                "; the log goes from " + formatted("%.6g", first) + " s to " +
                formatted("%.6g", last) + " s" + problem);
  }

  std::string path_;
  double time_, back_, window_, nearest_ = kNaN;
  double first_ = kNaN, last_ = kNaN;  // times of the first and last tick seen [s]
  double heading_ = kNaN;              // in S; of a log without truth the believed one in W [rad]
  bool has_truth_ = false;
  BlendWatch blends_;
  bool is_in_blend_ = false;  // the tick to explain is in a blend that has not ended yet
  std::optional<logging::ScenarioForces> scenario_;
  logging::AppliedForceWatch forces_;
  std::vector<logging::AppliedForce> begun_, ended_;
  logging::LogReader log_;
  TickRecord tick_;
  TickExplanation found_;
};

}  // namespace

double level_time(const TickExplanation& explanation, std::size_t level) {
  const bool is_known = explanation.timing && level < kMaxLevels;
  return is_known ? static_cast<double>(explanation.timing->levels[level]) : kNaN;
}

// A blend may have begun long before the tick: search further back until its begin is found.
TickExplanation read_tick(const std::string& path, double time) {
  for (double back = kEventWindow;; back *= 4.0) {
    Search search(path, time, back);
    TickExplanation found = search.run();
    if (!found.blend || found.blend->before || search.saw_the_start()) return found;
  }
}

std::vector<NearbyEvent> read_events(const std::string& path) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  return Search(path, 0.0, kAll, kAll).events();
}

double true_friction_use(const simulation::TrueContact& contact, double least_load) {
  const double along_normal = contact.normal.dot(contact.force);
  if (along_normal <= least_load || contact.friction <= 0.0) return kNaN;
  return (contact.force - along_normal * contact.normal).norm() / (contact.friction * along_normal);
}

}  // namespace surefoot::explain
