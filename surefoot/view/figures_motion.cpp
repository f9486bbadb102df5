#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

// Figures over time of how the robot moved.
namespace surefoot::report {
namespace {

using plot::Curve;
using plot::Panel;
using plot::Span;

constexpr double kDegrees = 180.0 / kPi;
constexpr double kMillimetres = 1e3;

std::vector<double> column(const RunData& run,
                           const std::function<double(const TickSample&)>& value) {
  std::vector<double> result(run.ticks.size());
  std::transform(run.ticks.begin(), run.ticks.end(), result.begin(), value);
  return result;
}

std::vector<double> times(const RunData& run) {
  return column(run, [](const TickSample& tick) { return tick.time; });
}

std::string source(const RunData& run) { return run.has_truth ? "true" : "estimated"; }

// Torso against its reference as a rotation vector in C: roll, pitch, yaw.
Vec3 orientation_error(const TickSample& tick) {
  const Quat desired = Quat(tick.R_belief) * tick.plan.torso.q_WB;
  const Eigen::AngleAxisd error(tick.truth.q_WB * desired.conjugate());
  const double angle = error.angle() > kPi ? error.angle() - 2.0 * kPi : error.angle();
  return (tick.R_belief * tick.plan.R_WC).transpose() * (angle * error.axis());
}

double hip_foot_distance(const TickSample& tick, std::size_t leg, bool vertical) {
  const Vec3 p_FH = tick.model.p_WH[leg] - tick.model.p_WF[leg];
  return vertical ? p_FH.z() : p_FH.norm();
}

// Stretches of time in which a leg was in one of two phases.
std::vector<Span> phase_spans(const RunData& run, std::size_t leg, bool stance,
                              const std::string& style) {
  std::vector<Span> spans;
  bool open = false;
  for (const TickSample& tick : run.ticks) {
    const LegPhase phase = tick.plan.feet[leg].phase;
    const bool inside = stance ? in_contact(phase) : phase == LegPhase::search;
    if (inside && !open) spans.push_back({tick.time, tick.time, style});
    if (inside) spans.back().to = tick.time + run.header.control_period;
    open = inside;
  }
  return spans;
}

// Stretches of time in which rows of the limb limits were at their bounds.
std::vector<Span> limit_spans(const RunData& run) {
  std::vector<std::pair<double, double>> times;
  for (const ActiveTime& time : run.active) {
    if (time.level == run.header.limb.level) times.emplace_back(time.from, time.to);
  }
  std::sort(times.begin(), times.end());
  std::vector<Span> spans;
  for (const auto& [from, to] : times) {
    if (spans.empty() || from > spans.back().to) spans.push_back({from, to, "search"});
    spans.back().to = std::max(spans.back().to, to);
  }
  return spans;
}

// Distances of all legs, so that they can be compared, with the limits that are near them: one
// that is far from the curves would squeeze them.
plot::Range limb_range(const RunData& run) {
  const bool vertical = run.header.limb.form == "vertical";
  plot::Range range;
  for (const TickSample& tick : run.ticks) {
    for (std::size_t leg = 0; leg < kNumLegs; ++leg)
      range.add(hip_foot_distance(tick, leg, vertical));
  }
  const plot::Range data = range;
  const double near = 0.5 * data.span();
  for (const double limit : {run.header.limb.min, run.header.limb.max}) {
    if (limit > data.low - near && limit < data.high + near) range.add(limit);
  }
  return range.padded(0.08);
}

Panel limb_panel(const RunData& run, std::size_t leg) {
  const LogLimbLimits& limits = run.header.limb;
  const bool vertical = limits.form == "vertical";
  const std::string name(kLegNames[leg]);
  Panel panel{.title = name + (vertical ? " hip above foot" : " hip–foot distance"),
              .y_label = "distance [m]",
              .curves = {{"", "line c" + std::to_string(leg),
                          column(run,
                                 [&](const TickSample& tick) {
                                   return hip_foot_distance(tick, leg, vertical);
                                 })}},
              .spans = phase_spans(run, leg, true, "stance"),
              .height = 96.0,
              .y_range = limb_range(run)};
  const std::vector<Span> search = phase_spans(run, leg, false, "search");
  panel.spans.insert(panel.spans.end(), search.begin(), search.end());
  for (const double limit : {limits.min, limits.max}) {
    if (!std::isfinite(limit)) continue;
    const bool shown = limit > panel.y_range.low && limit < panel.y_range.high;
    if (shown) panel.bounds.push_back({limit, ""});
    panel.note += (panel.note.empty() ? "limits " : " and ") + plot::decimal(limit, 3) + " m" +
                  (shown ? "" : " (outside)");
  }
  return panel;
}

}  // namespace

plot::Range time_range(const RunData& run) {
  return {run.ticks.front().time, run.ticks.back().time + run.header.control_period};
}

std::vector<plot::Range> calibration_times(const RunData& run) {
  std::vector<plot::Range> times;
  bool open = false;
  for (const TickSample& tick : run.ticks) {
    const bool inside = tick.plan.calibration != CalibrationStage::none;
    if (inside && !open) times.emplace_back();
    if (inside) times.back().add(tick.time);
    if (inside) times.back().add(tick.time + run.header.control_period);
    open = inside;
  }
  return times;
}

bool limb_limits_acted(const RunData& run) { return !limit_spans(run).empty(); }

std::string com_figure(const RunData& run) {
  const auto error = [](const TickSample& tick) {
    return kMillimetres * (centre_of_mass(tick).head<2>() - tick.desired_com).norm();
  };
  // Forward and lateral as seen from the start.
  const Vec2 origin = run.ticks.front().desired_com;
  const Mat3 R_WC = run.ticks.front().R_belief * run.ticks.front().plan.R_WC;
  const auto along = [&](const Vec2& p, int axis) {
    return (p - origin).dot(R_WC.col(axis).head<2>());
  };
  const auto position = [&](const std::string& title, int axis) {
    return Panel{
        .title = title,
        .y_label = "position [m]",
        .curves = {{source(run), "line c0",
                    column(run,
                           [&](const TickSample& t) {
                             return along(centre_of_mass(t).head<2>(), axis);
                           })},
                   {"desired", "line c1 dashed",
                    column(run, [&](const TickSample& t) { return along(t.desired_com, axis); })}},
        .height = 120.0};
  };
  return plot::draw({.description = "Desired and " + source(run) +
                                    " centre of mass over time, with the tracking error below",
                     .x = times(run),
                     .x_range = time_range(run),
                     .calibration = calibration_times(run),
                     .panels = {position("(a) COM, lateral", 1),
                                position("(b) COM, forward", 0),
                                {.title = "(c) COM tracking error in the plane",
                                 .y_label = "error [mm]",
                                 .curves = {{"", "line c3", column(run, error)}},
                                 .height = 110.0,
                                 .from_zero = true}}});
}

std::string adaptation_figure(const RunData& run) {
  std::vector<Panel> panels;
  if (run.has_truth) {
    const auto angle = [&run](int axis) {
      return column(
          run, [axis](const TickSample& tick) { return kDegrees * orientation_error(tick)[axis]; });
    };
    panels.push_back(
        {.title = "(a) orientation error",
         .y_label = "error [°]",
         .curves = {{"roll", "line c0", angle(0)}, {"pitch", "line c1 dashed", angle(1)}},
         .spans = limit_spans(run)});
    panels.push_back({.title = "(b) height error",
                      .y_label = "error [mm]",
                      .curves = {{"", "line c3",
                                  column(run,
                                         [](const TickSample& tick) {
                                           return kMillimetres *
                                                  (tick.truth.p_WB.z() - tick.desired_height);
                                         })}},
                      .spans = limit_spans(run)});
  }
  for (const Leg leg : kLegs) panels.push_back(limb_panel(run, index(leg)));
  return plot::draw(
      {.description =
           "Errors of torso orientation and height, and hip to foot distances with their limits",
       .x = times(run),
       .x_range = time_range(run),
       .calibration = calibration_times(run),
       .panels = panels});
}

std::string torque_figure(const RunData& run) {
  std::vector<Panel> panels;
  for (int joint = 0; joint < kJointsPerLeg; ++joint) {
    const auto j = static_cast<std::size_t>(joint);
    Panel panel{.title = std::string("(") + static_cast<char>('a' + joint) + ") " +
                         std::string(kJointNames[j]),
                .y_label = "torque [N·m]",
                .curves = {}};
    for (const Leg leg : kLegs) {
      panel.curves.push_back(
          {std::string(kLegNames[index(leg)]), "line c" + std::to_string(index(leg)),
           column(run,
                  [&](const TickSample& tick) { return tick.torque[first_joint(leg) + joint]; })});
    }
    const double limit = run.header.robot.torque_limit[joint];
    if (std::isfinite(limit)) panel.bounds = {{limit, "limit"}, {-limit, ""}};
    panels.push_back(panel);
  }
  return plot::draw({.description = "Commanded joint torques with their limits",
                     .x = times(run),
                     .x_range = time_range(run),
                     .calibration = calibration_times(run),
                     .panels = panels});
}

std::string force_figure(const RunData& run) {
  if (!run.has_truth) return "";
  std::vector<Panel> panels;
  for (const Leg leg : kLegs) {
    const std::size_t k = index(leg);
    const auto solution = [k](const TickSample& tick) {
      return tick.plan.R_WC.col(2).dot(tick.model.force[k]);
    };
    const auto truth = [k](const TickSample& tick) { return tick.truth.normal_force[k]; };
    panels.push_back({.title = std::string(kLegNames[k]),
                      .y_label = "force [N]",
                      .curves = {{"true", "line wide c" + std::to_string(k), column(run, truth)},
                                 {"solution", "line fine ink", column(run, solution)}},
                      .spans = phase_spans(run, k, true, "stance"),
                      .height = 84.0,
                      .from_zero = true});
  }
  return plot::draw({.description = "Normal force of each foot",
                     .x = times(run),
                     .x_range = time_range(run),
                     .calibration = calibration_times(run),
                     .panels = panels});
}

}  // namespace surefoot::report
