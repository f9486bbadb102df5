#include "surefoot/control/controller.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/control/controller_memory.hpp"
#include "surefoot/control/hierarchy_summary.hpp"
#include "surefoot/control/level_switcher.hpp"
#include "surefoot/control/lying_posture.hpp"
#include "surefoot/control/safety.hpp"
#include "surefoot/control/stack_fade.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/estimation/first_readings.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/signals/plan_event.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace surefoot {
namespace {

double clamp_finite(double value, double limit) {
  return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0;
}

/// What can't be right in a command is dropped or limited, so that it can't reach the plan.
UserCommand sane(const UserCommand& user) {
  UserCommand result = user;
  for (double& v : result.velocity) v = clamp_finite(v, UserCommand::kFastest);
  result.yaw_rate = clamp_finite(user.yaw_rate, UserCommand::kFastest);
  result.height = clamp_finite(user.height, UserCommand::kMostHeight);
  return result;
}

/// No robot comes near these; a single such number would stay in the filters for long.
constexpr double kFurthest = 1e6;    // [m]
constexpr double kFastest = 1e3;     // [m/s] and [rad/s]
constexpr double kMostTurned = 1e3;  // [rad]
constexpr double kStrongest = 1e4;   // [N·m]

/// Without a state that is believed; behind it the plan's time leaps [s].
constexpr double kLongestHold = 1.0;

/// Can the robot be so? Not where a number is NaN.
bool is_plausible(const RobotState& state) {
  const auto within = [](const auto& v, double limit) { return (v.array().abs() <= limit).all(); };
  return std::isfinite(state.time) && within(state.p_WB, kFurthest) && is_rotation(state.q_WB) &&
         within(state.u(), kFastest) && within(state.q, kMostTurned) &&
         within(state.torque, kStrongest);
}

ModelRecord unknown_model() {
  const Vec3 unknown = Vec3::Constant(kNaN);
  ModelRecord model{
      .p_WCom = unknown, .v_WCom = unknown, .load = {.mass = kNaN, .first_moment = unknown}};
  for (PerLeg<Vec3>* vectors : {&model.p_WF, &model.p_WH, &model.force}) vectors->fill(unknown);
  return model;
}

}  // namespace

struct Controller::Implementation : ControllerMemory {
  Implementation(const RobotDescription& robot, const ControllerOptions& options,
                 std::unique_ptr<StateEstimator> state_estimator)
      : Implementation(robot, options, std::move(state_estimator), RobotModel(robot)) {}
  Implementation(const RobotDescription& robot, const ControllerOptions& options,
                 std::unique_ptr<StateEstimator> state_estimator, RobotModel robot_model)
      : ControllerMemory(robot, options, robot_model),
        at_start(*this),
        first_readings(options.period),
        estimator(std::move(state_estimator)),
        model(std::move(robot_model)),
        robot_description(robot),
        solver_options(options.solver),
        solved(std::make_unique<SolvedStack>(options.stack, options.solver, robot)),
        switcher(options.stack, options.level_switches),
        safety(options.safety, robot, solved->stack.first_free_level(),
               lying_posture(model, options.safety.sit_height), options.period) {}

  const JointCommand& step(const SensorReading& reading, const UserCommand& user) noexcept;
  void take_in(SensorReading reading) noexcept;
  void begin_anew() noexcept;
  [[nodiscard]] bool fits_at_rest() noexcept;
  [[nodiscard]] bool estimate() noexcept;
  const Dynamics& feel() noexcept;
  [[nodiscard]] const Solution* act(const UserCommand& user) noexcept;
  void get_on_feet() noexcept;
  void keep_posture() noexcept;
  void stand_anew() noexcept;
  const JointVector& observe_joints() noexcept;
  [[nodiscard]] TickContext context() noexcept;
  void forget_lost_joints() noexcept;
  const Solution* optimise(const Dynamics& dynamics, const UserCommand& user) noexcept;
  void compare_sensors(const Dynamics& dynamics) noexcept;
  void calibrate(const Dynamics& dynamics) noexcept;
  void describe(const Dynamics& dynamics, const Solution& solution) noexcept;
  void describe_refused_state() noexcept;
  [[nodiscard]] bool set_stack(const StackOptions& options, double duration);
  [[nodiscard]] bool is_changing() const { return fade && fade->is_going_on(); }
  void ended(Stage stage) const noexcept {
    if (observer != nullptr) observer->stage_ends(stage);
  }

