#include "surefoot/tasks/catalog.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/tasks/body_height_limits.hpp"
#include "surefoot/tasks/com_xy.hpp"
#include "surefoot/tasks/contact_force_minimisation.hpp"
#include "surefoot/tasks/equations_of_motion.hpp"
#include "surefoot/tasks/frame_orientation.hpp"
#include "surefoot/tasks/frame_position.hpp"
#include "surefoot/tasks/friction_cone.hpp"
#include "surefoot/tasks/joint_position_limits.hpp"
#include "surefoot/tasks/limb_extension_limits.hpp"
#include "surefoot/tasks/manipulability.hpp"
#include "surefoot/tasks/no_contact_motion.hpp"
#include "surefoot/tasks/posture.hpp"
#include "surefoot/tasks/swing_foot.hpp"
#include "surefoot/tasks/torque_limits.hpp"
#include "surefoot/tasks/torque_minimisation.hpp"
#include "surefoot/tasks/torso_height.hpp"
#include "surefoot/tasks/torso_orientation.hpp"
#include "surefoot/tasks/torso_tilt_limits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace surefoot::tasks {
namespace {

using Factory = std::function<std::unique_ptr<Task>(const TaskParameters&)>;

struct Catalog {
  std::vector<TaskInfo> infos;
  std::vector<Factory> factories;
};

constexpr std::string_view kNoUnit = "–";

std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += " " + std::string(name);
  return names.empty() ? " none" : text;
}

template <typename T>
struct NoOptions {};

template <typename T, typename = void>
struct OptionsOf {
  using type = NoOptions<T>;
};
template <typename T>
struct OptionsOf<T, std::void_t<typename T::Options>> {
  using type = typename T::Options;
};

/// One task's entry: binds the names of a stack file to the members of its Options, which alone
/// hold the defaults.
template <typename T>
class Entry {
 public:
  using Options = typename OptionsOf<T>::type;

  Entry(std::string_view name, std::string_view summary, std::string_view equation,
        std::string_view unit)
      : info_{name, summary, equation, unit, {}, {}} {}

  Entry&& number(std::string_view name, double Options::* member, std::string_view unit,
                 std::string_view help, double minimum = 0.0) && {
    return std::move(*this).number_at(
        name, [member](Options& options) -> double& { return options.*member; }, unit, help,
        minimum);
  }

  /// The last number does not go with the robot's size as its unit says.
  Entry&& sized(Sizing sizing) && {
    info_.parameters.back().sizing = sizing;
    return std::move(*this);
  }

  Entry&& number_per_leg(std::string_view first_name, PerLeg<double> Options::* member,
                         const PerLeg<std::string_view>& names, std::string_view unit) && {
    for (std::size_t i = 0; i < names.size(); ++i) {
      (void)std::move(*this).number_at(
          names[i], [member, i](Options& options) -> double& { return (options.*member)[i]; }, unit,
          first_name, 0.0);
    }
    return std::move(*this);
  }

  /// `values` in the order of the enumerators.
  template <typename Enum>
  Entry&& choice(std::string_view name, Enum Options::* member,
                 std::vector<std::string_view> values, std::string_view help) && {
    info_.choices.push_back(
        {name, values, values[static_cast<std::size_t>(defaults_.*member)], help});
    set_choice_.emplace(name, [=, task = info_.name](Options& options, const std::string& word) {
      const auto found = std::ranges::find(values, word);
      if (found == values.end()) {
        throw UnknownNameError(std::string(task) + ": " + std::string(name) + " is \"" + word +
                               "\", but must be one of:" + listed(values));
      }
      options.*member = static_cast<Enum>(found - values.begin());
    });
    return std::move(*this);
  }

