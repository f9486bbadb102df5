#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/robot_guesses.hpp"
#include "surefoot/config/robot_plausibility.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/guessed_file.hpp"
#include "surefoot/gaits/parts/support_region.hpp"
#include "surefoot/model/physics_urdf.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/simulation/added_sphere.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace surefoot::doctor {
namespace {

/// check_inertias, check_feet and check_limits tell these.
bool is_told_already(const std::string& note, const model::Urdf& urdf) {
  const model::UrdfLink& root = *urdf.find_link(urdf.root);
  return note == model::placeholder_note(root.name, root.inertia.mass) ||
         note.starts_with(model::kUnsoundInertia) || note.starts_with(simulation::kAddedSphere) ||
         note.starts_with(config::kGuessed) || note.ends_with(config::kPlaceholder);
}

/// Where a scenario stands otherwise than it asks; empty: nowhere.
std::string other_knees(const Diagnosis& robot, const char* scenario, std::string_view asked) {
  const auto named = [&](std::string_view name) {
    return std::ranges::find(config::kKnees, name, [](const auto& one) { return one.first; });
  };
  const auto fitting = config::knees_that_fit(*robot.robot, named(asked)->second);
  const auto chosen =
      std::ranges::find(config::kKnees, fitting, [](const auto& one) { return one.second; });
  if (chosen->first == asked) return "";
  return std::string(scenario) + " stands with knees " + std::string(chosen->first) + ", not " +
         std::string(asked);
}

/// Distance of the foot from the HAA axis, and of the foot from the hip, across the HFE axis.
struct Extension {
  double from_haa, from_hip;
};
Extension extension(const model::LegChain& chain, const Vec3& q) {
  Mat3 J;
  (void)chain.foot_in_base(q, &J);
  return {J.col(0).norm(), J.col(1).norm()};
}

Reach reach_of(const Diagnosis& robot, const JointVector& q) {
  Reach reach{.longest = robot.proportions->leg, .from_haa = kInfinity};
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  for (const Leg leg : legs.legs()) {
    const auto [from_haa, from_hip] =
        extension(legs[index(leg)].chain, q.segment<3>(first_joint(leg)));
    reach.from_haa = std::min(reach.from_haa, from_haa / reach.longest);
    if (from_hip / reach.longest <= reach.stretched) continue;
    reach.stretched = from_hip / reach.longest;
    reach.leg = leg;
  }
  return reach;
}

/// A robot falls over feet that its COM is not above, and steps little where it is near their edge.
void check_com(Diagnosis& robot, model::RobotModel& model, const JointVector& q) {
  constexpr double kLeastMargin = 0.15;  // of that in the middle of the feet
  const model::Dynamics& dynamics = model.update(control::level_at_rest(q), Vec3::UnitZ());
  PerLeg<Vec2> feet(dynamics.num_legs(), Vec2(0.0, 0.0));
  Vec2 middle = Vec2::Zero();
  for (const Leg leg : feet.legs()) {
    feet[index(leg)] = dynamics.contact[index(leg)].p.head<2>();
    middle += feet[index(leg)] / dynamics.num_legs();
  }
  const gaits::SupportRegion region(feet, PerLeg<double>(dynamics.num_legs(), 1.0));
  const Vec2 com = (1e4 * dynamics.com.p.head<2>()).array().round() / 1e4 + 0.0;  // no "-0"
  const double margin = region.margin(com);
  if (margin > kLeastMargin * region.margin(middle)) return;
  const bool is_out = margin < 0.0;
  const std::string& heaviest = robot.anatomy.torso;
  robot.findings.push_back(
      {is_out ? Severity::error : Severity::warning, Confidence::likely, "stance", 0,
       formatted("the robot's centre of mass, at x = %.3g, y = %.3g m, is ", com.x(), com.y()) +
           (is_out ? formatted("not over its feet, but %.3g m beside them, so that it falls over",
                               -margin)
                   : formatted("only %.3g m within its feet, so that it hardly lifts one", margin)),
       "check masses and centres of mass, first of \"" + heaviest +
           "\", the heaviest link of the base"});
}

/// On what the start refuses: a shape of a shank below the foot is rarely the foot's.
std::string advice_on(const Diagnosis& robot, std::string_view what) {
  if (!robot.anatomy.legs || what.find(" below the foot sphere ") == std::string_view::npos)
    return "correct what is named";
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    const auto names = [&](const std::string& link) {
      return what.find("link \"" + link + "\"") != std::string_view::npos;
    };
    if (names(leg.foot.link)) return "correct what is named";
    const std::string& shank = leg.joints[2].child;
    if (names(shank))
      return "make the collision shape of \"" + shank + "\" smaller or move it, unless it is \"" +
             leg.foot.link + "\"'s ground contact";
  }
  return "correct what is named";
}

}  // namespace

