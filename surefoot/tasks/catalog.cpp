#include "surefoot/tasks/catalog.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/tasks/body_height_limits.hpp"
#include "surefoot/tasks/com_xy.hpp"
#include "surefoot/tasks/contact_force_minimisation.hpp"
#include "surefoot/tasks/equations_of_motion.hpp"
#include "surefoot/tasks/frame_orientation.hpp"
#include "surefoot/tasks/frame_position.hpp"
#include "surefoot/tasks/friction_cone.hpp"
#include "surefoot/tasks/joint_damping.hpp"
#include "surefoot/tasks/joint_position_limits.hpp"
#include "surefoot/tasks/limb_extension_limits.hpp"
#include "surefoot/tasks/manipulability.hpp"
#include "surefoot/tasks/no_contact_motion.hpp"
#include "surefoot/tasks/posture.hpp"
#include "surefoot/tasks/swing_foot.hpp"
#include "surefoot/tasks/task_entry.hpp"
#include "surefoot/tasks/torque_limits.hpp"
#include "surefoot/tasks/torque_minimisation.hpp"
#include "surefoot/tasks/torso_height.hpp"
#include "surefoot/tasks/torso_orientation.hpp"
#include "surefoot/tasks/torso_tilt_limits.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <utility>

namespace surefoot::tasks {
namespace {

template <typename T>
using Entry = TaskEntry<T>;

/// The library's.
struct Catalog {
  void add(TaskDefinition task) {
    infos.push_back(std::move(task.info));
    factories.push_back(std::move(task.make));
  }

