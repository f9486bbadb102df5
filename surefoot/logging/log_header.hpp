#pragma once

#include "surefoot/signals/leg.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot {

/// Version of the log's topics and fields: the first number changes when a reader must change.
inline constexpr std::string_view kLogVersion = "2.12";

/// What the report needs to know of the robot and its limits.
struct LogRobot {
  std::string name;
  std::array<std::string, kNumJoints> joint_names;  ///< of the URDF, joint j of leg k at 3 k + j
  JointVector torque_limit = JointVector::Constant(kNaN);  ///< [N·m]
  double mass = kNaN;                                      ///< [kg]
  double foot_radius = kNaN;                               ///< [m]
};

/// Limits of the distance between hip and foot (Eq. 35), as the stack has them; NaN: no such level.
struct LogLimbLimits {
  int level = -1;                 ///< of the hierarchy, counted from 0
  std::string form;               ///< "radial" or "vertical"
  double min = kNaN, max = kNaN;  ///< [m]
};

/// A piece of the simulated ground; the highest of them at a place is what feet meet there.
struct LogTerrain {
  std::string shape;              ///< "plane" (endless), "box", or "heights" on a level grid
  Vec3 position = Vec3::Zero();   ///< of its centre in W [m]
  Quat q_WT = Quat::Identity();   ///< takes its coordinates to W; a plane's z is its normal
  Vec3 size = Vec3::Zero();       ///< full edge lengths; of a grid along x and y [m]
  int columns = 0, rows = 0;      ///< points of the grid along x and y
  std::vector<double> heights{};  ///< above `position`, row by row along y [m]
};

/// A value that the seed chose.
struct LogDraw {
  std::string path;  ///< of the scenario's key
  double value = kNaN;
};

/// A file that the run was made from, kept in the log as an attachment.
struct LogAttachment {
  std::string name, media_type, data;
};

/// Name of an inequality row by its level and its id in that level.
using RowNamer = std::function<std::string(int level, std::int32_t id)>;

/// What a log says of its run before the first tick. Nothing in it may depend on when or where it
/// ran.
struct LogHeader {
  std::string version;                   ///< of the program
  std::string log_version{kLogVersion};  ///< of a log that was read: that log's
  std::string commit;                    ///< that it was built from; empty: not known
  std::string command;                   ///< that makes this run again; empty: not known
  std::string scenario, stack;           ///< names
  std::string description;               ///< what the scenario is about, in a line
  std::string estimation;                ///< e.g. "truth"
  std::string options;                   ///< everything that was set, as JSON; empty: none
  std::uint64_t seed = 0;
  std::vector<LogDraw> drawn;            ///< what the seed chose, besides the sensors' noise
  double control_period = 0.0025;        ///< [s]
  std::vector<std::string> level_names;  ///< of the hierarchy, highest first
  std::vector<std::string> level_units;  ///< of their residuals; empty texts where there is none
  std::vector<std::string> event_names;  ///< of MotionPlan::event, by number
  LogRobot robot;
  LogLimbLimits limb;
  std::vector<LogTerrain> terrain;
  std::vector<std::string> notes;  ///< e.g. what was changed in the robot's model
  /// The physics model as MJCF; scenario, stack and robot as they were read; the stack with
  /// everything worked in, and the robot's URDF.
  std::vector<LogAttachment> attachments;

  /// A log that was read lacks what came into the format since then, or has what this program
  /// passes over.
  [[nodiscard]] bool is_older() const;
  [[nodiscard]] bool is_newer() const;

  /// Of a level by its number; "level 3" where there is none of it.
  [[nodiscard]] std::string level_name(std::ptrdiff_t number) const;
  /// Of its residual; empty where there is none.
  [[nodiscard]] std::string level_unit(std::ptrdiff_t number) const;

  /// The content of an attachment; null where there is none of that name.
  [[nodiscard]] const std::string* attachment(std::string_view name) const;

  /// Called on the recorder's thread. Not part of the file: the rows' names stand in the hierarchy
  /// messages.
  RowNamer row_name;
};

/// Of a level by its number; "level 3" where there is none of it.
[[nodiscard]] std::string level_name(const std::vector<std::string>& names, std::ptrdiff_t number);

/// The header as JSON, without the attachments.
[[nodiscard]] std::string to_json(const LogHeader& header);

}  // namespace surefoot
