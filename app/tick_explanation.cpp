#include "app/tick_explanation.hpp"

#include "app/hierarchy_status.hpp"
#include "app/operator_text.hpp"
#include "app/scenario_forces.hpp"
#include "app/stop_text.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/evaluation/event_counter.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/logged_timing.hpp"
#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/message_decoder.hpp"
#include "surefoot/logging/visible_residual.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/solver/solution.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace logged {

// What is taken from every /truth around the tick.
struct OutsideTruth {
  Quat q_WB = Quat::Identity();
  std::vector<double> xfrc_applied;
};

void fields(Decoder& field, OutsideTruth& truth) {
  field("q_WB", truth.q_WB, "");
  field("xfrc_applied", truth.xfrc_applied, "");
}

}  // namespace logged

namespace {

constexpr double kLoaded = 1.0;                // [N]
constexpr double kSlack = 0.01;                // of a share that may be rounding
constexpr double kHalfOfLastDigit = 0.005001;  // of a duration, as it is told [s]

/// Two digits, or all that stand before the point: 0.12, 3.4, 460.
std::string number(double value) {
  return formatted(std::abs(value) < 100.0 ? "%.2g" : "%.0f", value);
}

/// How belief and truth lay at the first tick of a log; its truth comes before the second tick.
std::optional<StartAlignment> read_start(const std::string& path) {
  std::optional<GroundTruth> truth;
  LogReader log(path, [&](const McapMessage& message) {
    if (message.channel->topic == "/truth" && !truth)
      logged::Decoder::decode(message.data, truth.emplace());
  });
  TickRecord first, second;
  if (!log.next(first)) return std::nullopt;
  (void)log.next(second);
  if (!truth || std::abs(truth->time - first.reading.time) > 1e-9) return std::nullopt;
  return start_alignment(*truth, first.state);
}

std::uint64_t nanoseconds(double time) {
  return static_cast<std::uint64_t>(std::llround(1e9 * time));
}

/// The timing at a time; it stands behind all ticks, so that the last chunks come first.
std::optional<TickTiming> read_timing(const std::string& path, std::uint64_t time,
                                      const std::vector<std::string>& level_names) {
  McapChunks file(path);
  std::optional<logged::Timing> found;
  for (std::size_t i = file.chunks().size(); i-- > 0 && !found;) {
    const McapChunk& chunk = file.chunks()[i];
    if (time < chunk.first_time || time > chunk.last_time) continue;
    try {
      file.read(i, [&](const McapMessage& message) {
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

/// Reads a log up to a little behind a time.
class Search {
 public:
  Search(const std::string& path, double time)
      : path_(path), time_(time), log_(path, [this](const McapMessage& message) {
          if (message.channel->topic == "/truth") take_truth(message);
          if (message.channel->topic == "/changes") take_change(message);
        }) {}

  TickExplanation run() {
    scenario_.emplace(body_names(log_.header()));
    log_.skip_until(time_ - kEventWindow);
    MotionPlan before;
    bool has_before = false;
    bool has_ended = false;
    while (!(has_ended = !log_.next(tick_)) && tick_.reading.time <= time_ + kEventWindow) {
      if (has_before && log_.follows()) add_event(before);
      before = tick_.plan;
      has_before = true;
      yaw_ = roll_pitch_yaw(tick_.state.q_WB.toRotationMatrix()).z();
      if (!is_nearest()) continue;
      found_.tick = tick_;
      found_.order = log_.level_order();
      nearest_ = tick_.reading.time;
    }
    found_.header = log_.header();
    const double period = found_.header.control_period;
    found_.asked = time_;
    found_.is_behind_end = has_ended && time_ > nearest_ + 0.5001 * period &&
                           time_ <= nearest_ + period + kHalfOfLastDigit;
    if (!found_.is_behind_end && !(std::abs(nearest_ - time_) <= 0.5001 * period)) refuse();
    found_.forces = commanded_forces(friction_cone_of(found_.header), found_.tick);
    found_.bodies = body_names(found_.header);
    found_.header.attachments.clear();
    found_.row_names = log_.row_names();
    found_.timing = read_timing(path_, nanoseconds(nearest_), found_.header.level_names);
    found_.problem = log_.problem();
    if (found_.truth && std::abs(found_.truth->time - nearest_) > 1e-9) found_.truth.reset();
    if (found_.truth)
      found_.applied = applied_forces(nearest_, found_.truth->xfrc_applied, found_.truth->q_WB);
    add_forces();
    const auto start = found_.truth ? read_start(path_) : std::nullopt;
    if (start) found_.estimate = aligned(*start, *found_.truth, found_.tick.state);
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool is_nearest() const {
    return std::isnan(nearest_) ||
           std::abs(tick_.reading.time - time_) <= std::abs(nearest_ - time_);
  }

  void add_event(const MotionPlan& before) {
    const auto event = static_cast<std::size_t>(tick_.plan.event);
    const auto& names = log_.header().event_names;
    if (event == 0) return;
    const std::optional<Leg> leg =
        leg_of(static_cast<PlanEvent>(event), phases_of(before), phases_of(tick_.plan));
    found_.events.push_back({tick_.reading.time,
                             event < names.size() ? names[event] : "event " + std::to_string(event),
                             leg ? std::string(kLegNames[index(*leg)]) : ""});
  }

  /// Stands before the tick that has it first.
  void take_change(const McapMessage& message) {
    logged::Change change;
    logged::Decoder::decode(message.data, change);
    scenario_->acts(change);
    if (change.kind == "pull" && !first_pull_) first_pull_ = change;
    if (!told_.tells(change) || change.time > time_ + kEventWindow) return;
    found_.events.push_back({change.time, operator_text(change, yaw_), "", "operator"});
  }

  /// The truth of a tick comes behind the tick's own messages, and before the next one's.
  void take_truth(const McapMessage& message) {
    see_forces(message);
    if (std::abs(1e-9 * static_cast<double>(message.log_time) - nearest_) > 1e-9) return;
    logged::Decoder::decode(message.data, found_.truth.emplace());
  }

  void see_forces(const McapMessage& message) {
    const double time = 1e-9 * static_cast<double>(message.log_time);
    if (time < time_ - kEventWindow || time > time_ + kEventWindow) return;
    logged::OutsideTruth truth;
    logged::Decoder::decode(message.data, truth);
    scenario_->leave(time, truth.xfrc_applied);
    if (std::isnan(first_seen_)) first_seen_ = time;
    const auto changes = forces_.see(time, truth.xfrc_applied, truth.q_WB);
    begun_.insert(begun_.end(), changes.begun.begin(), changes.begun.end());
    ended_.insert(ended_.end(), changes.ended.begin(), changes.ended.end());
  }

  /// A pull that acted already when reading began: of it the first change is known alone.
  [[nodiscard]] bool is_pull_from_before(const AppliedForce& force) const {
    return first_pull_ && force.from == first_seen_ && force.body < found_.bodies.size() &&
           found_.bodies[force.body] == first_pull_->body &&
           std::abs(force.to - first_pull_->time) < 0.5 * found_.header.control_period;
  }

  /// Those of the operator are told by what the operator did.
  void add_forces() {
    const auto add = [this](double time, const std::string& text) {
      const auto later = std::ranges::upper_bound(found_.events, time, {}, &NearbyEvent::time);
      found_.events.insert(later, {time, text, "", "outside"});
    };
    for (const AppliedForce& force : begun_)
      add(force.from, "pushed by " + applied_force_text(force, found_.bodies));
    std::erase_if(ended_, [this](const AppliedForce& one) { return is_pull_from_before(one); });
    for (const AppliedForce& force : ended_)
      add(force.to, "the push on " + body_text(force.body, found_.bodies) + " ends");
  }

  [[noreturn]] void refuse() const {
    LogReader whole(path_);
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
    throw Error(path_ + ": --at is " + formatted("%.6g", time_) + (is_inside ? why : " s") +
                "; the log goes from " + formatted("%.6g", first) + " s to " +
                formatted("%.6g", last) + " s" + problem);
  }

  std::string path_;
  double time_, nearest_ = kNaN;
  double yaw_ = kNaN;  // believed at the last tick
  ToldChanges told_;
  std::optional<ScenarioForces> scenario_;
  AppliedForceWatch forces_;
  std::vector<AppliedForce> begun_, ended_;
  double first_seen_ = kNaN;  // of the forces [s]
  std::optional<logged::Change> first_pull_;
  LogReader log_;
  TickRecord tick_;
  TickExplanation found_;
};

std::string level_name(const TickExplanation& explanation, std::int16_t level) {
  const auto& names = explanation.header.level_names;
  const auto k = static_cast<std::size_t>(level);
  return k < names.size() ? names[k] : "level " + std::to_string(level + 1);
}

std::string row_name(const TickExplanation& explanation, const BlockingRow& row) {
  const auto found = explanation.row_names.find({row.by_level, row.id});
  return found == explanation.row_names.end() ? "row " + std::to_string(row.id) : found->second;
}

std::vector<CostlyRow> rows_of(const TickExplanation& explanation, std::int16_t level) {
  std::vector<CostlyRow> rows;
  const HierarchyReport& report = explanation.tick.hierarchy;
  for (std::int32_t i = 0; i < report.num_blocking; ++i) {
    const BlockingRow& row = report.blocking[static_cast<std::size_t>(i)];
    if (row.level != level) continue;
    rows.push_back({level_name(explanation, row.by_level), row_name(explanation, row), row.cost});
  }
  return rows;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

/// A row by its level's name, without that of its own where it says no more: torso_height height.
/// `before`: the row that is told before it; its level is told once.
std::string named(const CostlyRow& row, const CostlyRow* before) {
  if (row.level.ends_with("_" + row.row)) return row.level;
  const bool is_told = before != nullptr && before->level == row.level;
  return is_told ? row.row : row.level + " " + row.row;
}

bool has_costs(const LevelThatGaveWay& level) {
  return !level.to.empty() &&
         level.to.front().cost > kResidualRounding;  // the dearest stands first
}

bool is_same(const CostlyRow& a, const CostlyRow& b) {
  return a.level == b.level && a.row == b.row;
}

/// Of levels that nothing costs anything alone.
bool is_by_the_same(const LevelThatGaveWay& a, const LevelThatGaveWay& b) {
  return a.to.size() > 1 && !has_costs(a) && !has_costs(b) &&
         std::ranges::is_permutation(a.to, b.to, is_same);
}

std::string clause(const LevelThatGaveWay& level, bool is_known) {
  const std::string unit = level.unit.empty() ? "" : " " + level.unit;
  std::string text = level.name + " gave way by " + number(level.residual) + unit;
  if (level.to.empty())
    return text + (is_known ? " to nothing above: its own rows can't all be had"
                            : "; to what is not known");
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < level.to.size(); ++i) {
    const CostlyRow& row = level.to[i];
    rows.push_back(named(row, i == 0 ? nullptr : &level.to[i - 1]) +
                   (has_costs(level) ? " (" + number(row.cost) + unit + ")" : ""));
  }
  return text + " to " + joined(rows);
}

/// What the clauses of levels leave out: that rows without a cost cost nothing alone.
std::string without_costs(const std::vector<LevelThatGaveWay>& levels) {
  const auto has_none = [](const LevelThatGaveWay& level) {
    return !level.to.empty() && !has_costs(level);
  };
  if (std::ranges::none_of(levels, has_none)) return "";
  if (levels.size() > 1) return "; rows without a number cost nothing alone";
  return levels.front().to.size() == 1 ? ", which costs nothing alone"
                                       : ", none of which costs anything alone";
}

std::string clauses(const std::vector<LevelThatGaveWay>& levels, bool is_known) {
  std::string text;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LevelThatGaveWay& level = levels[i];
    const std::string unit = level.unit.empty() ? "" : " " + level.unit;
    const bool goes_on = i > 0 && is_by_the_same(level, levels[i - 1]);
    text += (i == 0 ? "" : "; ") +
            (goes_on ? level.name + " gave way by " + number(level.residual) + unit + " to the same"
                     : clause(level, is_known));
  }
  return text + without_costs(levels);
}

std::string nothing_gave_way(const std::vector<LevelThatGaveWay>& restless) {
  if (restless.empty()) return "Every level got what it asked for.";
  std::vector<std::string> names;
  names.reserve(restless.size());
  for (const LevelThatGaveWay& level : restless) names.push_back(level.name);
  return "Every level got what it asked for but " + joined(names) + ", which never " +
         (names.size() == 1 ? "does." : "do.");
}

std::string without_solution(const TickRecord& tick) {
  const std::string mode(logged::kModeNames[static_cast<std::size_t>(tick.command.mode)]);
  const std::string why = text_of_stop(tick);
  return "No hierarchy was solved at this tick: the command is that of the mode " + mode +
         ", because " + (why.empty() ? "there was no state to believe" : why) + ".";
}

/// Of a solve that did not come to its end.
std::string cut_off(const TickExplanation& explanation) {
  const HierarchyReport& report = explanation.tick.hierarchy;
  const auto& order = explanation.order;
  const auto place = std::ranges::find(order, static_cast<std::int16_t>(report.failed_level));
  if (report.status != static_cast<std::int32_t>(SolveStatus::iteration_cap) ||
      place == order.end())
    return "";
  return " The solver was cut off in " + level_name(explanation, *place) +
         ": of it and the levels below it this says nothing.";
}

}  // namespace

double level_time(const TickExplanation& explanation, std::size_t level) {
  const bool is_known = explanation.timing && level < kMaxLevels;
  return is_known ? static_cast<double>(explanation.timing->levels[level]) : kNaN;
}

TickExplanation read_tick(const std::string& path, double time) { return Search(path, time).run(); }

std::vector<LevelThatGaveWay> gave_way(const TickExplanation& explanation) {
  std::vector<LevelThatGaveWay> levels;
  if (!was_solved(explanation.tick.hierarchy)) return levels;
  const HierarchyReport& report = explanation.tick.hierarchy;
  for (const std::int16_t k : explanation.order) {
    const auto level = static_cast<std::size_t>(k);
    const double residual = report.levels[level].residual;
    const auto& units = explanation.header.level_units;
    const std::string name = level_name(explanation, k);
    const std::string unit = level < units.size() ? units[level] : "";
    const double visible = visible_residual(name, unit);
    const bool restless = std::isnan(visible);
    if (!(residual > (restless ? kResidualRounding : visible))) continue;
    levels.push_back({.name = name,
                      .unit = unit,
                      .residual = residual,
                      .restless = restless,
                      .to = rows_of(explanation, k)});
  }
  return levels;
}

std::string gave_way_sentence(const TickExplanation& explanation) {
  const TickRecord& tick = explanation.tick;
  if (!was_solved(tick.hierarchy)) return without_solution(tick);
  std::vector<LevelThatGaveWay> levels = gave_way(explanation), restless;
  std::ranges::copy_if(levels, std::back_inserter(restless), &LevelThatGaveWay::restless);
  std::erase_if(levels, &LevelThatGaveWay::restless);
  if (levels.empty()) return nothing_gave_way(restless) + cut_off(explanation);
  return clauses(levels, tick.hierarchy.blocking_is_known) + "." + cut_off(explanation);
}

bool is_beyond_limits(const TickExplanation& explanation, Leg leg) {
  const double normal = explanation.forces.normal[index(leg)];
  const double most = explanation.tick.plan.feet[index(leg)].force_max;
  return normal < -kLoaded || normal > most + kLoaded ||
         explanation.forces.friction_use[index(leg)] > 1.0 + kSlack;
}

double true_friction_use(const TrueContact& contact) {
  const double along_normal = contact.normal.dot(contact.force);
  if (along_normal < kLoaded || contact.friction <= 0.0) return kNaN;
  return (contact.force - along_normal * contact.normal).norm() / (contact.friction * along_normal);
}

}  // namespace surefoot
