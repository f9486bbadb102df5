#include "python/robot.hpp"

#include "python/bindings.hpp"
#include "python/dynamics.hpp"
#include "python/numbers.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/robot_file.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace surefoot::python {

Robot::Robot(const std::string& name_or_path) : file_(name_or_path) {
  const std::string kind = std::filesystem::path(name_or_path).extension();
  const bool is_description = kind == ".urdf" || kind == ".xml";
  if (is_description) {
    guess(doctor::examine(name_or_path));
  } else {
    file_ = config::find_data_file("robots", name_or_path);
    description_ = config::load_robot(file_);
  }
  source_ = std::filesystem::absolute(is_description ? name_or_path : file_);
}

Robot::Robot(const doctor::Diagnosis& diagnosis) { guess(diagnosis); }

Robot::Robot(model::RobotDescription description)
    : description_(std::move(description)), file_(description_.name) {}

void Robot::guess(const doctor::Diagnosis& diagnosis) {
  if (!diagnosis.robot) {
    std::string errors;
    for (const doctor::Finding& finding : diagnosis.findings) {
      if (finding.severity == doctor::Severity::error)
        errors += "\n  " + finding.subject + ": " + finding.what;
    }
    throw Error(diagnosis.given + " can't be made to walk:" + errors +
                "\nprint(surefoot.doctor(…)) says all");
  }
  guessed_ = std::make_shared<doctor::GuessedFile>(diagnosis);
  file_ = guessed_->path();
  try {
    description_ = config::load_robot(file_);
  } catch (const Error& error) {
    throw Error(guessed_->without_path(error.what()));
  }
}

model::RobotModel& Robot::model() {
  if (!model_) model_.emplace(description_);
  return *model_;
}

const model::Frames& Robot::frames() {
  if (!frames_) frames_.emplace(description_);
  return *frames_;
}