  std::vector<TaskInfo> infos;
  std::vector<TaskFactory> factories;
};

constexpr std::string_view kNoUnit = "–";

constexpr std::string_view kErrorHelp = "larger tracking errors are shortened to this";

/// The parameters of every bound by Eq. 27.
template <typename T>
void add_bound(Entry<T>&& entry, Catalog& catalog) {
  using Options = typename T::Options;
  std::move(entry)
      .number("dt", &Options::dt, "s", "time δt in which a bound is reached: longer is softer",
              1e-4)
      .choice("response", &Options::response, {"paper", "no_overshoot"},
              "how a coordinate stops at its bound")
      .add_to(catalog);
}

void add_dynamics(Catalog& catalog) {
  Entry<EquationsOfMotion>("equations_of_motion",
                           "accelerations and torques obey the robot's dynamics", "(15)",
                           "N and N·m")
      .add_to(catalog);
  Entry<NoContactMotion>("no_contact_motion", "supporting feet stay where they are", "(16)", "m/s²")
      .number("kd", &NoContactMotion::Options::kd, "1/s", "damping of the contact point's velocity")
      .add_to(catalog);
}

void add_limits(Catalog& catalog) {
  Entry<TorqueLimits>("torque_limits", "torques stay within what the actuators give", "(28)", "N·m")
      .number("fraction", &TorqueLimits::Options::fraction, kNoUnit,
              "of the torque limit, at most 1")
      .choice("speed_line", &TorqueLimits::Options::speed_line, {"none", "linear"},
              "whether the limit falls with the joint's speed")
      .number("corner_speed", &TorqueLimits::Options::corner_speed, kNoUnit,
              "where the line begins, as a fraction of the velocity limit")
      .add_to(catalog);
  Entry<FrictionCone>("friction_cone",
                      "contact forces stay in the friction pyramid and the plan's "
                      "normal-force limits",
                      "(29)–(31)", "N")
      .choice("pyramid", &FrictionCone::Options::pyramid, {"inner", "outer"},
              "inside the friction cone (μ/√2) or around it (μ)")
      .choice("axes", &FrictionCone::Options::axes, {"control", "gravity"},
              "about the normal of the control frame or about the vertical")
      .number("sole", &FrictionCone::Options::sole, kNoUnit,
              "share of a flat foot that the centre of pressure may use")
      .add_to(catalog);
}

void add_tracking(Catalog& catalog) {
  Entry<ComXy>("com_xy", "centre of mass follows its horizontal reference", "(17)", "m/s²")
      .number("kp", &ComXy::Options::kp, "1/s²", "position gain")
      .number("kd", &ComXy::Options::kd, "1/s", "velocity gain")
      .number("max_error", &ComXy::Options::max_error, "m", kErrorHelp)
      .add_to(catalog);
  Entry<SwingFoot>("swing_foot", "feet in the air follow their swing curves", "(19)", "m/s²")
      .number("kp", &SwingFoot::Options::kp, "1/s²", "position gain")
      .number("kd", &SwingFoot::Options::kd, "1/s", "velocity gain")
      .number("max_error", &SwingFoot::Options::max_error, "m", kErrorHelp)
      .add_to(catalog);
}

void add_torso(Catalog& catalog) {
  Entry<TorsoYaw>("torso_yaw", "torso follows its desired heading", "(18), row z", "rad/s²")
      .number("kp", &TorsoOrientationOptions::kp, "1/s²", "orientation gain")
      .number("kd", &TorsoOrientationOptions::kd, "1/s", "angular velocity gain")
      .number("max_error", &TorsoOrientationOptions::max_error, "rad", kErrorHelp)
      .add_to(catalog);
  Entry<TorsoHeight>("torso_height", "base follows its desired height", "(24), tracking", "m/s²")
      .number("kp", &TorsoHeight::Options::kp, "1/s²", "height gain")
      .number("kd", &TorsoHeight::Options::kd, "1/s", "velocity gain")
      .number("max_error", &TorsoHeight::Options::max_error, "m", kErrorHelp)
      .add_to(catalog);
  Entry<TorsoRollPitch>("torso_roll_pitch", "torso follows its desired roll and pitch",
                        "(18), rows x and y", "rad/s²")
      .number("kp", &TorsoOrientationOptions::kp, "1/s²", "orientation gain")
      .number("kd", &TorsoOrientationOptions::kd, "1/s", "angular velocity gain")
      .number("max_error", &TorsoOrientationOptions::max_error, "rad", kErrorHelp)
      .add_to(catalog);
  Entry<Manipulability>("manipulability", "base moves to the height where the legs can move best",
                        "(22)–(24)", "m/s²")
      .choice("form", &Manipulability::Options::form, {"chained", "paper"},
              "gradient taken through the kinematics, or as printed")
      .number("k0", &Manipulability::Options::k0, "1/(m s²)", "gain of the gradient")
      .number("kd", &Manipulability::Options::kd, "1/s", "damping of the height")
      .number("max_acceleration", &Manipulability::Options::max_acceleration, "m/s²",
              "bound on the gradient's part")
      .number_per_leg(
          "weight of the leg", &Manipulability::Options::weights,
          {"weight_LF", "weight_RF", "weight_LM", "weight_RM", "weight_LH", "weight_RH"}, kNoUnit)
      .add_to(catalog);
}

void add_motion_bounds(Catalog& catalog) {
  add_bound(
      Entry<LimbExtensionLimits>("limb_extension_limits",
                                 "distance from hip to foot stays in bounds", "(35)", "m/s²")
          .choice("form", &LimbExtensionLimits::Options::form, {"paper", "relative", "radial"},
                  "vertical with a still foot, vertical, or along the leg")
          .number("min", &LimbExtensionLimits::Options::min, "m", "shortest distance")
          .number("max", &LimbExtensionLimits::Options::max, "m", "longest distance"),
      catalog);
  add_bound(Entry<BodyHeightLimits>("body_height_limits",
                                    "height of the base above its feet stays in bounds",
                                    "(32)–(34)", "m/s²")
                .number("min", &BodyHeightLimits::Options::min, "m", "lowest height")
                .sized(Sizing::base_height)
                .number("max", &BodyHeightLimits::Options::max, "m", "greatest height")
                .sized(Sizing::base_height),
            catalog);
  add_bound(Entry<JointPositionLimits>("joint_position_limits", "joints stay in their ranges",
                                       "by (27)", "rad/s²")
                .text("joints", &JointPositionLimits::Options::joints,
                      {ChosenJoints::kWords.begin(), ChosenJoints::kWords.end()}, "JOINT …",
                      ChosenJoints::kHelp)
                .number("margin", &JointPositionLimits::Options::margin, "rad",
                        "distance kept from the ends of the range"),
            catalog);
  add_bound(
      Entry<TorsoTiltLimits>("torso_tilt_limits", "roll and pitch of the torso stay in bounds",
                             "by (27)", "rad/s²")
          .number("max_roll", &TorsoTiltLimits::Options::max_roll, "rad", "below π/2")
          .number("max_pitch", &TorsoTiltLimits::Options::max_pitch, "rad", "below π/2"),
      catalog);
}

void add_efforts(Catalog& catalog) {
  Entry<ContactForceMinimisation>("contact_force_minimisation", "contact forces are small", "(21)",
                                  "N")
      .number("weight_tangential", &ContactForceMinimisation::Options::weight_tangential, kNoUnit,
              "of forces along the ground")
      .number("weight_normal", &ContactForceMinimisation::Options::weight_normal, kNoUnit,
              "of forces along the terrain normal")
      .add_to(catalog);
  Entry<TorqueMinimisation>("torque_minimisation", "joint torques are small", "(20)", "N·m")
      .number("weight_HAA", &TorqueMinimisation::Options::weight_HAA, kNoUnit, "of hip abduction")
      .number("weight_HFE", &TorqueMinimisation::Options::weight_HFE, kNoUnit, "of hip flexion")
      .number("weight_KFE", &TorqueMinimisation::Options::weight_KFE, kNoUnit, "of knees")
      .number("weight_arm", &TorqueMinimisation::Options::weight_arm, kNoUnit, "of joints of arms")
      .add_to(catalog);
}

constexpr std::string_view kFrameHelp =
    "a link, joint, site or arm of the robot; without it, the tip of the arm that reaches";
constexpr std::string_view kHeldHelp = "where it is held, until a command or a planner moves it";

void add_frames(Catalog& catalog) {
  Entry<FramePosition>("frame_position", "a frame, or the tip of an arm, follows its reference",
                       "as (19)", "m/s²")
      .text("frame", &FramePosition::Options::frame, {}, "FRAME", kFrameHelp)
      .choice("held_in", &FramePosition::Options::held_in, {"base", "world"}, kHeldHelp)
      .number("kp", &FramePosition::Options::kp, "1/s²", "position gain")
      .number("kd", &FramePosition::Options::kd, "1/s", "velocity gain")
      .number("max_error", &FramePosition::Options::max_error, "m", kErrorHelp)
      .add_to(catalog);
  Entry<FrameOrientation>("frame_orientation",
                          "a frame, or the tip of an arm, follows its orientation", "as (18)",
                          "rad/s²")
      .text("frame", &FrameOrientation::Options::frame, {}, "FRAME", kFrameHelp)
      .choice("held_in", &FrameOrientation::Options::held_in, {"base", "world"}, kHeldHelp)
      .number("kp", &FrameOrientation::Options::kp, "1/s²", "orientation gain")
      .number("kd", &FrameOrientation::Options::kd, "1/s", "angular velocity gain")
      .number("max_error", &FrameOrientation::Options::max_error, "rad", kErrorHelp)
      .add_to(catalog);
  Entry<JointDamping>("joint_damping", "joints are slow where the rest of their level lets them",
                      kNoUnit, "rad/s²")
      .text("joints", &JointDamping::Options::joints,
            {ChosenJoints::kWords.begin(), ChosenJoints::kWords.end()}, "JOINT …",
            ChosenJoints::kHelp)
      .number("kd", &JointDamping::Options::kd, "1/s", "velocity gain")
      .add_to(catalog);
  Entry<Posture>("posture", "joints go to a posture and stay there", kNoUnit, "rad/s²")
      .text("joints", &Posture::Options::joints,
            {ChosenJoints::kWords.begin(), ChosenJoints::kWords.end()}, "JOINT …",
            ChosenJoints::kHelp)
      .choice("target", &Posture::Options::target, {"nominal", "plan"},
              "the robot's posture, or the plan's: where they were at first, unless a planner says")
      .number("kp", &Posture::Options::kp, "1/s²", "position gain")
      .number("kd", &Posture::Options::kd, "1/s", "velocity gain")
      .number("max_error", &Posture::Options::max_error, "rad", kErrorHelp)
      .add_to(catalog);
}

const Catalog& catalog() {
  static const Catalog kCatalog = [] {
    Catalog all;
    add_dynamics(all);
    add_limits(all);
    add_tracking(all);
    add_torso(all);
    add_motion_bounds(all);
    add_efforts(all);
    add_frames(all);
    return all;
  }();
  return kCatalog;
}

/// Index among the library's tasks.
std::optional<std::size_t> find(std::string_view name) {
  const std::vector<TaskInfo>& infos = catalog().infos;
  const auto found = std::ranges::find(infos, name, &TaskInfo::name);
  if (found == infos.end()) return std::nullopt;
  return static_cast<std::size_t>(found - infos.begin());
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += " " + name;
  return names.empty() ? " none" : text;
}

/// The parameter or choice of this name.
template <typename Parameter>
const Parameter& of_name(const std::vector<Parameter>& all, const std::string& task,
                         const char* kind, const std::string& name) {
  const auto found = std::ranges::find(all, name, &Parameter::name);
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const Parameter& one : all) names.push_back(one.name);
  std::ranges::sort(names);
  throw UnknownNameError(task + ": there is no " + kind + " \"" + name +
                         "\"; the task has:" + listed(names));
}

void check_number(const TaskInfo& task, const std::string& name, double value) {
  const TaskParameter& parameter = of_name(task.parameters, task.name, "number", name);
  if (std::isfinite(value) && value >= parameter.minimum) return;
  std::ostringstream message;
  message << task.name << ": " << name << " is " << value << ", but must be a number of at least "
          << parameter.minimum;
  if (parameter.unit != kNoUnit) message << " " << parameter.unit;
  throw Error(message.str());
}

void check_choice(const TaskInfo& task, const std::string& name, const std::string& word) {
  const TaskChoice& choice = of_name(task.choices, task.name, "choice", name);
  if (!choice.others.empty()) return;
  if (std::ranges::find(choice.values, word) != choice.values.end()) return;
  throw UnknownNameError(task.name + ": " + name + " is \"" + word +
                         "\", but must be one of:" + listed(choice.values));
}

}  // namespace

