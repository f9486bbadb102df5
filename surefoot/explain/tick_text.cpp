#include "surefoot/base/formatted.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/explain/gave_way.hpp"
#include "surefoot/explain/lying_text.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/logging/stop_text.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::explain {
namespace {

using Table = std::vector<std::vector<std::string>>;

constexpr double kDegrees = 180.0 / kPi;

/// To a multiple of `unit`; what is rounded to zero has no sign.
double rounded(double value, double unit) {
  const double result = std::round(value / unit) * unit;
  return result == 0.0 ? 0.0 : result;
}

std::string known(double value, const char* format) {
  return std::isnan(value) ? "–" : formatted(format, value);
}

std::string pose(const Vec3& p, const Quat& q) {
  if (!p.allFinite() || !q.coeffs().allFinite()) return "not known";
  const Mat3 R = q.toRotationMatrix();
  const Vec3 angles = roll_pitch_yaw(R) * kDegrees;
  const double tilt = std::acos(std::clamp(R(2, 2), -1.0, 1.0)) * kDegrees;
  return formatted("x %.3f, y %.3f, z %.3f m; roll %.1f°, pitch %.1f°, yaw %.1f°; tilt %.1f°",
                   rounded(p.x(), 1e-3), rounded(p.y(), 1e-3), rounded(p.z(), 1e-3),
                   rounded(angles.x(), 0.1), rounded(angles.y(), 0.1), rounded(angles.z(), 0.1),
                   tilt);
}

std::string velocity(const Vec3& v, const Vec3& w) {
  if (!v.allFinite() || !w.allFinite()) return "not known";
  return formatted("%.3f, %.3f, %.3f m/s; turns by %.3f, %.3f, %.3f rad/s", rounded(v.x(), 1e-3),
                   rounded(v.y(), 1e-3), rounded(v.z(), 1e-3), rounded(w.x(), 1e-3),
                   rounded(w.y(), 1e-3), rounded(w.z(), 1e-3));
}

/// The payload; empty if it is unknown or within the error of its estimate. The place of a light
/// one is not known well enough.
std::string carried(const BaseLoad& load, double robot_mass) {
  constexpr double kMinShare = 1.0 / 60.0, kMinShareWithPlace = 1.0 / 30.0;  // of the robot's mass
  const double mass = std::abs(load.mass);
  if (!(mass >= kMinShare * robot_mass) || !load.first_moment.allFinite()) return "";
  const std::string much =
      formatted("%.1f kg %s than described", mass, load.mass > 0.0 ? "more" : "less");
  if (!(load.mass >= kMinShareWithPlace * robot_mass)) return much;
  const Vec3 at = load.first_moment / load.mass;
  return much + formatted(", at x %.2f, y %.2f, z %.2f m in B", rounded(at.x(), 0.01),
                          rounded(at.y(), 0.01), rounded(at.z(), 0.01));
}

std::string place(const Vec3& p) {
  return formatted("x %.3f, y %.3f, z %.3f m", rounded(p.x(), 1e-3), rounded(p.y(), 1e-3),
                   rounded(p.z(), 1e-3));
}

/// Of an arm or a frame that follows the operator; empty without one.
std::string reach(const TickExplanation& explanation) {
  const TickRecord& tick = explanation.tick;
  const ReachCommand& command = tick.user.reach;
  const FramePlan* frame = tick.plan.frames.find(command.frame);
  if (command.arm < 0 && command.frame < 0) return "";
  const std::string wanted =
      (command.arm >= 0 ? "arm " + std::to_string(command.arm)
                        : explanation.header.robot.frame_name(command.frame)) +
      " to " + place(command.position) + (command.in_world ? " in W" : " in B");
  Vec3 reference = Vec3::Constant(kNaN);  // in the command's frame
  if (command.arm >= 0 && tick.plan.arm.arm == command.arm) {
    const Vec3 from_base = tick.state.q_WB.conjugate() * (tick.plan.arm.p_WT - tick.state.p_WB);
    reference = command.in_world ? tick.plan.arm.p_WT : from_base;
  } else if (command.arm < 0 && frame != nullptr && frame->in_world == command.in_world) {
    reference = frame->p_XF;
  }
  if (!reference.allFinite()) return wanted + ", which nothing follows";
  return wanted +
         formatted("; the reference is %.1f cm from there, at ",
                   100.0 * (command.position - reference).norm()) +
         place(reference);
}

std::string asked(const UserCommand& user) {
  if (!user.walk) return formatted("stands, height %+g m", user.height);
  return formatted("walks, %g m/s forward, %g m/s to the left, turns by %g rad/s, height %+g m",
                   user.velocity.x(), user.velocity.y(), user.yaw_rate, user.height);
}

std::string largest_torque(const TickExplanation& explanation) {
  Eigen::Index joint = 0;
  const logging::LogRobot& robot = explanation.header.robot;
  const double torque = explanation.tick.command.torque.cwiseAbs().maxCoeff(&joint);
  return formatted("largest torque %.1f N·m", torque) + " at " +
         robot.joint_names[static_cast<std::size_t>(joint)] +
         formatted(" of %g", robot.torque_limit[joint]);
}

std::string faults(const TickExplanation& explanation) {
  std::string out;
  for (const logging::FaultText& fault :
       logging::faults_of(explanation.tick.health, explanation.header.robot.joints()))
    out += (out.empty() ? "" : ", ") + fault.text + formatted(" (last good %.4f s ago)", fault.age);
  return out.empty() ? "sensors are good" : "sensors now: " + out;
}

bool is_beyond_limits(const TickExplanation& explanation, Leg leg) {
  return beyond_limits(explanation.forces, explanation.tick.plan, leg) != Beyond::nothing;
}

bool asks_beyond_limits(const TickExplanation& explanation) {
  return explanation.tick.command.mode == CommandMode::optimal &&
         logging::was_used(explanation.tick) &&
         std::ranges::any_of(explanation.forces.normal.legs(),
                             [&](Leg leg) { return is_beyond_limits(explanation, leg); });
}

std::string command(const TickExplanation& explanation) {
  const TickRecord& tick = explanation.tick;
  std::string out(logged::kModeNames[static_cast<std::size_t>(tick.command.mode)]);
  const std::string why = logging::text_of_stop(tick, explanation.header.robot.joints());
  if (!why.empty()) out += ", as " + why;
  if (asks_beyond_limits(explanation)) out += ", but for contact forces that no ground gives";
  return out + "; " + largest_torque(explanation) + "; " + faults(explanation);
}

std::string facts(const TickExplanation& explanation) {
  const TickRecord& tick = explanation.tick;
  Table table{{"base in W", pose(tick.state.p_WB, tick.state.q_WB)},
              {"moves by", velocity(tick.state.v_WB, tick.state.w_WB_B)}};
  const std::string load = carried(tick.model.load, explanation.header.robot.assumed_mass());
  if (!load.empty()) table.push_back({"weighs", load});
  if (explanation.truth)
    table.push_back({"truth in S", pose(explanation.truth->p_SB, explanation.truth->q_SB)});
  if (explanation.estimate)
    table.push_back(
        {"is off by", formatted("%.1f cm, %.1f° in heading, counted from the first tick",
                                100.0 * explanation.estimate->position_error,
                                std::abs(explanation.estimate->heading_error) * kDegrees)});
  const std::string lying = explanation.touch ? lying_text(*explanation.touch) : "";
  if (!lying.empty())
    table.push_back({"lies on", lying + formatted(" (truth, last %g s)", kLyingWindow)});
  for (const logging::AppliedForce& force : explanation.applied)
    table.push_back({"pushed by", logging::applied_force_text(force, explanation.bodies) +
                                      " (truth: the controller is not told)"});
  table.push_back({"asked", asked(tick.user)});
  const std::string reaches = reach(explanation);
  if (!reaches.empty()) table.push_back({"reaches", reaches});
  table.push_back({"command", command(explanation)});
  std::string out;
  for (const std::vector<std::string>& row : table)
    out += row[0] + std::string(12 - row[0].size(), ' ') + row[1] + "\n";
  return out;
}

std::string true_force(const simulation::TrueContact& contact) {
  if (!contact.touching) return "in the air";
  return formatted("%.1f N", rounded(contact.normal.dot(contact.force), 0.1));
}

template <typename T>
std::string name_of(Leg leg, const PerLeg<T>& list) {
  return std::string(leg_name(leg, static_cast<int>(list.size())));
}

/// Of a tick whose command is no solution: plan and commanded forces mean nothing there.
std::string true_feet_table(const simulation::GroundTruth& truth, double least_load) {
  Table table{{"foot", "in truth", "friction used"}};
  for (const Leg leg : truth.feet.legs()) {
    const simulation::TrueContact& contact = truth.feet[index(leg)];
    table.push_back({name_of(leg, truth.feet), true_force(contact),
                     known(100.0 * true_friction_use(contact, least_load), "%.0f %%")});
  }
  return aligned(table);
}

std::string feet_table(const TickExplanation& explanation) {
  const TickRecord& tick = explanation.tick;
  const bool is_marked = asks_beyond_limits(explanation);
  Table table{{"foot", "phase", "normal force", "of at most", "pyramid used", "slides"}};
  if (explanation.truth) {
    for (const char* title : {"in truth", "friction used"}) table[0].emplace_back(title);
  }
  for (const Leg leg : tick.plan.feet.legs()) {
    const std::size_t k = index(leg);
    const FootPlan& foot = tick.plan.feet[k];
    const bool carries = in_contact(foot.phase);
    table.push_back({name_of(leg, tick.plan.feet),
                     std::string(logged::kPhaseNames[static_cast<std::size_t>(foot.phase)]),
                     known(rounded(explanation.forces.normal[k], 0.1), "%.1f N") +
                         (is_marked && is_beyond_limits(explanation, leg) ? " *" : ""),
                     carries ? formatted("%.0f N", foot.force_max) : "–",
                     known(100.0 * explanation.forces.friction_use[k], "%.0f %%"),
                     tick.state.slips[k] ? "yes" : "no"});
    if (!explanation.truth) continue;
    const simulation::TrueContact& contact = explanation.truth->feet[k];
    table.back().push_back(true_force(contact));
    table.back().push_back(known(
        100.0 * true_friction_use(contact, explanation.header.robot.least_load()), "%.0f %%"));
  }
  return aligned(table) +
         (is_marked ? "* the solution's wish, beyond the foot's limits: no ground gives it\n" : "");
}

/// With the level's unit; three digits, from 100 on all before the point.
std::string amount(const TickExplanation& explanation, std::int16_t level, double value) {
  const std::string unit = explanation.header.level_unit(level);
  return formatted(std::abs(value) < 100.0 ? "%.3g" : "%.0f", value) +
         (unit.empty() ? "" : " " + unit);
}

std::string residual(const TickExplanation& explanation, std::int16_t level) {
  const double value = explanation.tick.hierarchy.levels[static_cast<std::size_t>(level)].residual;
  return value > kResidualRounding ? amount(explanation, level, value) : "0";
}

/// A level that minimises forces or torques always has a residual; it is called "minimised", as on
/// the viewer's page.
std::string status_of(const TickExplanation& explanation, std::size_t place) {
  const logging::LevelStatus status = level_status(explanation, place);
  const logging::LogHeader& header = explanation.header;
  const std::int16_t level = explanation.order[place];
  const bool is_minimised = std::isnan(header.visible(level));
  return status == logging::LevelStatus::missed && is_minimised
             ? "minimised"
             : std::string(logging::name_of(status));
}

std::string level_table(const TickExplanation& explanation) {
  const HierarchyReport& report = explanation.tick.hierarchy;
  const std::size_t solved = logging::solved_levels(explanation.tick, explanation.order).size();
  Table table{
      {"level", "status", "residual", "rows", "at a bound", "freedom left", "iterations", "time"}};
  for (std::size_t place = 0; place < explanation.order.size(); ++place) {
    const std::int16_t number = explanation.order[place];
    const std::string name =
        std::to_string(place + 1) + " " + explanation.header.level_name(number);
    const std::string status = status_of(explanation, place);
    if (place >= solved) {
      table.push_back({name, status, "–", "–", "–", "–", "–", "–"});
      continue;
    }
    const auto k = static_cast<std::size_t>(number);
    const LevelReport& level = report.levels[k];
    table.push_back(
        {name, status, residual(explanation, number), std::to_string(level.num_rows),
         std::to_string(level.num_active), std::to_string(level.degrees_of_freedom_left),
         std::to_string(level.iterations), known(level_time(explanation, k), "%.1f µs")});
  }
  return aligned(table);
}

std::string full_name(const TickExplanation& explanation, std::int16_t level, std::int32_t id) {
  return explanation.header.level_name(level) + " " + row_name(explanation, level, id);
}

std::string at_bounds(const TickExplanation& explanation) {
  const std::vector<ActiveRow> rows = rows_at_bounds(explanation);
  const std::size_t solved = logging::solved_levels(explanation.tick, explanation.order).size();
  const bool is_all = solved == explanation.order.size();
  if (rows.empty() && !is_all)
    return solved == 0 ? "" : "In the levels that were solved no limit acts.\n";
  if (rows.empty()) return "No limit acts.\n";
  std::string out =
      is_all ? "Limits that act:\n" : "Limits that act in the levels that were solved:\n";
  for (const ActiveRow& row : rows) {
    const bool is_beyond = std::abs(row.state) > 1;
    out += "  " + full_name(explanation, row.level, row.id) +
           (is_beyond ? ", beyond its " : ", at its ") +
           (row.state < 0 ? "lower bound" : "upper bound") +
           (is_beyond && !std::isnan(row.by)
                ? " by " + amount(explanation, row.level, std::abs(row.by))
                : "") +
           "\n";
  }
  return out;
}

/// Rows of levels that gave way; levels that minimise always miss their rows and are left out.
std::string missed(const TickExplanation& explanation) {
  std::string out;
  for (const MissedEquality& row : missed_rows(explanation)) {
    if (!(std::abs(row.by) > explanation.header.visible(row.level))) continue;
    out += "  " + full_name(explanation, row.level, row.id) + ", by " +
           amount(explanation, row.level, row.by) + "\n";
  }
  return out.empty() ? "" : "Rows that were missed:\n" + out;
}

std::string nearby(const TickExplanation& explanation) {
  if (explanation.events.empty()) return "";
  std::string out = formatted("Events within %g s:\n", kEventWindow);
  for (const NearbyEvent& event : explanation.events) {
    out += formatted("  %9.4f s  %+.4f s  ", event.time,
                     rounded(event.time - explanation.tick.reading.time, 1e-6)) +
           (event.leg.empty() ? "" : event.leg + ": ") + event.text + "\n";
  }
  return out;
}

}  // namespace

std::string TickExplanation::text() const {
  std::string out = log + ": " + header.scenario + ", seed " + std::to_string(header.seed) +
                    ", stack " + header.stack + formatted(", at %.4f s\n\n", tick.reading.time);
  if (is_behind_end)
    out += formatted("The log ends before %.6g s: this is its last tick.\n\n", asked);
  out += sentence() + "\n\n" + facts(*this) + "\n";
  if (logging::was_used(tick)) {
    out += feet_table(*this) + "\n";
    if (tick.hierarchy.num_levels > 0) out += level_table(*this) + "\n";
    out += at_bounds(*this) + missed(*this);
  } else if (truth) {
    out += true_feet_table(*truth, header.robot.least_load()) + "\n";
  }
  out += nearby(*this);
  if (!problem.empty()) out += "The log is not whole: " + problem + ".\n";
  return out;
}

}  // namespace surefoot::explain
