#pragma once

#include "surefoot/logging/applied_force.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace surefoot {

/// The simulator's truth at a tick, as far as the report shows it; NaN in a log without it.
struct TruthSample {
  double time = kNaN;
  Vec3 p_WB = Vec3::Constant(kNaN);
  Quat q_WB{kNaN, kNaN, kNaN, kNaN};
  Vec3 v_WB = Vec3::Constant(kNaN);
  Vec3 p_WCom = Vec3::Constant(kNaN);
  PerLeg<Vec3> p_WF{Vec3::Constant(kNaN), Vec3::Constant(kNaN), Vec3::Constant(kNaN),
                    Vec3::Constant(kNaN)};
  PerLeg<double> normal_force{kNaN, kNaN, kNaN, kNaN};
  JointVector torque = JointVector::Constant(kNaN);
};

/// What the report shows of a tick.
struct TickSample {
  double time = 0.0;
  MotionPlan plan;
  Vec3 p_WB = Vec3::Constant(kNaN);   ///< base, as the controller believed [m]
  Quat q_WB{kNaN, kNaN, kNaN, kNaN};  ///< the same
  Vec3 v_WB = Vec3::Constant(kNaN);   ///< the same [m/s]
  ModelRecord model;
  /// Of the plan, in the true W (in the controller's, without a truth) [m].
  Vec2 desired_com = Vec2::Constant(kNaN);
  double desired_height = kNaN;              ///< the same of the torso [m]
  Mat3 R_belief = Mat3::Identity();          ///< turns the controller's W into the true one
  JointVector torque = JointVector::Zero();  ///< commanded [N·m]
  CommandMode mode = CommandMode::optimal;
  std::array<double, kMaxLevels> residuals{};
  std::int32_t num_levels = 0;
  std::vector<ActiveRow> active;  ///< inequality rows at or beyond a bound
  TruthSample truth;
};

/// Time in which an inequality row was active without a break.
struct ActiveTime {
  std::int16_t level = 0;
  std::int32_t id = 0;
  double from = 0.0, to = 0.0;
  bool beyond = false;  ///< its bound was exceeded at some tick of it
};

/// A row of a higher level that held a level back, over a whole run.
struct GaveWay {
  std::int16_t level = 0;     ///< that gave way
  std::int16_t by_level = 0;  ///< of the row
  std::int32_t id = 0;        ///< of the row
  int num_ticks = 0;
  double sum = 0.0;      ///< of its costs, over the ticks, in the unit of the level that gave way
  double largest = 0.0;  ///< of its costs
  double time = 0.0;     ///< of the largest [s]
};

/// A whole log in memory.
struct RunData {
  LogHeader header;
  std::vector<TickSample> ticks;
  std::vector<TickTiming> timings;
  std::vector<ActiveTime> active;
  std::vector<GaveWay> gave_way;  ///< by level, then by row
  int num_explained_ticks = 0;    ///< at which the log knows what held each level back
  std::map<std::pair<std::int16_t, std::int32_t>, std::string> row_names;  ///< by level and id
  std::string summary;  ///< JSON; empty without one
  std::string problem;  ///< why the log could not be read to its end; empty if it is whole
  bool has_truth = false;
  int num_changes = 0;                ///< from outside, while it ran; a pull is one
  std::vector<AppliedForce> applied;  ///< forces from outside, in the order of their begin
};

/// Position of a tick in W: the simulator's truth where the log has it, else what the controller
/// believed.
[[nodiscard]] Vec3 centre_of_mass(const TickSample& tick);
[[nodiscard]] Vec3 base(const TickSample& tick);
[[nodiscard]] Vec3 foot_centre(const TickSample& tick, std::size_t leg);

/// Throws FileError as LogReader does, and if the log holds no tick.
[[nodiscard]] RunData read_run(const std::string& log_path);

}  // namespace surefoot
