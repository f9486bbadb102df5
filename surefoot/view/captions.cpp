#include "surefoot/view/captions.hpp"

#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/svg.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::report {

namespace {

std::string times_text(const std::vector<plot::Range>& times) {
  std::string text;
  for (const plot::Range& time : times) {
    text += (text.empty() ? "" : ", ") + plot::decimal(time.low, 1) + " to " +
            plot::decimal(time.high, 1) + " s";
  }
  return text;
}

}  // namespace

std::string time_note(const RunData& run) {
  const std::vector<plot::Range> times = calibration_times(run);
  if (times.empty()) return "";
  return "<p class=\"soft\">The bar at the upper edge of figures over time: the robot calibrates "
         "itself on the spot (" +
         times_text(times) + "), and leans and turns to do so.</p>\n";
}

std::string com_caption(const RunData& run) {
  return std::string(
             "Tracking of the centre of mass, as the paper's Fig. 4: lateral and forward "
             "position, ") +
         (run.has_truth ? "as it truly was, " : "as the controller believed it, ") +
         "against the plan, and the distance between the two in the plane." +
         (run.has_truth ? " The plan is laid into the true world by the feet that stand." : "");
}

std::string adaptation_caption(const RunData& run) {
  const bool has_limits = run.header.limb.level >= 0;
  std::string text = "Adaptation to the terrain, as the paper's Fig. 6. ";
  if (run.has_truth) {
    text += "(a), (b) Errors of the true torso against its reference, in the control frame";
    if (has_limits)
      text +=
          limb_limits_acted(run) ? "; amber: the limb limits act" : "; the limb limits never act";
    text += ". ";
  }
  text += run.has_truth ? "Below, the distance of each hip from its foot"
                        : "The distance of each hip from its foot";
  text += ", as the controller believes it";
  text += has_limits ? ", with the limits of level " + std::to_string(run.header.limb.level + 1)
                     : "; this stack does not limit it";
  const bool searches = std::ranges::any_of(run.ticks, [](const TickSample& tick) {
    return std::ranges::any_of(tick.plan.feet,
                               [](const FootPlan& foot) { return foot.phase == LegPhase::search; });
  });
  return text + ". Grey: by the plan the leg stands" +
         (searches ? ", amber: it searches for ground, white: it swings." : ", white: it swings.");
}

std::string map_caption(const RunData& run) {
  std::string text = run.header.terrain.empty() ? "The walk" : "The walk on its ground";
  text += run.has_truth ? ", as it truly was" : ", as the controller believed it";
  text +=
      ", both views to the same scale. (a) Footprints in the leg's colour (front feet large, hind "
      "feet small), path of the centre of mass, and triangles of three feet that carry the robot "
      "while the fourth swings. (b) Paths of the feet's lowest points, of base and centre of mass";
  if (run.header.terrain.empty()) return text + ".";
  return text +
         ", over the ground under the left and the right feet. Heavy lines are edges of the "
         "ground, lighter ones changes of its slope, grey ones its contours; the lower, the "
         "darker.";
}

std::string residual_caption(const RunData& run) {
  std::string text =
      "Residual of each level over time, √Σ violation², each from 0 to its own largest value at "
      "the right; 0 stands for less than 10⁻⁶. A level that is not zero is kept from its goal by "
      "those above it.";
  const bool restless = std::ranges::any_of(run.header.level_names, [](const std::string& name) {
    return name.ends_with("_minimisation");
  });
  return restless ? text + " * asks for no force or torque at all: never zero by nature." : text;
}

std::string timing_caption(const RunData& run) {
  const double period = 1e6 * run.header.control_period;
  const auto late = std::ranges::count_if(
      run.timings, [&](const TickTiming& timing) { return timing.total > period; });
  const double share =
      100.0 * static_cast<double>(late) / std::max(1.0, static_cast<double>(run.timings.size()));
  return "Wall-clock time of all of the controller's ticks, on a logarithmic axis. The control "
         "period "
         "is " +
         plot::decimal(period, 0) + " µs; " + std::to_string(late) + " of " +
         std::to_string(run.timings.size()) + " ticks (" + plot::decimal(share, 2) +
         " %) took longer, on a machine that promises nothing.";
}

}  // namespace surefoot::report