std::span<const TaskInfo> task_catalog() { return catalog().infos; }

std::vector<TaskInfo> task_infos(const OwnTasks& own) {
  std::vector<TaskInfo> infos = catalog().infos;
  for (const TaskDefinition& task : own.all()) infos.push_back(task.info);
  return infos;
}

std::vector<std::string> task_names(const OwnTasks& own) {
  std::vector<std::string> names;
  for (const TaskInfo& info : task_infos(own)) names.push_back(info.name);
  return names;
}

const TaskInfo& task_info(std::string_view name) { return task_info(name, {}); }

const TaskInfo& task_info(std::string_view name, const OwnTasks& own) {
  if (const auto index = find(name)) return catalog().infos[*index];
  if (const TaskDefinition* task = own.find(name)) return task->info;
  throw UnknownNameError("unknown task \"" + std::string(name) +
                         "\"; there are:" + listed(task_names(own)));
}

std::unique_ptr<Task> make_task(std::string_view name, const TaskParameters& parameters,
                                const OwnTasks& own) {
  const TaskInfo& info = task_info(name, own);
  for (const auto& [number, value] : parameters.numbers) check_number(info, number, value);
  for (const auto& [choice, word] : parameters.choices) check_choice(info, choice, word);
  const auto index = find(name);
  std::unique_ptr<Task> task =
      index ? catalog().factories[*index](parameters) : own.find(name)->make(parameters);
  if (task != nullptr) return task;
  throw Error("task \"" + info.name + "\": its factory gave no task");
}

std::vector<std::string> words_of(const TaskChoice& choice) {
  std::vector<std::string> words = choice.values;
  if (!choice.others.empty()) words.push_back(choice.others);
  return words;
}

void OwnTasks::add(TaskDefinition task) {
  const std::string& name = task.info.name;
  if (name.empty()) throw Error("a task of your own needs a name, by which stacks call it");
  if (task.make == nullptr) throw Error("task \"" + name + "\" needs a factory that makes it");
  if (tasks::find(name) || find(name) != nullptr) {
    throw Error("there is a task \"" + name + "\" already; give yours another name");
  }
  all_.push_back(std::move(task));
}

const TaskDefinition* OwnTasks::find(std::string_view name) const {
  const auto found =
      std::ranges::find(all_, name, [](const TaskDefinition& task) { return task.info.name; });
  return found == all_.end() ? nullptr : &*found;
}

}  // namespace surefoot::tasks
