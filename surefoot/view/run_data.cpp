#include "surefoot/view/run_data.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/change_count.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/message_decoder.hpp"
#include "surefoot/logging/visible_residual.hpp"
#include "surefoot/model/belief_frame.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

namespace surefoot {
namespace logged {

// What the report takes from a message on /truth.
struct TruthContact {
  Vec3 force = Vec3::Constant(kNaN), normal = Vec3::Constant(kNaN);
};
struct Truth {
  TruthSample sample;
  PerLeg<TruthContact> feet;
  std::vector<double> xfrc_applied;
};

void fields(Decoder& field, TruthContact& contact) {
  field("force", contact.force, "");
  field("normal", contact.normal, "");
}

void fields(Decoder& field, Truth& truth) {
  field("time", truth.sample.time, "");
  field("p_WB", truth.sample.p_WB, "");
  field("q_WB", truth.sample.q_WB, "");
  field("v_WB", truth.sample.v_WB, "");
  field("torque", truth.sample.torque, "");
  field("p_WCom", truth.sample.p_WCom, "");
  field("p_WF", truth.sample.p_WF, "");
  field("feet", truth.feet, "");
  field("xfrc_applied", truth.xfrc_applied, "");
}

}  // namespace logged

namespace {

TruthSample truth_sample(const McapMessage& message, AppliedForceWatch& forces,
                         std::vector<AppliedForce>& ended) {
  logged::Truth truth;
  logged::Decoder::decode(message.data, truth);
  const auto changes = forces.see(truth.sample.time, truth.xfrc_applied, truth.sample.q_WB);
  ended.insert(ended.end(), changes.ended.begin(), changes.ended.end());
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    truth.sample.normal_force[leg] = truth.feet[leg].normal.dot(truth.feet[leg].force);
  }
  return truth.sample;
}

/// Of a level that was not solved nothing is known of its rows.
bool is_solved(const HierarchyReport& report, std::int16_t level) {
  const auto number = static_cast<std::size_t>(level);
  return number < kMaxLevels && !std::isnan(report.levels[number].residual);
}

TickSample sample(const TickRecord& tick) {
  TickSample result{.time = tick.reading.time,
                    .plan = tick.plan,
                    .p_WB = tick.state.p_WB,
                    .q_WB = tick.state.q_WB,
                    .v_WB = tick.state.v_WB,
                    .model = tick.model,
                    .torque = tick.command.torque,
                    .mode = tick.command.mode,
                    .residuals = {},
                    .num_levels = tick.hierarchy.num_levels,
                    .active = {},
                    .truth = {}};
  for (std::size_t i = 0; i < kMaxLevels; ++i)
    result.residuals[i] = tick.hierarchy.levels[i].residual;
  std::copy_if(tick.hierarchy.active.begin(),
               tick.hierarchy.active.begin() + tick.hierarchy.num_active,
               std::back_inserter(result.active),
               [&](const ActiveRow& row) { return is_solved(tick.hierarchy, row.level); });
  return result;
}

// Joins the ticks at which a row is active to stretches of time.
class ActiveTimes {
 public:
  explicit ActiveTimes(double period) : period_(period) {}

  void add(double time, const HierarchyReport& report) {
    for (int i = 0; i < report.num_active; ++i) {
      const ActiveRow& row = report.active[static_cast<std::size_t>(i)];
      if (!is_solved(report, row.level)) continue;
      const auto [entry, is_new] = last_.try_emplace({row.level, row.id}, times.size());
      const bool goes_on = !is_new && time - times[entry->second].to < 0.5 * period_;
      if (!goes_on) {
        entry->second = times.size();
        times.push_back({row.level, row.id, time, time, false});
      }
      times[entry->second].to = time + period_;
      times[entry->second].beyond |= std::abs(row.state) > 1;
    }
  }

  std::vector<ActiveTime> times;

