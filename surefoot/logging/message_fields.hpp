#pragma once

#include "surefoot/logging/level_status.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Contents of the log's messages. Describes each signal once, field by field with unit and frame;
/// encoder, schema and decoder (message_codec.hpp) all follow these functions.
namespace surefoot::logged {

/// A level of the hierarchy, with its name.
struct Level {
  std::string name;
  logging::LevelStatus status = logging::LevelStatus::not_solved;
  LevelReport report;
};

/// Time of solving a level, with its name.
struct LevelTime {
  std::string name;
  double solve = kNaN;  ///< [µs]
};

/// TickTiming, with names of levels.
struct Timing {
  TickTiming stages;
  std::vector<LevelTime> levels;
};

/// An inequality row at or beyond a bound, with names.
struct Row {
  std::string level, row;
  std::int32_t id = 0;
  std::int32_t state = 0;
  double by = kNaN;  ///< missing in logs before 2.9
};

/// MissedEquality, with names.
struct MissedRow {
  std::string level, row;
  std::int32_t id = 0;
  double by = 0.0;
};

/// A row that keeps a lower level from a smaller residual, with names.
struct BlockingRow {
  std::string level, by, row;
  surefoot::BlockingRow report;
};

/// A switch of levels requested between two ticks, with names.
struct LevelSwitch {
  std::vector<std::string> add, remove;
  double duration = 0.0;
};

/// An external change between two ticks; members that its kind lacks are empty or NaN.
struct Change {
  double time = 0.0;
  std::string kind, text;
  std::string stack;
  double duration = kNaN;
  double friction = kNaN;
  std::string body;
  Vec3 force = Vec3::Constant(kNaN);
};

/// HierarchyReport, with names.
struct Hierarchy {
  std::int32_t status = 0, failed_level = -1;
  bool borderline = false;
  std::vector<Level> levels;
  std::vector<Row> active;
  std::vector<MissedRow> missed;
  bool blocking_is_known = false;
  std::vector<BlockingRow> blocked_by;
  double transition_share = 1.0;
  std::vector<LevelSwitch> level_switches;
};

inline constexpr std::array<std::string_view, 4> kPhaseNames{"stance", "unloading", "swing",
                                                             "search"};
inline constexpr std::array<std::string_view, 7> kModeNames{"optimal", "degraded", "hold", "sit",
                                                            "damping", "lifted",   "rise"};
inline constexpr std::array<std::string_view, 9> kCauseNames{
    "none", "tilt",         "failures", "encoders", "joint_torques",
    "imu",  "cannot_stand", "fallen",   "own_part"};
inline constexpr std::array<std::string_view, 4> kCalibrationNames{"none", "settling", "turning",
                                                                   "weighing"};
inline constexpr std::array<std::string_view, 8> kFaultNames{
    "none", "silent", "late", "not_a_number", "out_of_range", "jump", "repeats", "contradicts"};

/// `T` or `const T`: the encoder reads what the decoder writes.
template <typename T, typename Described>
concept Is = std::same_as<std::remove_const_t<T>, Described>;

template <typename Archive, Is<SensorReading> T>
void fields(Archive& field, T& reading) {
  field("time", reading.time, "since the start of the run [s]");
  field("q", reading.q, "joint positions, encoders [rad]");
  field("torque", reading.torque, "measured joint torques [N·m]");
  field("gyro", reading.gyro, "angular velocity of the base, in B [rad/s]");
  field("accelerometer", reading.accelerometer, "specific force of the base, in B [m/s²]");
  field("foot_force", reading.foot_force, "normal force of a foot sensor [N]; null without one");
  field("encoder_time", reading.encoder_time, "when q was sampled [s]");
  field("torque_time", reading.torque_time, "when torque was sampled [s]");
  field("imu_time", reading.imu_time, "when gyro and accelerometer were sampled [s]");
}

template <typename Archive, Is<GroupHealth> T>
void fields(Archive& field, T& group) {
  field("fault", group.fault, "what is wrong with this tick's sample");
  field("age", group.age,
        "since the last good sample, or for how long it has been late, frozen or in contradiction "
        "[s]; "
        "null before the first");
  field("joint", group.joint, "the only one at fault, of all joints from 0; -1: none, or several");
}

template <typename Archive, Is<SensorHealth> T>
void fields(Archive& field, T& health) {
  field("encoders", health.encoders, "of the joint angles");
  field("joint_torques", health.joint_torques, "of the torque sensors");
  field("imu", health.imu, "of gyroscope and accelerometer");
}

template <typename Archive, Is<UserCommand> T>
void fields(Archive& field, T& user) {
  field("walk", user.walk, "false: stand on all feet");
  field("velocity", user.velocity, "forward and lateral, in C [m/s]");
  field("yaw_rate", user.yaw_rate, "about the z axis of C, to the left [rad/s]");
  field("height", user.height, "offset to the nominal torso height [m]");
  field("calibrate", user.calibrate, "begin the estimate anew, once all feet stand");
  field("reach", user.reach, "of an arm; since 2.13");
  field(
      "shift", user.shift,
      "of the centre of mass of flat feet, from their middle, forward and lateral; since 3.1 [m]");
  field("gait", user.gait,
        "its place in the scenario's `gaits`; -1: the scenario's own, -2: by the speed, -3: the "
        "present one, as the command has NaN; since 3.1");
}

template <typename Archive, Is<ReachCommand> T>
void fields(Archive& field, T& reach) {
  field("arm", reach.arm, "whose tip is to be there, counted from 0; -1: none");
  field("in_world", reach.in_world, "position and orientation are in W; else in B");
  field("position", reach.position, "place of the tip [m]");
  field("orientation", reach.orientation,
        "roll, pitch and yaw of the tip; null: as it was at first [rad]");
  field("frame", reach.frame,
        "that is to be there instead of a tip, its place in the robot's frames; -1: none; since "
        "3.2");
}

template <typename Archive, Is<RobotState> T>
void fields(Archive& field, T& state) {
  field("time", state.time, "that the state is of [s]");
  field("p_WB", state.p_WB, "base position in W [m]");
  field("q_WB", state.q_WB, "base orientation as quaternion w, x, y, z; takes B coordinates to W");
  field("v_WB", state.v_WB, "base velocity in W [m/s]");
  field("w_WB_B", state.w_WB_B, "base angular velocity in B [rad/s]");
  field("velocity_covariance", state.velocity_covariance,
        "believed, of the velocity's error in B, row by row; since 3.2 [m²/s²]");
  field("orientation_covariance", state.orientation_covariance,
        "believed, of the orientation's error as a rotation vector in W, row by row; since 3.2 "
        "[rad²]");
  field("q", state.q, "joint positions [rad]");
  field("qd", state.qd, "joint velocities [rad/s]");
  field("torque", state.torque, "measured joint torques [N·m]");
  field("foot_force", state.foot_force, "estimated ground force on each foot, in W [N]");
  field(
      "slip_velocity", state.slip_velocity,
      "of each foot's contact point along the ground, against the other standing feet, in W [m/s]");
  field("slips", state.slips, "the foot is believed to slide");
  field("external_force", state.external_force,
        "estimated, of whatever isn't the ground or what the base carries as weighed, at the "
        "centre of mass, in W [N]");
  field("external_moment", state.external_moment, "that goes with it, in W [N·m]");
}

template <typename Archive, Is<FootPlan> T>
void fields(Archive& field, T& foot) {
  field("phase", foot.phase, "what the leg is doing; stance and unloading carry force");
  field("p_WF", foot.p_WF,
        "reference of the foot sphere's centre in W; of a stance foot its foothold [m]");
  field("v_WF", foot.v_WF, "reference of its velocity, in W [m/s]");
  field("a_WF", foot.a_WF, "reference of its acceleration, in W [m/s²]");
  field("force_min", foot.force_min, "lower limit of the normal force, Eq. (30) [N]");
  field("force_max", foot.force_max, "upper limit of the normal force, Eq. (30) [N]");
  field("friction", foot.friction, "coefficient that the contact force may use");
}

template <typename Archive, Is<TorsoPlan> T>
void fields(Archive& field, T& torso) {
  field("q_WB", torso.q_WB, "desired orientation as quaternion w, x, y, z");
  field("w_WB", torso.w_WB, "desired angular velocity, in W [rad/s]");
  field("wdot_WB", torso.wdot_WB, "desired angular acceleration, in W [rad/s²]");
  field("height", torso.height, "desired z of the base in W [m]");
  field("height_rate", torso.height_rate, "how fast the desired height changes [m/s]");
  field("height_acceleration", torso.height_acceleration, "and how fast that does [m/s²]");
}

template <typename Archive, Is<ComPlan> T>
void fields(Archive& field, T& com) {
  field("p", com.p, "desired x and y of the centre of mass in W [m]");
  field("v", com.v, "desired velocity of the centre of mass, in W [m/s]");
  field("a", com.a, "desired acceleration of the centre of mass, in W [m/s²]");
  field("zmp", com.zmp, "zero-moment point that goes with it, in W [m]");
}

template <typename Archive, Is<GaitEvent> T>
void fields(Archive& field, T& event) {
  field("event", event.kind, "what happened");
  field("leg", event.leg, "that it happened to; null: to none, or not to one");
  field("place", event.place, "of its foot's centre, in W [m]");
  field("force", event.force,
        "of the ground on the foot along the terrain's normal, as estimated; of a push the outside "
        "force along the ground [N]");
}

template <typename Archive, Is<ArmPlan> T>
void fields(Archive& field, T& plan) {
  field("arm", plan.arm, "whose tip follows, counted from 0; -1: none");
  field("p_WT", plan.p_WT, "place of the tip in W [m]");
  field("v_WT", plan.v_WT, "velocity of the tip in W [m/s]");
  field("a_WT", plan.a_WT, "acceleration of the tip in W [m/s²]");
  field("q_WT", plan.q_WT, "orientation of the tip, w, x, y, z");
  field("w_WT", plan.w_WT, "angular velocity of the tip in W [rad/s]");
}

template <typename Archive, Is<FramePlan> T>
void fields(Archive& field, T& plan) {
  field("frame", plan.frame, "F, its place in the robot's frames");
  field("in_world", plan.in_world, "the rest is in W, else in B");
  field("p_XF", plan.p_XF, "place [m]");
  field("v_XF", plan.v_XF, "velocity [m/s]");
  field("a_XF", plan.a_XF, "acceleration [m/s²]");
  field("q_XF", plan.q_XF, "orientation, w, x, y, z");
  field("w_XF", plan.w_XF, "angular velocity [rad/s]");
}

template <typename Archive, Is<MotionPlan> T>
void fields(Archive& field, T& plan) {
  field("time", plan.time, "that the plan is for [s]");
  field("feet", plan.feet, "reference of each foot");
  field("torso", plan.torso, "reference of the torso");
  field("com", plan.com, "reference of the centre of mass");
  field("arm", plan.arm, "reference of an arm's tip; since 2.13");
  field("frames", plan.frames, "references of frames that tasks follow; since 3.2");
  field("joints", plan.joints, "reference of the joints, if a task follows it; since 3.2 [rad]");
  field("R_WC", plan.R_WC,
        "control frame C in W, row by row: z along the terrain normal, x the heading");
  field("terrain_point", plan.terrain_point,
        "a point of the terrain plane, at sphere-centre height, in W [m]");
  field("com_zmp_slack", plan.com_zmp_slack, "how far the plan's ZMP had to leave the polygon [m]");
  field("calibration", plan.calibration,
        "what the robot does about itself: it turns on the spot, then weighs what it carries and "
        "where its COM is");
  field("gait", plan.gait, "its place in the scenario's `gaits`; -1: the only one; since 3.1");
  field("events", plan.events, "what happened at this tick, in order; since 2.12");
}

template <typename Archive, Is<ModelRecord> T>
void fields(Archive& field, T& model) {
  field("p_WCom", model.p_WCom,
        "centre of mass in W, of the believed state; null where nothing was solved [m]");
  field("v_WCom", model.v_WCom, "velocity of the centre of mass, in W [m/s]");
  field("p_WF", model.p_WF, "centres of the foot spheres in W [m]");
  field("p_WH", model.p_WH, "hips in W [m]");
  field("force", model.force, "contact forces of the solution, on each foot in W [N]");
  field("load_mass", model.load.mass,
        "by how much the base is believed to be heavier than described, payload and wrong masses "
        "together, as it was weighed; 0 where no height was found; null where nothing was solved "
        "[kg]");
  field("load_first_moment", model.load.first_moment,
        "that goes with it, about the origin of B in B: of a payload its mass times its place, and "
        "of a centre of mass that lies elsewhere the whole mass times how far; moves as links are "
        "weighed in the air [kg·m]");
}

template <typename Archive, Is<Level> T>
void fields(Archive& field, T& level) {
  field("name", level.name, "of the level, highest priority first");
  field("status", level.status,
        "missed: its residual is more than rounding; cut off: the solve ended early in it, and "
        "reached none below it");
  field("residual", level.report.residual,
        "root of the summed squared violations, in the rows' unit; null where nothing was solved");
  field("degrees_of_freedom_left", level.report.degrees_of_freedom_left,
        "of the null space below this level");
  field("iterations", level.report.iterations, "of the active-set method");
  field("num_rows", level.report.num_rows, "equalities and inequalities");
  field("num_active", level.report.num_active, "inequality rows at or beyond a bound");
}

template <typename Archive, Is<Row> T>
void fields(Archive& field, T& row) {
  field("level", row.level, "name of its level");
  field("row", row.row, "name of the row");
  field("id", row.id, "identifies the row across ticks");
  field("state", row.state, "-1 and 1: held at its lower or upper bound; -3 and 3: beyond it");
  field("by", row.by,
        "how far beyond its bound, in the unit of the level's rows: positive above the upper one, "
        "negative below the lower one, 0 at it");
}

template <typename Archive, Is<MissedRow> T>
void fields(Archive& field, T& row) {
  field("level", row.level, "name of its level");
  field("row", row.row, "name of the row");
  field("id", row.id, "identifies the row across ticks");
  field("by", row.by, "what it has beyond what it asks for, in the unit of the level's rows");
}

template <typename Archive, Is<BlockingRow> T>
void fields(Archive& field, T& blocking) {
  field("level", blocking.level, "name of the level that was held back");
  field("by", blocking.by, "name of the level that the row belongs to");
  field("row", blocking.row, "name of the row");
  field("id", blocking.report.id, "identifies the row across ticks");
  field(
      "multiplier", blocking.report.multiplier,
      "how fast half the squared residual falls as the row's bound gives way: in the square of the "
      "level's unit by the unit of the row");
  field("cost", blocking.report.cost,
        "what the residual falls by if this row alone gives way, as the control loop estimates it, "
        "in the unit of the level's rows; 0: nothing, or it can't say");
}

template <typename Archive, Is<LevelSwitch> T>
void fields(Archive& field, T& change) {
  field("add", change.add, "names of the levels that come");
  field("remove", change.remove, "names of the levels that go");
  field("duration", change.duration, "in which they come and go [s]");
}

template <typename Archive, Is<Hierarchy> T>
void fields(Archive& field, T& hierarchy) {
  field("status", hierarchy.status,
        "0 optimal, 1 ended at the iteration cap, 2 invalid input, or no state was believed");
  field("failed_level", hierarchy.failed_level,
        "index of the level that ended early, counted from 0; -1: none");
  field("borderline", hierarchy.borderline,
        "which answer is the optimum depends on less than doubles can tell");
  field("levels", hierarchy.levels, "how each level came out");
  field("active", hierarchy.active, "inequality rows at or beyond a bound");
  field("missed", hierarchy.missed,
        "equality rows that their level could not reach, worst first: at most three a level, and "
        "none below a tenth of the worst");
  field("blocking_is_known", hierarchy.blocking_is_known,
        "whether blocked_by speaks of all levels");
  field("blocked_by", hierarchy.blocked_by,
        "rows of higher levels that kept a level from a smaller residual, dearest "
        "first, and of those that cost the same limits");
  field("transition_share", hierarchy.transition_share,
        "of the levels that come or go; 1 where none does");
  field("level_switches", hierarchy.level_switches,
        "asked for at run time and begun at this tick; those of the scenario stand in the header");
}

template <typename Archive, Is<Change> T>
void fields(Archive& field, T& change) {
  field("time", change.time, "of the first tick that has it [s]");
  field("kind", change.kind, "stack, friction, push, walk");
  field("text", change.text, "what was changed, in words");
  field("stack", change.stack, "of kind stack: the whole stack from now on, as a stack file");
  field(
      "duration", change.duration,
      "of kind stack: in which the torques pass from one to the other; of kind push: its own [s]");
  field("friction", change.friction,
        "of kind friction: coefficient that the controller assumes from now on");
  field("body", change.body, "of kind push: the link that is pushed");
  field("force", change.force, "of kind push: at the link's centre of mass, in S [N]");
}

template <typename Archive, Is<JointCommand> T>
void fields(Archive& field, T& command) {
  field("time", command.time, "of the tick that made the command [s]");
  field("torque", command.torque, "joint torques [N·m]");
  field("mode", command.mode, "rung of the safety ladder that made the command");
  field("cause", command.cause, "what took the controller off its optimum for good");
  field("fault", command.fault, "where a sensor is the cause: what was wrong with it then");
  field("joint", command.joint,
        "and of which joint, counted from 0; -1 where of several, or of none");
}

template <typename Archive, Is<TickTiming> T>
void fields(Archive& field, T& timing) {
  field("time", timing.time, "of the tick [s]");
  field("estimate", timing.estimate, "wall-clock time of the stage [µs]");
  field("plan", timing.plan, "of feet, torso and centre of mass [µs]");
  field("model", timing.model, "kinematics and dynamics of the robot [µs]");
  field("stack", timing.stack, "rows of all tasks [µs]");
  field("solve", timing.solve, "of the hierarchy [µs]");
  field("total", timing.total, "of the tick, from the readings to the command [µs]");
}

template <typename Archive, Is<LevelTime> T>
void fields(Archive& field, T& level) {
  field("name", level.name, "of the level, highest priority first");
  field("solve", level.solve,
        "wall-clock time of the level; null where it was not solved by itself [µs]");
}

template <typename Archive, Is<Timing> T>
void fields(Archive& field, T& timing) {
  fields(field, timing.stages);
  field("levels", timing.levels, "of solve, level by level; empty where none was measured");
}

}  // namespace surefoot::logged