/// A leg stretched to its end, or whose foot is on the HAA axis, can't be moved in one direction.
void check_singular(Diagnosis& robot) {
  constexpr double kStretched = 0.97, kOnAxis = 0.15;
  const Reach& reach = *robot.reach;
  const std::string leg(leg_name(reach.leg, static_cast<int>(robot.anatomy.legs->size())));
  if (reach.stretched > kStretched) {
    robot.findings.push_back(
        {Severity::warning, Confidence::likely, "stance", 0,
         formatted("%s is stretched to %.0f %% of its reach, %.3g m, so it can't reach down any "
                   "further",
                   leg.c_str(), 100.0 * reach.stretched, reach.longest),
         "a smaller planner.stance.height, or limits of KFE that let the knee be straighter"});
  }
  if (reach.from_haa < kOnAxis) {
    robot.findings.push_back(
        {Severity::warning, Confidence::likely, "stance", 0,
         formatted("a foot is only %.3g m from the axis of its HAA, so HAA hardly moves it",
                   reach.from_haa * reach.longest),
         "another planner.stance.height, or look at the axes of HAA"});
  }
}

void check_stance(Diagnosis& robot) {
  if (!robot.robot) return;
  const bool walks = robot.robot->can_walk();
  const std::string walk = walks ? other_knees(robot, "walk_flat", "x") : "",
                    down = walks ? other_knees(robot, "step_down", "forward") : "";
  const std::string scenario_name = walks ? "walk_flat" : "flat_feet";
  if (!walk.empty() || !down.empty()) {
    robot.findings.push_back(
        {Severity::note, Confidence::certain, "stance", 0,
         "by the limits of KFE " + walk + (walk.empty() || down.empty() ? "" : ", and ") + down,
         ""});
  }
  const GuessedFile file(robot);
  try {
    const config::Scenario scenario = config::load_scenario(
        {.name_or_path = scenario_name, .seed = 0, .assignments = {"robot=" + file.path()}});
    if (walks) {
      model::RobotModel model(scenario.robot);
      const auto q = config::stance_posture(model, scenario.controller.planner.stance);
      robot.reach = reach_of(robot, q);
      check_singular(robot);
      check_com(robot, model, q);
    }
    for (const std::string& note : closed_loop::check_setup(scenario)) {
      if (is_told_already(note, robot.urdf)) continue;
      robot.findings.push_back({Severity::note, Confidence::certain, scenario_name, 0, note, ""});
    }
  } catch (const Error& error) {
    const std::string_view what = error.what();
    if (has_error(robot.findings) && what.find("it can't stand: ") != std::string_view::npos)
      return;
    robot.findings.push_back(
        {Severity::error, of_refusal(robot.findings), scenario_name, 0,
         std::string("the robot can't be stood up: ") + file.without_path(error.what()),
         advice_on(robot, what) + "; `surefoot run " + scenario_name +
             " --check --set robot=FILE` checks it again"});
  }
}

}  // namespace surefoot::doctor
