// Planners that are written in Python.

#include "python/bindings.hpp"
#include "python/dynamics.hpp"
#include "python/interpreter.hpp"
#include "python/named_command.hpp"
#include "python/numbers.hpp"
#include "python/own_parts.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/config/loaded_gaits.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::python {
namespace {

/// `Planner` in Python.
struct BoundPlanner : BoundPart<gaits::MotionPlanner> {
  std::vector<std::string> gaits{};  ///< of the library's, by name

  /// A command whose gait is found by its name. Throws UnknownNameError if the scenario has none.
  [[nodiscard]] UserCommand with_gait(const NamedCommand& user) const {
    UserCommand command = user;
    if (!user.gait_name.empty()) command.gait = config::gait_place(user.gait_name, gaits);
    return command;
  }
};

class PythonPlanner final : public gaits::MotionPlanner {
 public:
  PythonPlanner(const SharedObject& object, const model::RobotDescription& robot)
      : object_(object), robot_(std::make_shared<Robot>(robot)) {
    (void)nb::try_cast<BoundPlanner*>(*object, base_);
  }

  const MotionPlan& update(const UserCommand& user, const RobotState& state,
                           const model::Dynamics& dynamics, const HierarchyOutcome& last) override {
    in_python([&] {
      const nb::object result = (*object_).attr("update")(NamedCommand(user), state,
                                                          NamedDynamics{robot_, dynamics}, last);
      plan_ = result_of<MotionPlan>(*object_, "update", "MotionPlan", result);
    });
    return plan_;
  }
  void restart() override {
    in_python([&] { (*object_).attr("restart")(); });
  }
  int steps_taken() const noexcept override { return library() ? library()->steps_taken() : 0; }
  void set_friction(double friction) override {
    library() ? library()->set_friction(friction) : MotionPlanner::set_friction(friction);
  }
  Vec3 terrain_normal(const MotionPlan& last) const noexcept override {
    return library() ? library()->terrain_normal(last) : MotionPlanner::terrain_normal(last);
  }
  bool restarts() const noexcept override { return library() && library()->restarts(); }
  bool is_undisturbed(const RobotState& state) const noexcept override {
    return library() && library()->is_undisturbed(state);
  }
  void tell_calibration_known(bool known) noexcept override {
    if (library()) library()->tell_calibration_known(known);
  }

 private:
  /// That of the object; null: it asks none.
  [[nodiscard]] gaits::MotionPlanner* library() const {
    return base_ == nullptr ? nullptr : base_->library.get();
  }

  SharedObject object_;
  std::shared_ptr<Robot> robot_;
  BoundPlanner* base_ = nullptr;
  MotionPlan plan_;
};

MotionPlan standing_plan(const NamedDynamics& dynamics, double time, double friction,
                         double force_max) {
  check_finite(time, "time");
  for (const auto& [value, name] : {std::pair(friction, std::string("friction")),
                                    std::pair(force_max, std::string("force_max"))}) {
    check_finite(value, name);
    if (value < 0.0)
      throw Error(name + formatted(" is %g; a number of at least 0 would be valid", value));
  }
  const model::Dynamics& now = dynamics.values;
  const int num_legs = now.num_legs();
  MotionPlan plan;
  plan.time = time;
  plan.feet.resize(num_legs);
  Vec3 center = Vec3::Zero();
  for (const Leg leg : now.foot.legs()) {
    FootPlan& foot = plan.feet[index(leg)];
    foot.p_WF = now.foot[index(leg)].p;
    foot.force_max = force_max;
    foot.friction = friction;
    center += foot.p_WF / num_legs;
  }
  const Vec3 forward = now.base_rotation.R.col(0);
  const double yaw = std::atan2(forward.y(), forward.x());
  plan.R_WC = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
  plan.torso.q_WB = Quat(plan.R_WC);
  plan.torso.height = now.base.p.z();
  plan.com.p = plan.com.zmp = center.head<2>();
  plan.terrain_point = center;
  return plan;
}

}  // namespace

void bind_planner(nb::module_& module) {
  nb::class_<HierarchyOutcome>(module, "HierarchyOutcome",
                               "What the hierarchy made of the plan before.")
      .def_ro("tilt_shortfall", &HierarchyOutcome::tilt_shortfall,
              "unmet share of the torso's roll and pitch acceleration [rad/s²]; NaN: not known");
  using Self = BoundPlanner;
  nb::class_<Self>(module, "Planner",
                   "Plans the motion that the tasks follow. Derive your own and write update(); of "
                   "what it raises the\ncontroller tells you, holds its posture, then sits down.",
                   nb::type_slots(kNoVectorcall))
      .def(nb::init<>())
      .def(
          "__init__",
          [](Self* self, const config::Scenario& scenario) {
            new (self) Self{{[options = scenario.controller, scale = scenario.robot.scale] {
                               return gaits::make_planner(options.planner, options.period, scale,
                                                          options.gaits, options.first_gait);
                             },
                             scenario.robot.name},
                            config::gait_names(scenario.controller.gaits)};
          },
          nb::arg("scenario"), "With the library's, which super().update() then asks.")
      .def(
          "update",
          [](Self& self, const NamedCommand& user, const RobotState& state,
             const NamedDynamics& dynamics, const HierarchyOutcome& last) {
            if (!self.library)
              throw Error(
                  "Planner() plans nothing by itself: write update(), or give it a scenario");
            return self.library->update(self.with_gait(user), state, dynamics.values, last);
          },
          nb::arg("user"), nb::arg("state"), nb::arg("dynamics"), nb::arg("last"),
          "A tick: the plan now. `dynamics` is the robot at `state`.")
      .def(
          "restart",
          [](Self& self) {
            if (self.library) self.library->restart();
          },
          "Forgets all plans: called when a controller is made with it, and where the robot may "
          "stand elsewhere.");
  module.def(
      "standing_plan", &standing_plan, nb::arg("dynamics"), nb::arg("time") = 0.0,
      nb::arg("friction") = 0.5, nb::arg("force_max") = 1000.0,
      "A plan to begin with: all feet stand where they are, the torso is level at its height, "
      "the centre of mass between the feet.");
}

std::unique_ptr<gaits::MotionPlanner> own_planner(const SharedObject& object,
                                                  const model::RobotDescription& robot) {
  begin_anew<BoundPlanner>(object, "user, state, dynamics, last", robot);
  const Interpreter::Locked python;
  return std::make_unique<PythonPlanner>(object, robot);
}

}  // namespace surefoot::python