  ControllerMemory at_start;  // to begin anew with
  FirstReadings first_readings;
  std::unique_ptr<StateEstimator> estimator;
  RobotModel model;
  BaseLoad base_load;  // of this tick
  RobotDescription robot_description;
  SolverOptions solver_options;
  std::unique_ptr<SolvedStack> solved;
  std::unique_ptr<StackFade> fade;  // from the stack before, if there was one; kept when it is over
  LevelSwitcher switcher;
  Safety safety;
  TickRecord record;
  std::array<double, kMaxLevels> level_times{};  // [s]
  bool explains_levels = false;
  bool has_solved = false;  // the last tick
  StageObserver* observer = nullptr;
};

const JointCommand& Controller::Implementation::step(const SensorReading& reading,
                                                     const UserCommand& user) noexcept {
  if (observer != nullptr) observer->tick_begins();
  record.reading = reading;
  record.user = sane(user);
  guard.set_loose(safety.has_stopped() || !safety.has_begun() || !footing.stands());
  take_in(reading);
  record.health = guard.health();
  const bool estimates = std::isfinite(last_time);
  const bool begun_anew =
      first_readings.are_contradicted(reading, guard.clock_is_right(), record.health, estimates) &&
      !safety.has_stopped();
  if (begun_anew) begin_anew();
  if (footing.restarts() && !safety.has_stopped()) stand_anew();
  if (!std::isfinite(last_time)) footing.look_at_start(model, guard.repaired().q);
  const bool believed = estimate();
  ended(Stage::estimate);
  const Solution* solution = believed ? act(record.user) : nullptr;
  if (!believed) describe_refused_state();
  if (!believed && !footing.stands() && !safety.has_stopped()) keep_posture();
  if (begun_anew) record.plan.events.add({.kind = PlanEvent::begun_anew});
  has_solved = solution != nullptr;
  if (believed) safety.set_standing(record.plan.standing());
  // Whose base is not known, but whose joints are.
  const bool waits = !safety.has_begun() && !safety.has_stopped();
  const bool is_blind = !believed && (waits || safety.is_sitting_down());
  if (is_blind) safety.bear(standing_torque(model, record.state.q));
  if (guard.is_shaken()) safety.be_careful();
  record.command = safety.command(record.state, solution, record.health);
  ended(Stage::command);
  return record.command;
}

void Controller::Implementation::take_in(SensorReading reading) noexcept {
  const Quat imu = exp_rotation(kinematics.errors().imu);
  reading.q -= kinematics.errors().zero;
  reading.gyro = imu * reading.gyro;
  reading.accelerometer = imu * reading.accelerometer;
  guard.update(reading, joint_velocity, record.reading);
}

/// With this reading as the first. The tick's health stays what the readings before made it.
void Controller::Implementation::begin_anew() noexcept {
  static_cast<ControllerMemory&>(*this) = at_start;
  estimator->begin_anew();
  safety.begin_anew();
  switcher.begin_anew();
  if (fade) fade->begin_anew();
  record.plan = {};
  take_in(record.reading);
}

/// False where the state is not one to plan and solve with.
bool Controller::Implementation::estimate() noexcept {
  if (!guard.clock_is_right()) {
    record.state.time = kNaN;
    record.state.q = guard.measured().q;  // for the safe commands: what the joints do now
    record.state.qd = observe_joints();
    return false;
  }
  record.state = estimator->update(guard.repaired(), context());
  const bool fits = fits_at_rest();
  forget_lost_joints();
  const bool clock_jumps = std::abs(record.state.time - last_time) > kLongestHold;
  const bool believed = is_plausible(record.state) && !clock_jumps;
  if (believed) last_time = record.state.time;
  return believed && fits && !safety.has_stopped() &&
         safety.lost_sensor(record.health) == StopCause::none;
}

