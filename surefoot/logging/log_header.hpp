#pragma once

#include "surefoot/signals/joint_name.hpp"
#include "surefoot/signals/leg.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::logging {

/// Version of the log's topics and fields: the major number changes if readers must change.
inline constexpr std::string_view kLogVersion = "3.3";

/// Robot data for the report.
struct LogRobot {
  std::string name;
  int num_legs = kNumLegs;
  /// Of the URDF, in the order of a JointVector.
  std::vector<std::string> joint_names = std::vector<std::string>(kNumLegJoints);
  JointVector torque_limit = JointVector::Constant(kNumLegJoints, kNaN);  ///< [N·m]
  double mass = kNaN;                                                     ///< [kg]
  double foot_radius = kNaN;                                              ///< [m]
  /// Of `model::Frames`, by number; empty: not known.
  std::vector<std::string> frame_names;

  /// Names of the joints as in messages.
  [[nodiscard]] std::vector<std::string> joints() const {
    return told_joints(joint_names, num_legs);
  }

  /// Of a frame by its number; "frame 57" without a name.
  [[nodiscard]] std::string frame_name(int number) const;

  /// ANYmal B's where the log has none [kg].
  [[nodiscard]] double assumed_mass() const { return mass > 0.0 ? mass : 30.475; }
  /// Normal force from which a foot counts as loaded: 1/300 of the weight [N].
  [[nodiscard]] double least_load() const;
};

/// Limits of the distance between hip and foot (Eq. 35), from the stack; NaN: no such level.
struct LogLimbLimits {
  int level = -1;                 ///< of the hierarchy, from 0
  std::string form;               ///< "radial" or "vertical"
  double min = kNaN, max = kNaN;  ///< [m]
};

/// A piece of the simulated ground; feet touch the highest at each place.
struct LogTerrain {
  std::string shape;              ///< "plane" (infinite), "box", or "heights" on a grid
  Vec3 position = Vec3::Zero();   ///< of its centre in S [m]
  Quat q_SG = Quat::Identity();   ///< takes its coordinates G to S; a plane's normal is z
  Vec3 size = Vec3::Zero();       ///< full edge lengths; of a grid along x and y [m]
  int columns = 0, rows = 0;      ///< points of the grid along x and y
  std::vector<double> heights{};  ///< above `position`, row by row along y [m]
};

/// A value drawn from the seed.
struct LogDraw {
  std::string path;  ///< of the scenario's key
  double value = kNaN;
};

/// An input file of the run, stored in the log as an attachment.
struct LogAttachment {
  std::string name, media_type, data;
};

/// Name of an inequality row by its level and its id in that level.
using RowNamer = std::function<std::string(int level, std::int32_t id)>;

/// Description of the run at the log's start. Must not depend on when or where it ran.
struct LogHeader {
  std::string version;                   ///< of the program
  std::string log_version{kLogVersion};  ///< for a log that was read: its version
  std::string commit;                    ///< of the build; empty: not known
  std::string command;                   ///< to repeat the run; empty: not known
  std::string scenario, stack;           ///< names
  std::string description;               ///< of the scenario, one line
  std::string estimation;                ///< e.g. "truth"
  std::string options;                   ///< all settings, as JSON; empty: none
  std::uint64_t seed = 0;
  std::vector<LogDraw> drawn;            ///< values from the seed, besides sensor noise
  double control_period = 0.0025;        ///< [s]
  std::vector<std::string> level_names;  ///< of the hierarchy, highest first
  std::vector<std::string> level_units;  ///< of their residuals; empty texts: none
  std::vector<double> level_visible;     ///< see `visible_residual`; empty: of ANYmal B
  std::vector<std::string> event_names;  ///< of MotionPlan::event, by number
  std::vector<std::string> own_parts;    ///< as Controller::own_parts() has them
  LogRobot robot;
  LogLimbLimits limb;
  std::vector<LogTerrain> terrain;
  std::vector<std::string> notes;  ///< e.g. changes to the robot's model
  /// The physics model as MJCF; scenario, stack and robot as read; the complete stack, and the
  /// robot's URDF.
  std::vector<LogAttachment> attachments;

  /// Older: the log lacks newer parts of the format. Newer: it has parts that are ignored.
  [[nodiscard]] bool is_older() const;
  [[nodiscard]] bool is_newer() const;

  /// Of a level by its number; "level 3" without a name.
  [[nodiscard]] std::string level_name(std::ptrdiff_t number) const;
  /// Of its residual; empty if unknown.
  [[nodiscard]] std::string level_unit(std::ptrdiff_t number) const;
  /// From this residual on the level counts as given way; see `visible_residual`.
  [[nodiscard]] double visible(std::ptrdiff_t number) const;

  /// The content of an attachment; null if there is none.
  [[nodiscard]] const std::string* attachment(std::string_view name) const;

  /// Called on the recorder's thread. Not part of the file: hierarchy messages contain the rows'
  /// names.
  RowNamer row_name;
};

/// Of a level by its number; "level 3" without a name.
[[nodiscard]] std::string level_name(const std::vector<std::string>& names, std::ptrdiff_t number);

/// The header as JSON, without the attachments.
[[nodiscard]] std::string to_json(const LogHeader& header);

}  // namespace surefoot::logging
