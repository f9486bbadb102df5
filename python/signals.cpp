#include "python/bindings.hpp"
#include "python/field_properties.hpp"
#include "python/joint_command.hpp"
#include "python/named_command.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/signals/tick_context.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <optional>
#include <variant>

namespace surefoot::python {

namespace {

void check_num_legs(int num_legs) {
  if (num_legs == 2 || num_legs == 4 || num_legs == 6) return;
  throw Error("num_legs is " + std::to_string(num_legs) + "; a robot has 2, 4 or 6 legs");
}

SensorReading sensor_reading(int num_joints, int num_legs) {
  check_num_legs(num_legs);
  if (num_joints < 1 || num_joints > kMaxJoints)
    throw Error("num_joints is " + std::to_string(num_joints) + "; a robot has 1 to " +
                std::to_string(kMaxJoints) + " joints");
  SensorReading reading;
  reading.q = reading.torque = JointVector::Constant(num_joints, kNaN);
  reading.foot_force = per_leg(kNaN, num_legs);
  return reading;
}

RobotState robot_state(int num_joints, int num_legs) {
  RobotState state;
  state.q = state.qd = state.torque = sensor_reading(num_joints, num_legs).q;
  state.size_legs(num_legs);
  state.foot_force = per_leg<Vec3>(Vec3::Constant(kNaN), num_legs);
  return state;
}

using Gait = std::variant<int, std::string>;

Gait gait_of(const NamedCommand& self) {
  if (self.gait_name.empty()) return self.gait;
  return self.gait_name;
}

void set_gait(NamedCommand& self, const Gait& gait) {
  const int* place = std::get_if<int>(&gait);
  self.gait = place == nullptr ? UserCommand::kOwnGait : *place;
  self.gait_name = place == nullptr ? std::get<std::string>(gait) : "";
}

void bind_context(nb::module_& module) {
  nb::class_<FootContact>(module, "FootContact", "A foot at the tick before.")
      .def_ro("carries", &FootContact::carries, "the plan lets it carry load")
      .def_ro("normal_force", &FootContact::normal_force, "estimated [N]")
      .def_ro("slips", &FootContact::slips, "it is believed to slide");
  nb::class_<TickContext> context(module, "TickContext",
                                  "What a state estimator knows besides the readings.");
  context
      .def_prop_ro(
          "contacts",
          [](const TickContext& self) {
            nb::typed<nb::dict, std::string, FootContact> legs;
            const auto num_legs = static_cast<int>(self.contacts.size());
            for (const Leg leg : self.contacts.legs())
              legs[nb::cast(leg_name(leg, num_legs))] = nb::cast(self.contacts[index(leg)]);
            return legs;
          },
          "by leg, at the tick before")
      .def_ro("joint_lag", &TickContext::joint_lag, "age of the joint samples [s]")
      .def_ro("imu_lag", &TickContext::imu_lag, "age of the IMU's [s]")
      .def_ro("restarts", &TickContext::restarts,
              "all feet stand: begin anew, but keep position and heading")
      .def_ro("off_its_feet", &TickContext::off_its_feet, "lifted, or lying");
  def_view(context, "joint_velocity", &TickContext::joint_velocity,
           "from the encoders, observed [rad/s]");
}

void bind_frames(nb::module_& module) {
  nb::class_<FrameList>(module, "FrameList", "The frames of a plan; what is written into it stays.")
      .def("__len__", [](const FrameList& self) { return self.count; })
      .def(
          "__getitem__",
          [](FrameList& self, nb::ssize_t place) -> FramePlan& {
            const auto count = static_cast<nb::ssize_t>(self.count);
            const nb::ssize_t from_begin = place < 0 ? place + count : place;
            if (from_begin < 0 || from_begin >= count)
              throw nb::index_error(
                  formatted("there is no frame %d, of %d", int(place), int(count)).c_str());
            return self.items[static_cast<std::size_t>(from_begin)];
          },
          nb::arg("place"), nb::rv_policy::reference_internal)
      .def(
          "__iter__",
          [](nb::handle_t<FrameList> self) {
            nb::list frames;
            for (std::size_t i = 0; i < nb::len(self); ++i) frames.append(self[i]);
            return nb::iter(frames);
          },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[FramePlan]"))
      .def("append", &append, nb::arg("frame"), "Adds one at the end; a plan has at most 6.")
      .def(
          "extend",
          [](FrameList& self, const std::vector<FramePlan>& frames) {
            for (const FramePlan& frame : frames) append(self, frame);
          },
          nb::arg("frames"), "Adds some at the end.")
      .def(
          "__iadd__",
          [](nb::handle_t<FrameList> self, const std::vector<FramePlan>& frames) {
            for (const FramePlan& frame : frames) append(*nb::inst_ptr<FrameList>(self), frame);
            return self;
          },
          nb::sig("def __iadd__(self, arg: collections.abc.Sequence[FramePlan], /) -> FrameList"))
      .def(
          "__add__",
          [](nb::handle_t<FrameList> self, const nb::list& frames) {
            return nb::list(self) + frames;
          },
          nb::sig("def __add__(self, arg: list[FramePlan], /) -> list[FramePlan]"))
      .def(
          "__reduce__",
          [](nb::handle_t<FrameList> self) {
            return nb::make_tuple(nb::borrow(reinterpret_cast<PyObject*>(&PyList_Type)),
                                  nb::make_tuple(nb::list(self)));
          },
          nb::sig("def __reduce__(self) -> tuple[type[list[FramePlan]], tuple[list[FramePlan]]]"))
      .def("__repr__", [](nb::handle_t<FrameList> self) { return nb::repr(nb::list(self)); });
}

}  // namespace

void bind_signals(nb::module_& module) {
  signal<SensorReading>(module, "SensorReading", "What the robot's sensors give at one tick.")
      .def(
          "__init__",
          [](SensorReading* self, int num_joints, int num_legs) {
            new (self) SensorReading(sensor_reading(num_joints, num_legs));
          },
          nb::arg("num_joints") = kNumLegJoints, nb::arg("num_legs") = kNumLegs,
          "All unknown. Of the robot: len(scenario.joint_names), and len(robot.legs).");

  signal<ReachCommand>(module, "ReachCommand",
                       "Where the tip of an arm shall be, or a frame that a task of the stack "
                       "follows. An arm or\nframe that is not there follows nothing: plan.arm.arm "
                       "stays -1.")
      .def(
          "__init__",
          [](ReachCommand* self, int arm, const std::vector<double>& position, bool in_world,
             const std::optional<std::vector<double>>& orientation, int frame) {
            ReachCommand command{.arm = arm, .in_world = in_world, .frame = frame};
            assign(command.position, position, "position", true);
            if (orientation) assign(command.orientation, *orientation, "orientation", false);
            new (self) ReachCommand(command);
          },
          nb::arg("arm") = -1, nb::arg("position") = std::vector<double>(3),
          nb::arg("in_world") = false, nb::arg("orientation") = nb::none(), nb::arg("frame") = -1,
          "frame: instead of an arm, its place in robot.frames; it stays there when other commands "
          "follow.");

  nb::class_<NamedCommand> user =
      signal<NamedCommand, UserCommand>(module, "UserCommand", "What the operator asks for.")
          .def(
              "__init__",
              [](NamedCommand* self, bool walk, const std::vector<double>& velocity,
                 double yaw_rate, double height, bool calibrate, const ReachCommand& reach,
                 const std::vector<double>& shift, const Gait& gait) {
                NamedCommand command(UserCommand{.walk = walk,
                                                 .yaw_rate = yaw_rate,
                                                 .height = height,
                                                 .calibrate = calibrate,
                                                 .reach = reach});
                assign(command.velocity, velocity, "velocity", true);
                assign(command.shift, shift, "shift", true);
                check_finite(yaw_rate, "yaw_rate");
                check_finite(height, "height");
                set_gait(command, gait);
                new (self) NamedCommand(command);
              },
              nb::arg("walk") = false, nb::arg("velocity") = std::vector<double>(2),
              nb::arg("yaw_rate") = 0.0, nb::arg("height") = 0.0, nb::arg("calibrate") = false,
              nb::arg("reach").sig("ReachCommand()") = ReachCommand(),
              nb::arg("shift") = std::vector<double>(2), nb::arg("gait") = UserCommand::kOwnGait,
              "gait: one of scenario.gaits, by its name or its place, or \"auto\": by the speed; "
              "-1: "
              "the scenario's own.");
  user.def_prop_rw("gait", &gait_of, &set_gait,
                   nb::for_getter(nb::sig("def gait(self) -> int | str")),
                   "one of scenario.gaits, by its name or its place, or \"auto\"; -1: the "
                   "scenario's own; -3: the present one. A controller refuses one that its "
                   "scenario has not.");

  signal<JointCommand>(module, "JointCommand", "Torques for the actuators at one tick.")
      .def(
          "__init__",
          [](JointCommand* self, const JointNumbers& torque) {
            new (self) JointCommand(joint_command(torque));
          },
          nb::arg("torque") = JointNumbers(kNumLegJoints));

  signal<GroupHealth>(module, "GroupHealth", "How one group of sensors is at one tick.");
  signal<SensorHealth>(module, "SensorHealth", "How the readings of one tick are.");
  signal<RobotState>(module, "RobotState", "The state that the controller believes.")
      .def(
          "__init__",
          [](RobotState* self, int num_joints, int num_legs) {
            new (self) RobotState(robot_state(num_joints, num_legs));
          },
          nb::arg("num_joints") = kNumLegJoints, nb::arg("num_legs") = kNumLegs,
          "All unknown, for an estimator to fill in; the controller writes foot_force, external "
          "forces and slips itself.");
  bind_context(module);
  signal<FootPlan>(module, "FootPlan", "Reference of one foot F, the centre of its sphere, in W.");
  signal<TorsoPlan>(module, "TorsoPlan", "Reference of the torso.");
  signal<ArmPlan>(module, "ArmPlan", "Reference of the tip of an arm, in W.");
  signal<FramePlan>(module, "FramePlan",
                    "Reference of a frame F in X, which is the base or W: MotionPlan.frames.")
      .def(nb::init<>());
  bind_frames(module);
  signal<ComPlan>(module, "ComPlan", "Reference of the centre of mass, x and y in W.");
  signal<NamedEvent, GaitEvent>(module, "GaitEvent", "Something that happened at a tick.")
      .def_prop_ro(
          "name", [](const NamedEvent& self) { return name(self.kind); }, "`event` in words");
  signal<MotionPlan>(module, "MotionPlan", "Everything that the tasks follow at one tick.")
      .def(
          "__init__",
          [](MotionPlan* self, int num_legs) {
            check_num_legs(num_legs);
            new (self) MotionPlan();
            self->feet.resize(num_legs);
          },
          nb::arg("num_legs") = kNumLegs, "All zero; standing_plan() is a plan to begin with.");
  signal<ModelRecord>(module, "ModelRecord",
                      "What the controller's model says of the robot at one tick.");
  signal<TickTiming>(module, "TickTiming", "Wall-clock time of the stages of one tick [µs].");
  signal<simulation::TrueContact>(module, "TrueContact",
                                  "What really touches the ground at a foot.");
  signal<simulation::GroundTruth>(module, "GroundTruth",
                                  "What the simulator knows and no sensor says, in its world S.");
  signal<evaluation::WorldPose>(module, "WorldPose", "Where S lies in the controller's world W.");
  signal<evaluation::Alignment>(
      module, "Alignment", "How the two worlds lie, and the errors of plan and estimate by that.");
}

}  // namespace surefoot::python