// An IMU that is upside down or has another unit would else be known by its tilt, or never begin.
bool Controller::Implementation::fits_at_rest() noexcept {
  if (!footing.stands() || safety.has_begun() || safety.has_stopped()) return true;
  const SensorReading& reading = guard.repaired();
  const Vec3 force = borne_force(model, reading.q, reading.torque);
  rest_check.update(reading, joint_velocity, force, model.dynamics().mass);
  if (!(rest_check.wrong_for() > 0.0)) return true;
  GroupHealth& wrong = rest_check.torques_pull() ? record.health.joint_torques : record.health.imu;
  if (wrong.fault == SampleFault::none)
    wrong = {.fault = SampleFault::contradicts, .age = rest_check.wrong_for()};
  return false;
}

// What was filled in for an encoder is good for a short time only.
void Controller::Implementation::forget_lost_joints() noexcept {
  if (safety.lost_sensor(record.health) != StopCause::encoders) return;
  const JointVector age = guard.encoder_age();
  for (Eigen::Index i = 0; i < kNumJoints; ++i) {
    if (!safety.is_lost(age[i])) continue;
    record.state.q[i] = kNaN;
    record.state.qd[i] = kNaN;
  }
}

const JointVector& Controller::Implementation::observe_joints() noexcept {
  joint_velocity = contact_force.observe(
      guard.measured(), {.encoders = guard.encoder_delay(), .torques = guard.torque_delay()});
  return joint_velocity;
}

TickContext Controller::Implementation::context() noexcept {
  TickContext result{.joint_velocity = observe_joints(),
                     .joint_lag = guard.joint_lag(),
                     .imu_lag = guard.imu_lag(),
                     .kinematics = kinematics.errors(),
                     .restarts = planner.restarts() || footing.restarts(),
                     .off_its_feet = !footing.stands()};
  for (const Leg leg : kLegs) {
    const Vec3& force = record.state.foot_force[index(leg)];
    result.contacts[index(leg)] = {.carries = record.plan.contact(leg),
                                   .normal_force = planner.terrain_normal().dot(force),
                                   .slips = record.state.slips[index(leg)]};
  }
  return result;
}

const Solution* Controller::Implementation::act(const UserCommand& user) noexcept {
  const Dynamics& dynamics = feel();
  const bool stood = footing.stands();
  const PlanEvent event = footing.update(model, record.state, lift);
  if (stood && footing.stands()) return optimise(dynamics, user);
  get_on_feet();
  record.plan.events.add({.kind = event});
  return nullptr;
}

/// The model and the ground's forces on the feet.
const Dynamics& Controller::Implementation::feel() noexcept {
  model.set_leg_lengths(kinematics.errors());
  base_load = com_calibration.load();
  model.set_base_load(base_load);
  const Dynamics& dynamics = model.update(record.state, planner.terrain_normal());
  contact_force.update(dynamics, record.plan.standing(), planner.terrain_normal(), guard.repaired(),
                       record.state);
  lift.update(kGravity * dynamics.mass, record.state.foot_force, guard.repaired().accelerometer);
  return dynamics;
}

/// Nothing is planned or solved for a robot that is not on its feet.
void Controller::Implementation::get_on_feet() noexcept {
  const LegPosture posture = footing.posture(lift);
  describe_refused_state();
  record.plan.time = record.state.time;
  record.plan.calibration = CalibrationStage::none;
  for (const Leg leg : kLegs) {
    const bool stands = posture.stands[index(leg)];
    record.plan.feet[index(leg)].phase = stands ? LegPhase::stance : LegPhase::swing;
  }
  consistency.forget();
  kinematics.forget();
  keep_posture();
  if (footing.has_failed()) safety.give_up_standing();
}

/// Also where the state of this tick is not believed.
void Controller::Implementation::keep_posture() noexcept {
  safety.bear(standing_torque(model, record.state.q));
  safety.pose(footing.posture(lift), footing.hangs() ? CommandMode::lifted : CommandMode::rise);
}

/// It has come to stand: of where it stood, who pushed it, and what its legs were felt to weigh as
/// they lay on the ground, nothing holds any more.
void Controller::Implementation::stand_anew() noexcept {
  planner.begin_anew(at_start.planner);
  contact_force = at_start.contact_force;
  slip = at_start.slip;
  external_force = at_start.external_force;
  rest_check = at_start.rest_check;
  safety.begin_anew();
}