namespace {

using Numbers = std::optional<std::vector<double>>;

std::string joints_of(const model::RobotDescription& robot) {
  const std::vector<std::string> names = robot.joint_names();
  return std::to_string(names.size()) + " numbers, one for each joint from " + names.front() +
         " to " + names.back();
}

template <typename Vector>
void take(const Numbers& given, Vector&& values, const std::string& name,
          const std::string& expected) {
  if (!given) return;
  if (static_cast<Eigen::Index>(given->size()) != values.size()) {
    throw Error(name + " has " + expected + "; " + std::to_string(given->size()) + " were given");
  }
  assign(values, *given, name, true);
}

NamedDynamics at(const std::shared_ptr<Robot>& robot, const RobotState& state,
                 const Vec3& terrain_normal) {
  model::RobotModel& model = robot->model();
  if (state.q.size() != robot->description().num_joints())
    throw Error("the state has " + std::to_string(state.q.size()) + " joints; " +
                robot->description().name + " has " + joints_of(robot->description()));
  if (!state.p_WB.allFinite() || !state.q_WB.coeffs().allFinite() || !state.u().allFinite() ||
      !state.q.allFinite())
    throw Error("the state has NaN or infinite numbers in p_WB, q_WB, v_WB, w_WB_B, q or qd");
  return {robot, model.update(state, terrain_normal)};
}

void check_world(const std::string& world) {
  if (world.empty() || world == "W" || world == "S") return;
  throw UnknownNameError("world is \"" + world +
                         "\"; valid are: W, the controller's, S, the simulator's, and \"\", none "
                         "of them");
}

NamedDynamics dynamics(const std::shared_ptr<Robot>& robot, const Numbers& q, const Numbers& u,
                       const std::vector<double>& p_WB, const std::vector<double>& q_WB,
                       const std::vector<double>& terrain_normal, const std::string& world) {
  check_world(world);
  const model::RobotDescription& description = robot->description();
  const int n = description.num_joints();
  RobotState state;
  assign(state.p_WB, p_WB, "p_WB", true);
  state.q_WB = quaternion(q_WB, "q_WB");
  state.q = description.q_nominal;
  take(q, state.q, "q", joints_of(description));
  GeneralizedVector velocity = GeneralizedVector::Zero(6 + n);
  take(u, velocity, "u",
       std::to_string(6 + n) + " numbers, v_WB, w_WB_B and a rate for each joint");
  state.v_WB = velocity.head<3>();
  state.w_WB_B = velocity.segment<3>(3);
  state.qd = velocity.tail(n);
  state.size_legs(description.num_legs());
  Vec3 normal;
  assign(normal, terrain_normal, "terrain_normal", true);
  if (normal.norm() < 1e-9)
    throw Error("terrain_normal is zero; a vector out of the ground is valid");
  NamedDynamics made = at(robot, state, normal.normalized());
  made.world = world;
  return made;
}

/// `Frame` in Python.
struct Frame {
  Point point;
  Rotation rotation;
};

Frame frame(const NamedDynamics& self, const std::string& name, const std::string& relative_to) {
  if (relative_to != "world" && relative_to != "base")
    throw UnknownNameError("relative_to is \"" + relative_to + "\"; valid are: world, base");
  const model::Frames& frames = self.robot->frames();
  const model::FrameKinematics in_W =
      model::frame_kinematics(frames[frames.number(name)], self.values);
  if (relative_to == "world") return {{in_W.point, self.world}, {in_W.rotation, self.world}};
  const model::FrameKinematics in_B = model::relative_to_base(in_W, self.values);
  return {{in_B.point, ""}, {in_B.rotation, ""}};
}

/// h at rest, with payload and leg lengths as they are believed: m g of the centre of mass.
std::vector<double> gravity(const NamedDynamics& self) {
  const model::Dynamics& now = self.values;
  const GeneralizedVector h = now.mass * kGravity * now.com.J.row(2).transpose();
  return {h.begin(), h.end()};
}

nb::typed<nb::dict, std::string, Point> points(
    const NamedDynamics& self, PerLeg<model::PointKinematics> model::Dynamics::* member) {
  nb::typed<nb::dict, std::string, Point> legs;
  const PerLeg<model::PointKinematics>& values = self.values.*member;
  for (const Leg leg : values.legs())
    legs[nb::cast(leg_name(leg, self.values.num_legs()))] =
        nb::cast(Point{values[index(leg)], self.world});
  return legs;
}

/// A property that looks at a member; surefoot/_worlds.py marks its array with `world`.
template <typename Kinematics, typename Matrix>
void def_view(nb::class_<InWorld<Kinematics>>& type, const char* name, Matrix Kinematics::* member,
              const char* doc) {
  using Self = nb::handle_t<InWorld<Kinematics>>;
  const auto look = [member](Self self) {
    return view(nb::inst_ptr<InWorld<Kinematics>>(self)->values.*member, self);
  };
  type.def_prop_ro(name, look, doc);
}

template <typename Struct>
void def_world(nb::class_<Struct>& type) {
  type.def_prop_ro(
      "world", [](const Struct& self) { return self.world; },
      "of the arrays in it: \"W\", the controller's, \"S\", the simulator's, or \"\", not known or "
      "none, as B");
}

void bind_points(nb::module_& module) {
  nb::class_<Point> point(
      module, "Point",
      "A point of the robot: v = J u, its acceleration is J u̇ + Jdot_u; all in its world, which is "
      "that of the\ndynamics, or in B.");
  def_view(point, "p", &model::PointKinematics::p, "position [m], shape (3,)");
  def_view(point, "v", &model::PointKinematics::v, "velocity [m/s], shape (3,)");
  def_view(point, "J", &model::PointKinematics::J, "Jacobian, shape (3, number of velocities)");
  def_view(point, "Jdot_u", &model::PointKinematics::Jdot_u, "J̇ u [m/s²], shape (3,)");
  def_world(point);
  nb::class_<Rotation> rotation(
      module, "Rotation",
      "A body's orientation: w = J u, its rate is J u̇ + Jdot_u; all in its world, which is that of "
      "the\ndynamics, or in B.");
  def_view(rotation, "R", &model::RotationKinematics::R,
           "takes its coordinates to that world, or to B, shape (3, 3)");
  def_view(rotation, "w", &model::RotationKinematics::w, "angular velocity [rad/s], shape (3,)");
  def_view(rotation, "J", &model::RotationKinematics::J,
           "Jacobian, shape (3, number of velocities)");
  def_view(rotation, "Jdot_u", &model::RotationKinematics::Jdot_u, "J̇ u [rad/s²], shape (3,)");
  def_world(rotation);
  nb::class_<Frame>(module, "Frame", "A frame of the robot.")
      .def_ro("point", &Frame::point, "its origin")
      .def_ro("rotation", &Frame::rotation, "its axes");
}

void bind_dynamics(nb::module_& module) {
  bind_points(module);
  using Self = NamedDynamics;
  const auto look = [](auto model::Dynamics::* member) {
    return [member](nb::handle_t<Self> self) {
      return view(nb::inst_ptr<Self>(self)->values.*member, self);
    };
  };
  const auto point = [](model::PointKinematics model::Dynamics::* member) {
    return [member](const Self& self) { return Point{self.values.*member, self.world}; };
  };
  const auto of_legs = [](PerLeg<model::PointKinematics> model::Dynamics::* member) {
    return [member](const Self& self) { return points(self, member); };
  };
  nb::class_<Self> type(module, "Dynamics",
                        "A robot at one state, with u = (v_WB in W, w_WB_B in B, q̇):\n\n"
                        "    M u̇ + h = Sᵀ τ + Σ J_Cᵀ λ      (Eq. 2)\n\n"
                        "J_C is contacts[leg].J, S takes the joints' part.");
  def_world(type);
  type.def("__repr__",
           [](const Self& self) {
             return "<dynamics of " + self.robot->description().name + ", " +
                    std::to_string(self.values.num_velocities()) + " velocities>";
           })
      .def_prop_ro("M", look(&model::Dynamics::M), "mass matrix, shape (velocities, velocities)")
      .def_prop_ro("h", look(&model::Dynamics::h),
                   "gravity, centrifugal and Coriolis terms [N], [N·m], shape (velocities,)")
      .def_prop_ro(
          "gravity",
          [](const Self& self) {
            return nb::module_::import_("numpy").attr("array")(gravity(self));
          },
          nb::sig("def gravity(self) -> numpy.typing.NDArray[numpy.float64]"),
          "h at rest, shape (velocities,)")
      .def_prop_ro("u", look(&model::Dynamics::u), "shape (velocities,)")
      .def_prop_ro("q", look(&model::Dynamics::q), "joint positions [rad], shape (joints,)")
      .def_prop_ro(
          "mass", [](const Self& self) { return self.values.mass; }, "[kg]")
      .def_prop_ro("base", point(&model::Dynamics::base), "origin of B")
      .def_prop_ro(
          "base_rotation",
          [](const Self& self) { return Rotation{self.values.base_rotation, self.world}; },
          "of B; its w and J are in the world, not in B")
      .def_prop_ro("com", point(&model::Dynamics::com), "centre of mass")
      .def_prop_ro("hips", of_legs(&model::Dynamics::hip), "by leg")
      .def_prop_ro("feet", of_legs(&model::Dynamics::foot), "centres of the foot spheres, by leg")
      .def_prop_ro("contacts", of_legs(&model::Dynamics::contact),
                   "lowest points of the foot spheres along the terrain normal, by leg")
      .def("frame", &frame, nb::arg("name"), nb::arg("relative_to") = "world",
           "A frame by its name, of Robot.frames, at this state. relative_to: \"world\", or "
           "\"base\" for its\nmotion in B, which only the joints cause. Raises Error with near "
           "names.");
}

}  // namespace