  void add_to(Catalog& catalog) && {
    catalog.infos.push_back(std::move(info_));
    catalog.factories.push_back(
        [task = catalog.infos.back().name, set_number = std::move(set_number_),
         set_choice =
             std::move(set_choice_)](const TaskParameters& parameters) -> std::unique_ptr<Task> {
          Options options;
          for (const auto& [name, value] : parameters.numbers) {
            setter(set_number, task, "number", name)(options, value);
          }
          for (const auto& [name, word] : parameters.choices) {
            setter(set_choice, task, "choice", name)(options, word);
          }
          if constexpr (std::is_constructible_v<T, const Options&>) {
            return std::make_unique<T>(options);
          } else {
            return std::make_unique<T>();
          }
        });
  }

 private:
  template <typename Value>
  using Setters =
      std::map<std::string_view, std::function<void(Options&, const Value&)>, std::less<>>;

  template <typename Access>
  Entry&& number_at(std::string_view name, Access access, std::string_view unit,
                    std::string_view help, double minimum) && {
    info_.parameters.push_back({name, access(defaults_), minimum, unit, help});
    set_number_.emplace(name, [=, task = info_.name](Options& options, double value) {
      if (!std::isfinite(value) || value < minimum) {
        std::ostringstream message;
        message << task << ": " << name << " is " << value << ", but must be a number of at least "
                << minimum << (unit == kNoUnit ? "" : " ") << (unit == kNoUnit ? "" : unit);
        throw Error(message.str());
      }
      access(options) = value;
    });
    return std::move(*this);
  }

  template <typename Value>
  static const auto& setter(const Setters<Value>& setters, std::string_view task,
                            std::string_view kind, const std::string& name) {
    const auto found = setters.find(name);
    if (found != setters.end()) return found->second;
    std::vector<std::string_view> names;
    for (const auto& [valid, set] : setters) names.push_back(valid);
    throw UnknownNameError(std::string(task) + ": there is no " + std::string(kind) + " \"" + name +
                           "\"; the task has:" + listed(names));
  }

  TaskInfo info_;
  Options defaults_;
  Setters<double> set_number_;
  Setters<std::string> set_choice_;
};

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

void add_arms(Catalog& catalog) {
  Entry<FramePosition>("frame_position", "tip of an arm follows its reference", "as (19)", "m/s²")
      .number("kp", &FramePosition::Options::kp, "1/s²", "position gain")
      .number("kd", &FramePosition::Options::kd, "1/s", "velocity gain")
      .number("max_error", &FramePosition::Options::max_error, "m", kErrorHelp)
      .add_to(catalog);
  Entry<FrameOrientation>("frame_orientation", "tip of an arm follows its orientation", "as (18)",
                          "rad/s²")
      .number("kp", &FrameOrientation::Options::kp, "1/s²", "orientation gain")
      .number("kd", &FrameOrientation::Options::kd, "1/s", "angular velocity gain")
      .number("max_error", &FrameOrientation::Options::max_error, "rad", kErrorHelp)
      .add_to(catalog);
  Entry<Posture>("posture", "joints go to the nominal posture", kNoUnit, "rad/s²")
      .choice("joints", &Posture::Options::joints,
              {"arms", "legs", "all", "idle_arms", "reaching_arm"},
              "which joints; an arm is idle while it does not reach")
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
    add_arms(all);
    return all;
  }();
  return kCatalog;
}

std::size_t find(std::string_view name) {
  const std::vector<TaskInfo>& infos = catalog().infos;
  const auto found = std::ranges::find(infos, name, &TaskInfo::name);
  if (found == infos.end()) {
    std::string message = "unknown task \"" + std::string(name) + "\"; there are:";
    for (const TaskInfo& info : infos) message += " " + std::string(info.name);
    throw UnknownNameError(message);
  }
  return static_cast<std::size_t>(found - infos.begin());
}

}  // namespace

std::span<const TaskInfo> task_catalog() { return catalog().infos; }

const TaskInfo& task_info(std::string_view name) { return catalog().infos[find(name)]; }

std::unique_ptr<Task> make_task(std::string_view name, const TaskParameters& parameters) {
  return catalog().factories[find(name)](parameters);
}

}  // namespace surefoot::tasks
