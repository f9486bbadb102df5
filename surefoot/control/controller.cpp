#include "surefoot/base/checked_period.hpp"
#include "surefoot/control/checked_input.hpp"
#include "surefoot/control/controller_implementation.hpp"
#include "surefoot/control/lying_posture.hpp"
#include "surefoot/control/own_parts.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/control/unsolved_tick.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/signals/plan_event.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

namespace surefoot::control {
namespace {

/// The inertia that each joint's torque alone turns in the nominal posture, 1 / (M⁻¹)_jj [kg·m²].
JointVector turned_inertia(model::RobotModel& model) {
  const model::RobotDescription& robot = model.description();
  const MatX inverse = model.update(level_at_rest(robot.q_nominal), Vec3::UnitZ()).M.inverse();
  return inverse.diagonal().tail(robot.num_joints()).cwiseInverse();
}

}  // namespace

Controller::Implementation::Implementation(
    const model::RobotDescription& robot, const ControllerOptions& options,
    std::unique_ptr<estimation::StateEstimator> state_estimator,
    std::unique_ptr<gaits::MotionPlanner> own_planner)
    : model(robot),
      estimator(std::move(state_estimator)),
      has_own_planner(own_planner != nullptr),
      checks_plan(has_own_planner || has_own_gait(options)),
      planner(has_own_planner
                  ? std::move(own_planner)
                  : gaits::make_planner(options.planner, checked_period(options.period),
                                        robot.scale, options.gaits, options.first_gait)),
      memory{.guard = {options.guard, robot, checked_period(options.period)},
             .estimation = {options, *estimator, model},
             .calibration = {options.link_masses, robot, model.base_mass(), options.period},
             .footing = {options.planner.stance, options.period, robot.scale},
             .arm = {options.period, robot.scale},
             .frames = {options.period, robot.scale},
             .last = {}},
      at_start(memory),
      first_readings(options.period),
      stack(options, robot),
      safety(options.safety, robot, stack.tasks().first_free_level(),
             lying_posture(model, options.safety.sit_height), options.period) {
  check_physics(options.stack);
  own_parts = own_gaits_and_tasks(options);
  if (has_own_planner) own_parts.insert(own_parts.begin(), "planner");
  if (estimator->is_own()) own_parts.insert(own_parts.begin(), "estimator");
  notes = model.notes();
  std::ranges::copy(missing_physics(options.stack), std::back_inserter(notes));
  size_joints(record, robot.num_joints(), robot.num_legs());
  record.command.torque.setZero();
  memory.last = at_start.last = remember({});
  follow_frames();
  if (robot.num_joints() > kJointsPerLeg * robot.num_legs())
    safety.soften_light(turned_inertia(model));
  if (robot.can_walk()) {
    const RobotState at_rest = level_at_rest(robot.q_nominal);
    safety.soften_roll(limp_inertia(model.update(at_rest, Vec3::UnitZ()))(0, 0));
  }
}

void Controller::Implementation::follow_frames() {
  for (gaits::FrameReferences* frames : {&memory.frames, &at_start.frames})
    frames->follow(stack.tasks().followed_frames(), stack.tasks().follows_joints());
}

const JointCommand& Controller::Implementation::step(const SensorReading& reading,
                                                     const UserCommand& user) noexcept {
  begin_tick(reading, user);
  const estimation::ReadingGuard& seen = sense();
  if (!estimate(seen)) return command_without_state();
  if (!is_on_its_feet()) return command_off_its_feet();
  const model::Dynamics& dynamics = calibrate(seen);
  if (!plan_motion(dynamics)) return command_without_plan();
  const MotionPlan& plan = record.plan;
  stack.update(record.state.time, dynamics, plan);
  ended(Stage::stack);
  const solver::Solution& solution = stack.solve(record.state.time, dynamics, plan);
  blame(stack.fault());
  ended(Stage::solve);
  describe(dynamics, solution);
  return command(solution);
}

void Controller::Implementation::begin_tick(const SensorReading& reading,
                                            const UserCommand& user) noexcept {
  if (observer != nullptr) observer->tick_begins();
  record.reading = reading;
  const auto num_joints = static_cast<Eigen::Index>(model.description().num_joints());
  if (reading.q.size() != num_joints || reading.torque.size() != num_joints)
    fault.set("the reading does not have the robot's number of joints");
  const int num_legs = model.description().num_legs();
  const PerLeg<double>& forces = reading.foot_force;
  const bool has_foot_sensors =
      !std::ranges::all_of(forces, [](double f) { return std::isnan(f); });
  if (has_foot_sensors && static_cast<int>(forces.size()) != num_legs)
    fault.set("the reading's foot_force does not have the robot's number of legs");
  size_joints(record, model.description().num_joints(), num_legs);
  record.user = limited(user);
}

/// The only stage that sees raw samples.
const estimation::ReadingGuard& Controller::Implementation::sense() noexcept {
  const RobotMode before = mode();
  estimation::ReadingGuard& guard = memory.guard;
  guard.set_loose(before.has_stopped || !before.has_begun || !before.stands);
  if (memory.last.imu_step) guard.judge_imu_step(*memory.last.imu_step);
  guard_reading(record.reading);
  record.health = guard.health();
  has_begun_anew = first_readings.are_contradicted(record.reading, guard.clock_is_right(),
                                                   record.health, memory.estimation.has_begun()) &&
                   !before.has_stopped;
  if (has_begun_anew) restart();
  if (memory.footing.restarts() && !before.has_stopped) restart_standing();
  const bool can_lie = model.description().can_walk();
  if (can_lie && !memory.estimation.has_begun())
    memory.footing.look_at_start(model, guard.repaired().q);
  return guard;
}

/// Corrects the reading by the calibrated errors.
void Controller::Implementation::guard_reading(SensorReading reading) noexcept {
  const KinematicErrors& errors = memory.last.kinematics;
  const Quat imu = exp_rotation(errors.imu);
  reading.q.head(errors.zero.size()) -= errors.zero;
  reading.gyro = imu * reading.gyro;
  reading.accelerometer = imu * reading.accelerometer;
  memory.guard.update(reading, memory.last.joint_velocity, record.reading);
}

/// Restarts with this reading as the first. The tick keeps its health from the readings before.
void Controller::Implementation::restart() noexcept {
  memory = at_start;
  memory.last.torque = record.command.torque;
  PartFault found;
  (void)runs([&] { estimator->restart(); }, found, "restart() of the state estimator");
  (void)runs([&] { planner->restart(); }, found, "restart() of the planner");
  blame(found);
  safety.restart();
  stack.restart();
  record.plan = {};
  record.plan.feet.resize(model.description().num_legs());
  guard_reading(record.reading);
}

/// The robot has stood up: discards where it stood before.
void Controller::Implementation::restart_standing() noexcept {
  memory.arm = at_start.arm;
  memory.frames = at_start.frames;
  PartFault found;
  (void)runs([&] { planner->restart(); }, found, "restart() of the planner");
  blame(found);
  memory.estimation.restart_standing(at_start.estimation);
  memory.last.terrain_normal_W = planner->terrain_normal(record.plan);
  safety.restart();
}

/// False: the state can't be used for planning.
bool Controller::Implementation::estimate(const estimation::ReadingGuard& seen) noexcept {
  const RobotMode now = mode();
  StateEstimation& estimation = memory.estimation;
  const LastTick& last = memory.last;
  const bool is_known = estimation.estimate_motion(seen, last, now, record.health);
  blame(estimation.fault());
  ended(Stage::estimate);
  if (is_known) {
    model.set_leg_lengths(last.kinematics);
    model.set_base_load(last.load);
    const model::Dynamics& dynamics = model.update(estimation.state(), last.terrain_normal_W);
    estimation.estimate_forces(seen, dynamics, last, now, record.health);
  }
  record.state = estimation.state();
  return is_known;
}

// One that can't get up is never told to: it falls, or damps.
bool Controller::Implementation::is_on_its_feet() noexcept {
  if (!model.description().can_walk()) return true;
  const bool stood = memory.footing.stands();
  const PlanEvent event = memory.footing.update(model, record.state, memory.estimation.lift());
  record.plan.events = {};
  record.plan.events.add({.kind = event});
  if (memory.footing.has_fallen()) safety.give_up(StopCause::fallen);
  return stood && memory.footing.stands();
}

/// Calibration results act from the next tick on, the estimated external force at once.
const model::Dynamics& Controller::Implementation::calibrate(
    const estimation::ReadingGuard& seen) noexcept {
  const RobotState& state = record.state;
  if (!model.description().can_walk()) {
    ended(Stage::model);
    return model.dynamics();
  }
  memory.calibration.update(state, model.dynamics(), seen.repaired().gyro, memory.last,
                            planner->is_undisturbed(state));
  planner->tell_calibration_known(memory.calibration.is_known());
  model.apply_wrench(state.external_force, state.external_moment);
  ended(Stage::model);
  return model.dynamics();
}

/// False: a planner of the user's own gave no plan that can be followed.
bool Controller::Implementation::plan_motion(const model::Dynamics& dynamics) noexcept {
  PartFault found;
  const MotionPlan* plan = nullptr;
  const auto update = [&] {
    plan = &planner->update(record.user, record.state, dynamics, memory.last.outcome);
  };
  if (runs(update, found, "the planner") && checks_plan)
    found.set(what_is_wrong(*plan, model.description()));
  blame(found);
  if (!found.is_set()) {
    record.plan = *plan;
    memory.frames.complete(record.plan, record.user.reach, dynamics);
  }
  record.plan.time = record.state.time;
  record.plan.arm = memory.arm.update(record.user.reach, record.state, dynamics);
  ended(Stage::plan);
  return !found.is_set();
}

/// Holds the posture.
const JointCommand& Controller::Implementation::command_without_plan() noexcept {
  describe_unsolved(record, level_times);
  record.plan.events = {};
  return finish(nullptr, {});
}

void Controller::Implementation::blame(const PartFault& found) noexcept {
  if (!found.is_set()) return;
  fault = found;
  safety.blame_own_part();
}

const JointCommand& Controller::Implementation::command(const solver::Solution& solution) noexcept {
  safety.set_standing(record.plan.standing());
  return finish(&solution, stack.outcome(solution, record.plan));
}

/// Uses the joint angles alone, if known.
const JointCommand& Controller::Implementation::command_without_state() noexcept {
  describe_unsolved(record, level_times);
  record.plan.events = {};
  if (!memory.footing.stands() && !safety.has_stopped()) keep_posture();
  const bool waits = !safety.has_begun() && !safety.has_stopped();
  if (waits || safety.is_sitting_down()) safety.bear(standing_torque(model, record.state.q));
  return finish(nullptr, {});
}

/// Without plan and solution.
const JointCommand& Controller::Implementation::command_off_its_feet() noexcept {
  record.plan.arm = {};
  record.plan.frames = {};
  describe_unsolved(record, level_times);
  record.plan.time = record.state.time;
  record.plan.calibration = CalibrationStage::none;
  const LegPosture posture = memory.footing.posture(memory.estimation.lift());
  for (const Leg leg : posture.stands.legs()) {
    const bool stands = posture.stands[index(leg)];
    record.plan.feet[index(leg)].phase = stands ? LegPhase::stance : LegPhase::swing;
  }
  memory.estimation.forget_contacts();
  memory.calibration.forget();
  keep_posture();
  if (memory.footing.has_failed()) safety.give_up(StopCause::cannot_stand);
  safety.set_standing(record.plan.standing());
  return finish(nullptr, {});
}

void Controller::Implementation::keep_posture() noexcept {
  const Footing& footing = memory.footing;
  const Righting righting = footing.righting(model.dynamics(), record.state);
  safety.bear(standing_torque(model, record.state.q, righting));
  safety.pose(footing.posture(memory.estimation.lift()),
              footing.hangs() ? CommandMode::lifted : CommandMode::rise);
}

/// `solution` is null if nothing was solved.
const JointCommand& Controller::Implementation::finish(const solver::Solution* solution,
                                                       const HierarchyOutcome& outcome) noexcept {
  if (has_begun_anew) record.plan.events.add({.kind = PlanEvent::begun_anew});
  has_solved = solution != nullptr;
  if (memory.guard.is_shaken()) safety.limit_next_change();
  record.command = safety.command(record.state, solution, record.health);
  memory.last = remember(outcome);
  ended(Stage::command);
  return record.command;
}

RobotMode Controller::Implementation::mode() const {
  return {.stands = memory.footing.stands(),
          .has_begun = safety.has_begun(),
          .has_stopped = safety.has_stopped()};
}

LastTick Controller::Implementation::remember(const HierarchyOutcome& outcome) const noexcept {
  LastTick last{.plan = record.plan,
                .terrain_normal_W = planner->terrain_normal(record.plan),
                .foot_force = record.state.foot_force,
                .slips = record.state.slips,
                .joint_velocity = memory.estimation.joint_velocity(),
                .torque = record.command.torque,
                .kinematics = memory.calibration.kinematics(),
                .load = memory.calibration.load(),
                .outcome = outcome,
                .imu_step = memory.estimation.imu_step(),
                .restarts = planner->restarts() || memory.footing.restarts()};
  last.outcome.pyramid_normal.resize(model.description().num_legs());
  return last;
}

void Controller::Implementation::describe(const model::Dynamics& dynamics,
                                          const solver::Solution& solution) noexcept {
  stack.describe(solution, explains_levels, record.hierarchy);
  level_times.fill(0.0);
  for (std::size_t k = 0; k < std::min(solution.levels.size(), kMaxLevels); ++k) {
    level_times[k] = solution.levels[k].time;
  }
  record.model.p_WCom = dynamics.com.p;
  record.model.v_WCom = dynamics.com.v;
  record.model.load = memory.last.load;
  for (const Leg leg : dynamics.foot.legs()) {
    const std::size_t k = index(leg);
    record.model.p_WF[k] = dynamics.foot[k].p;
    record.model.p_WH[k] = dynamics.hip[k].p;
    record.model.force[k] = stack.tasks().support().force(leg, solution.x);
  }
}

}  // namespace surefoot::control