 private:
  double period_;
  std::map<std::pair<std::int16_t, std::int32_t>, std::size_t>
      last_;  // index of a row's latest stretch
};

// Adds up what held each level back.
class GaveWaySum {
 public:
  void add(double time, const HierarchyReport& report) {
    if (!report.blocking_is_known) return;
    ++num_ticks_;
    for (int i = 0; i < report.num_blocking; ++i) {
      const BlockingRow& row = report.blocking[static_cast<std::size_t>(i)];
      if (row.cost > kResidualRounding && is_solved(report, row.level)) add(time, row);
    }
  }

  void move_into(RunData& run) {
    run.num_explained_ticks = num_ticks_;
    for (const auto& [key, sum] : sums_) run.gave_way.push_back(sum);
  }

 private:
  void add(double time, const BlockingRow& row) {
    GaveWay& sum = sums_[{row.level, row.by_level, row.id}];
    sum.level = row.level;
    sum.by_level = row.by_level;
    sum.id = row.id;
    ++sum.num_ticks;
    sum.sum += row.cost;
    if (row.cost <= sum.largest) return;
    sum.largest = row.cost;
    sum.time = time;
  }

  std::map<std::tuple<std::int16_t, std::int16_t, std::int32_t>, GaveWay> sums_;
  int num_ticks_ = 0;
};

// Both are in the order of time; a tick without a truth keeps its NaN.
bool merge(const std::vector<TruthSample>& truths, std::vector<TickSample>& ticks) {
  std::size_t next = 0;
  for (TickSample& tick : ticks) {
    while (next < truths.size() && truths[next].time < tick.time - 1e-9) ++next;
    if (next < truths.size() && truths[next].time < tick.time + 1e-9) tick.truth = truths[next];
  }
  return !truths.empty();
}

// Sensors see neither position nor heading, so the controller's W is laid into the true one by the
// feet that stand.
void lay_plans(RunData& run) {
  BeliefFrame frame;
  for (TickSample& tick : run.ticks) {
    if (!std::isnan(tick.truth.time)) frame.update(tick.plan, tick.model.p_WF, tick.truth.p_WF);
    const Vec2& p = tick.plan.com.p;
    const Vec3 desired = frame.to_truth({p.x(), p.y(), tick.plan.torso.height});
    tick.desired_com = desired.head<2>();
    tick.desired_height = desired.z();
    tick.R_belief = frame.R();
  }
}

}  // namespace

Vec3 centre_of_mass(const TickSample& tick) {
  return std::isnan(tick.truth.time) ? tick.model.p_WCom : tick.truth.p_WCom;
}

Vec3 base(const TickSample& tick) {
  return std::isnan(tick.truth.time) ? tick.p_WB : tick.truth.p_WB;
}

Vec3 foot_centre(const TickSample& tick, std::size_t leg) {
  return std::isnan(tick.truth.time) ? tick.model.p_WF[leg] : tick.truth.p_WF[leg];
}

RunData read_run(const std::string& log_path) {
  std::vector<TruthSample> truths;
  RunData run;
  AppliedForceWatch forces;
  ChangeCount changes;
  LogReader log(log_path, [&](const McapMessage& message) {
    if (message.channel->topic == "/truth")
      truths.push_back(truth_sample(message, forces, run.applied));
    if (message.channel->topic == "/changes") changes.add(message.data);
  });
  run.header = log.header();
  ActiveTimes active(run.header.control_period);
  GaveWaySum gave_way;
  TickRecord tick;
  while (log.next(tick)) {
    run.ticks.push_back(sample(tick));
    active.add(tick.reading.time, tick.hierarchy);
    gave_way.add(tick.reading.time, tick.hierarchy);
  }
  if (run.ticks.empty())
    throw FileError(log_path + ": the log holds no tick, so there is nothing to report" +
                    (log.problem().empty() ? "" : "; " + log.problem()));
  run.timings = log.timings();
  run.active = std::move(active.times);
  gave_way.move_into(run);
  run.row_names = log.row_names();
  run.summary = log.summary();
  run.problem = log.problem();
  run.num_changes = changes.count();
  run.has_truth = merge(truths, run.ticks);
  lay_plans(run);
  for (const AppliedForce& force : forces.acting()) run.applied.push_back(force);
  std::ranges::stable_sort(run.applied, {}, &AppliedForce::from);
  return run;
}

}  // namespace surefoot