const Solution* Controller::Implementation::optimise(const Dynamics& dynamics,
                                                     const UserCommand& user) noexcept {
  slip.update(dynamics, record.plan.standing(), planner.terrain_normal(), record.state);
  external_force.update(dynamics, record.plan.standing(), record.state);
  compare_sensors(dynamics);
  calibrate(dynamics);
  model.apply_wrench(record.state.external_force, record.state.external_moment);
  ended(Stage::model);
  record.plan = planner.update(user, record.state, dynamics, last);
  ended(Stage::plan);
  TaskStack& stack = solved->stack;
  HierarchySolver& solver = solved->solver;
  const LevelTransition& transition = switcher.update(record.state.time);
  stack.set_present(transition.before | transition.after);
  const Hierarchy& hierarchy = stack.update(dynamics, record.plan);
  ended(Stage::stack);
  const Substitution* physics =
      solver.wants_substitution() ? stack.substitution(dynamics) : nullptr;
  const Solution* solution = &solver.solve(hierarchy, physics, transition);
  if (is_changing()) {
    solution = &fade->between(dynamics, record.plan, record.state.time, hierarchy, *solution);
  }
  ended(Stage::solve);
  describe(dynamics, *solution);
  return solution;
}

// Legs that are found to be other than they were believed to be have not moved; feet that bear
// nothing do not stand.
void Controller::Implementation::compare_sensors(const Dynamics& dynamics) noexcept {
  if (kinematics.errors() != errors_before) consistency.legs_have_changed();
  errors_before = kinematics.errors();
  if (lift.seems_lifted()) {
    consistency.forget();
    return;
  }
  const PerLeg<bool> stands = record.plan.standing();
  PerLeg<Vec3> v_WF;
  for (std::size_t k = 0; k < kNumLegs; ++k) v_WF[k] = record.plan.feet[k].v_WF;
  const Vec3 normal_W = planner.terrain_normal();
  consistency.update(guard.repaired(), guard.offered(),
                     {.state = record.state,
                      .dynamics = dynamics,
                      .stands = stands,
                      .v_WF = v_WF,
                      .normal_W = normal_W,
                      .command = record.command.torque},
                     record.health);
  guard.judge_imu_step(consistency.imu_step());
}

static_assert(KinematicCalibration::kFadeIn <= CalibrationMotion::kTakeOver);

void Controller::Implementation::calibrate(const Dynamics& dynamics) noexcept {
  const bool is_quiet = planner.is_undisturbed(record.state);
  const CalibrationStage stage = record.plan.calibration;
  const bool turning = stage == CalibrationStage::turning;
  if (turning && !is_quiet) {
    kinematics.forget();
  } else {
    kinematics.update(record.state.time, dynamics, guard.repaired().gyro, planner.terrain_normal(),
                      turning);
  }
  link_masses.update(record.state.time, dynamics, record.plan.standing(), record.state.torque);
  com_calibration.correct(link_masses.shares());
  com_calibration.update(dynamics, record.state.foot_force, stage, is_quiet);
  planner.tell_calibration_known(kinematics.knows_legs() && com_calibration.knows_load());
}

void Controller::Implementation::describe(const Dynamics& dynamics,
                                          const Solution& solution) noexcept {
  const TaskStack& stack = solved->stack;
  summarise(solution, stack.hierarchy(), record.hierarchy);
  level_times.fill(0.0);
  for (std::size_t k = 0; k < std::min(solution.levels.size(), kMaxLevels); ++k) {
    level_times[k] = solution.levels[k].time;
  }
  if (explains_levels && !is_changing()) {
    summarise_blockers(solved->solver.blockers(), stack.hierarchy(), record.hierarchy);
  }
  record.hierarchy.transition_share = is_changing() ? fade->share() : switcher.transition().share;
  record.hierarchy.level_switch = switcher.begun();
  const bool is_optimum = record.hierarchy.transition_share >= 1.0;
  last = {.tilt_shortfall = is_optimum ? stack.tilt_shortfall(solution) : kNaN,
          .pyramid_normal = stack.pyramid_normals(record.plan)};
  record.model.p_WCom = dynamics.com.p;
  record.model.v_WCom = dynamics.com.v;
  record.model.load = base_load;
  for (const Leg leg : kLegs) {
    const std::size_t k = index(leg);
    record.model.p_WF[k] = dynamics.foot[k].p;
    record.model.p_WH[k] = dynamics.hip[k].p;
    record.model.force[k] = stack.support().force(leg, solution.x);
  }
}