void bind_robot(nb::module_& module) {
  bind_dynamics(module);
  using Self = Robot;
  nb::class_<Self> robot(module, "Robot",
                         "A robot: what its URDF and its robot file say, and its dynamics.",
                         nb::type_slots(kNoVectorcall));
  robot
      .def(
          "__init__",
          [](Self* self, const std::filesystem::path& given) { new (self) Self(given.string()); },
          nb::arg("name_or_path"),
          nb::sig("def __init__(self, name_or_path: str | os.PathLike[str]) -> None"),
          "By the name of a robot that ships, or as a path of a robot file (.yaml), a URDF (.urdf) "
          "or an MJCF (.xml).\nOf the latter two, what the doctor guesses stands in for what they "
          "lack: see doctor().")
      .def("__copy__", [](nb::handle_t<Self> self) { return self; })
      .def("__deepcopy__", [](nb::handle_t<Self> self, nb::handle) { return self; })
      .def(
          "__reduce__",
          [](nb::handle_t<Self> self) {
            const std::string& source = nb::inst_ptr<Self>(self)->source();
            if (source.empty())
              throw nb::type_error(
                  "only a Robot(name_or_path) can be pickled; of a scenario, pickle that and take "
                  "its robot_model there; of a diagnosis, write() a robot file first");
            return nb::make_tuple(self.type(), nb::make_tuple(source));
          },
          nb::sig("def __reduce__(self) -> tuple[typing.Any, ...]"))
      .def("__repr__",
           [](const Self& self) {
             const model::RobotDescription& given = self.description();
             return "<robot " + given.name + ", " + std::to_string(given.num_legs()) + " legs, " +
                    std::to_string(given.num_joints()) + " joints>";
           })
      .def_prop_ro(
          "name", [](const Self& self) { return self.description().name; }, "of its robot file")
      .def_prop_ro(
          "frames", [](Self& self) { return self.frames().names(); },
          "names of all frames: links, joints, sites of an MJCF, arms (their tips)")
      .def_prop_ro("file", &Self::file, "its robot file, for `load_scenario(…, robot=…)`")
      .def_prop_ro(
          "urdf", [](const Self& self) { return self.description().urdf_path; },
          "path of its description")
      .def_prop_ro(
          "legs",
          [](const Self& self) {
            std::vector<std::string> names;
            const int count = self.description().num_legs();
            for (const Leg leg : self.description().legs.legs())
              names.emplace_back(leg_name(leg, count));
            return names;
          },
          "names of its legs, in the order of all arrays by leg")
      .def_prop_ro(
          "arms",
          [](const Self& self) {
            std::vector<std::string> names;
            for (const model::ArmDescription& arm : self.description().arms)
              names.push_back(arm.name);
            return names;
          },
          "names of its arms, which are frames: their tips")
      .def_prop_ro(
          "joint_names", [](const Self& self) { return self.description().joint_names(); },
          "in the order of every array of joints: HAA, HFE, KFE of each leg, then further ones, "
          "then arms")
      .def_prop_ro(
          "mass", [](Self& self) { return self.model().mass(); }, "[kg]")
      .def_prop_ro(
          "notes", [](Self& self) { return self.model().notes(); },
          "what is ignored of the URDF, a line each")
      .def(
          "dynamics", &dynamics, nb::arg("q") = nb::none(), nb::arg("u") = nb::none(),
          nb::kw_only(), nb::arg("p_WB") = std::vector<double>{0, 0, 0},
          nb::arg("q_WB") = std::vector<double>{1, 0, 0, 0},
          nb::arg("terrain_normal") = std::vector<double>{0, 0, 1}, nb::arg("world") = "",
          "Its dynamics at joint positions q [rad], by default the nominal stance, and velocities\n"
          "u = (v_WB, w_WB_B, q̇), by default at rest. world: that of these numbers, \"W\" or "
          "\"S\"; "
          "unless you give it, that of\nthe arrays which know theirs, as truth.p_SB does, or none.")
      .def(
          "dynamics",
          [](const std::shared_ptr<Robot>& self, const RobotState& state) {
            return at(self, state, Vec3::UnitZ());
          },
          nb::arg("state"), "The same at a state, as that of a controller, in W.");
  const auto limit = [&robot](const char* name, JointVector model::RobotDescription::* member,
                              const char* doc) {
    robot.def_prop_ro(
        name,
        [member](const Self& self) {
          return std::vector<double>((self.description().*member).begin(),
                                     (self.description().*member).end());
        },
        doc);
  };
  limit("torque_limit", &model::RobotDescription::torque_limit, "|torque| ≤ limit [N·m]");
  limit("velocity_limit", &model::RobotDescription::velocity_limit, "[rad/s]");
  limit("q_min", &model::RobotDescription::q_min, "[rad]");
  limit("q_max", &model::RobotDescription::q_max, "[rad]");
  limit("q_nominal", &model::RobotDescription::q_nominal, "of the nominal stance [rad]");
}

}  // namespace surefoot::python