// Nothing happened and nothing was solved: what the last tick said must not be logged once more.
void Controller::Implementation::describe_refused_state() noexcept {
  record.plan.events = {};
  record.model = unknown_model();
  last = {};
  level_times.fill(0.0);
  const std::int32_t num_levels = record.hierarchy.num_levels;
  record.hierarchy = HierarchyReport{};
  record.hierarchy.num_levels = num_levels;
  for (LevelReport& level : record.hierarchy.levels) level.residual = kNaN;
  record.hierarchy.status = static_cast<std::int32_t>(SolveStatus::invalid_input);
}

bool Controller::Implementation::set_stack(const StackOptions& options, double duration) {
  check_stack_change(switcher.stack(), options, duration);
  if (is_changing() || !switcher.is_idle()) return false;  // before what costs much
  LevelSwitcher next_switcher = switcher.for_stack(options);
  auto next = std::make_unique<SolvedStack>(options, solver_options, robot_description);
  const int first_free_level = next->stack.first_free_level();
  fade =
      std::make_unique<StackFade>(std::exchange(solved, std::move(next)),
                                  switcher.transition().after, solved->stack.hierarchy(), duration);
  switcher = std::move(next_switcher);
  safety.set_first_free_level(first_free_level);
  return true;
}

Controller::Controller(const RobotDescription& robot, const ControllerOptions& options,
                       std::unique_ptr<StateEstimator> estimator) {
  if (estimator == nullptr) throw Error("the controller was given no state estimator");
  implementation_ = std::make_unique<Implementation>(robot, options, std::move(estimator));
}

Controller::~Controller() = default;

const JointCommand& Controller::step(const SensorReading& reading,
                                     const UserCommand& user) noexcept {
  return implementation_->step(reading, user);
}

bool Controller::switch_levels(const LevelSwitch& change) {
  check_level_switch(implementation_->switcher.stack(), change);
  return !implementation_->is_changing() && implementation_->switcher.start(change);
}

bool Controller::set_stack(const StackOptions& stack, double duration) {
  return implementation_->set_stack(stack, duration);
}

void Controller::set_friction(double friction) {
  implementation_->planner.set_friction(friction);
  implementation_->at_start.planner.set_friction(friction);
}

const TickRecord& Controller::record() const { return implementation_->record; }

const std::array<double, kMaxLevels>& Controller::level_times() const {
  return implementation_->level_times;
}

const Hierarchy& Controller::hierarchy() const {
  return implementation_->solved->stack.hierarchy();
}

const Dynamics* Controller::dynamics() const {
  return implementation_->has_solved ? &implementation_->model.dynamics() : nullptr;
}

std::vector<std::string> Controller::level_names() const {
  const Hierarchy& hierarchy = implementation_->solved->stack.hierarchy();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < hierarchy.num_levels(); ++i)
    names.push_back(hierarchy.level(i).name());
  return names;
}

std::vector<std::string> Controller::level_units() const {
  return implementation_->solved->stack.units();
}

std::string Controller::row_name(int level, int id) const {
  return implementation_->solved->stack.row_name(level, id);
}

std::vector<std::vector<std::string>> Controller::row_names() const {
  return implementation_->solved->stack.row_names();
}

std::vector<std::string> Controller::notes() const { return implementation_->model.notes(); }

void Controller::explain_levels(bool wanted) { implementation_->explains_levels = wanted; }

void Controller::set_stage_observer(StageObserver* observer) {
  implementation_->observer = observer;
}

int Controller::steps_taken() const { return implementation_->planner.steps_taken(); }

}  // namespace surefoot
