#include "surefoot/simulation/plant.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/simulation/actuators.hpp"
#include "surefoot/simulation/check_options.hpp"
#include "surefoot/simulation/disturbances.hpp"
#include "surefoot/simulation/model_builder.hpp"
#include "surefoot/simulation/robot_parts.hpp"
#include "surefoot/simulation/sensor_link.hpp"
#include "surefoot/simulation/sensors.hpp"
#include "surefoot/simulation/stand_up.hpp"
#include "surefoot/simulation/starting_posture.hpp"
#include "surefoot/simulation/terrain.hpp"
#include "surefoot/simulation/text.hpp"
#include "surefoot/simulation/truth.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::simulation {

namespace {

constexpr std::size_t kMaxNotes = 100;  // limits the memory of a lasting fault

}  // namespace

struct Plant::Implementation {
  Implementation(const model::RobotDescription& description, const PlantOptions& given)
      : options(completed(given, description)),
        steps(steps_per_period(options)),
        catcher(std::make_unique<MessageCatcher>(notes)),
        built(build_model(description, options, notes)),
        model(*built.model),
        data_handle(mj_makeData(built.model.get())),
        data(*data_handle),
        parts(find_parts(model, description)),
        pushes(options.disturbances, model, description.base_link, description.scale),
        actuators(options.actuators, description.torque_limit, options.timestep,
                  description.num_leg_joints()),
        sensors(options.sensors, options.control_period, options.seed),
        link(options.sensors, options.control_period),
        touched(description.num_legs(), false) {
    place(description);
    mj_step1(&model, &data);
    check_starting_posture(model, data, parts, description.urdf_path);
    settle(description);
    observe();
    catcher.reset();
  }

  /// Scenarios tell what belongs to the joints of legs; those of arms are as the robot's file says.
  static PlantOptions completed(PlantOptions options, const model::RobotDescription& robot) {
    check_options(options);
    const Eigen::Index n = robot.num_joints();
    const auto extend = [n, &robot](JointVector& values, const JointVector& others) {
      const Eigen::Index known = robot.can_walk() ? std::min(values.size(), n) : 0;
      values.conservativeResize(n);
      values.tail(n - known) = others.tail(n - known);
    };
    extend(options.actuators.stall_torque, robot.stall_torque);
    extend(options.actuators.no_load_speed, robot.no_load_speed);
    extend(options.actuators.joint_torque_gain, JointVector::Ones(n));
    extend(options.sensors.encoders.offset, JointVector::Zero(n));
    extend(options.initial.q, robot.q_nominal);
    if (robot.can_walk()) set_num_legs(options.disturbances, robot.num_legs());
    return options;
  }

  void place(const model::RobotDescription& description);
  void settle(const model::RobotDescription& description);
  void set_joints(const JointVector& q);
  double touching_height(const model::RobotDescription& description) const;
  void raise_out_of_terrain();
  JointVector finite(JointVector torque);
  void write(const JointVector& torque);
  void physics_step();
  void set_torques();
  void observe();
  void check_state() const;

  PlantOptions options;
  int steps;
  std::vector<std::string> notes;
  std::unique_ptr<MessageCatcher> catcher;
  BuiltModel built;
  const mjModel& model;
  DataHandle data_handle;
  mjData& data;
  RobotParts parts;
  Pushes pushes;
  Actuators actuators;
  Sensors sensors;
  SensorLink link;
  PerLeg<bool> touched;  ///< feet that touched in a physics step since the tick before
  GroundTruth truth;
  SensorReading sampled;
  std::int64_t tick = 0;
};

void Plant::Implementation::set_joints(const JointVector& q) {
  for (std::size_t i = 0; i < parts.qpos.size(); ++i) {
    data.qpos[parts.qpos[i]] = q[static_cast<Eigen::Index>(i)];
  }
}

void Plant::Implementation::place(const model::RobotDescription& description) {
  const InitialState& initial = options.initial;
  mjtNum* base = data.qpos + parts.base_qpos;
  base[0] = initial.position.x();
  base[1] = initial.position.y();
  base[2] = 0.0;
  base[3] = std::cos(0.5 * initial.yaw);
  base[4] = base[5] = 0.0;
  base[6] = std::sin(0.5 * initial.yaw);
  set_joints(initial.q);
  actuators.rest_at(initial.q, JointVector::Zero(initial.q.size()));
  mj_kinematics(&model, &data);
  const bool is_placed = !std::isnan(initial.position.z());
  base[2] = is_placed ? initial.position.z() : touching_height(description);
  if (initial.is_given && !is_placed) raise_out_of_terrain();
}

void Plant::Implementation::settle(const model::RobotDescription& description) {
  const InitialState& initial = options.initial;
  if (initial.settle <= 0.0) return;
  const JointVector torque = stand_up(model, data, parts,
                                      {initial.q, description.torque_limit, initial.settle,
                                       options.timestep, initial.limp, description.scale});
  actuators.rest_at(joint_positions(data, parts), torque);
}

/// Raises the robot by its deepest penetration: touching_height() considers only the feet.
void Plant::Implementation::raise_out_of_terrain() {
  constexpr int kTries = 5;
  constexpr double kTouches = 1e-4;  // [m]
  for (int i = 0; i < kTries; ++i) {
    mj_kinematics(&model, &data);
    mj_collision(&model, &data);
    double deepest = 0.0;
    for (int id = 0; id < data.ncon; ++id) {
      const mjContact& contact = data.contact[id];
      const bool on_terrain =
          parts.owner[static_cast<std::size_t>(contact.geom[0])].part == Part::terrain ||
          parts.owner[static_cast<std::size_t>(contact.geom[1])].part == Part::terrain;
      if (on_terrain) deepest = std::max(deepest, -contact.dist);
    }
    if (deepest < kTouches) return;
    data.qpos[parts.base_qpos + 2] += deepest;
  }
}

/// Base height at which the first foot touches the terrain; the base is at z = 0 now.
double Plant::Implementation::touching_height(const model::RobotDescription& description) const {
  double height = -std::numeric_limits<double>::infinity();
  for (const Leg leg : description.legs.legs()) {
    const int geom = parts.foot_geom[index(leg)];
    const mjtNum* center = data.geom_xpos + 3 * geom;
    const double resting =
        resting_height(model, data, center[0], center[1], description.legs[index(leg)].foot_radius);
    const double sole = description.can_walk() ? 0.0 : model.geom_size[3 * geom + 2];
    if (!std::isnan(resting)) height = std::max(height, resting - center[2] + sole);
  }
  if (std::isinf(height)) {
    throw Error(text("initial.position (", options.initial.position.x(), ", ",
                     options.initial.position.y(),
                     "): no foot is above terrain; give a z, or a place on the terrain"));
  }
  return height;
}

void Plant::Implementation::set_torques() {
  const JointVector torque =
      actuators.torque(joint_positions(data, parts), joint_velocities(data, parts));
  for (std::size_t i = 0; i < parts.qpos.size(); ++i) {
    data.ctrl[parts.actuator[i]] = torque[static_cast<Eigen::Index>(i)];
  }
}

void Plant::Implementation::physics_step() {
  set_torques();
  pushes.apply(options.timestep, data);
  const Quat q_SB = base_orientation(data, parts);
  const Vec3 v_before = base_velocity(data, parts);
  mj_step2(&model, &data);
  note_touches(model, data, parts, touched);
  const Vec3 acceleration = (base_velocity(data, parts) - v_before) / options.timestep;
  sensors.accumulate(q_SB.conjugate() * (acceleration + Vec3(0.0, 0.0, kGravity)));
  actuators.advance(joint_positions(data, parts));
  mj_step1(&model, &data);
}

/// Contact forces of the new state, under its torques; then truth and readings.
void Plant::Implementation::observe() {
  set_torques();
  mj_forwardSkip(&model, &data, mjSTAGE_VEL, 1);
  check_state();
  truth.time = static_cast<double>(tick) * options.control_period;
  extract_truth(model, data, parts, truth);
  for (std::size_t leg = 0; leg < truth.feet.size(); ++leg) {
    truth.feet[leg].touched = truth.feet[leg].touching || touched[leg];
  }
  touched.fill(false);
  sensors.read(truth, sampled);
  link.transmit(sampled);
}

void Plant::Implementation::check_state() const {
  const bool good = data.warning[mjWARN_BADQPOS].number == 0 &&
                    data.warning[mjWARN_BADQVEL].number == 0 &&
                    data.warning[mjWARN_BADQACC].number == 0;
  if (!good) {
    throw Error(text("the physics diverged before t = ", data.time,
                     " s; a smaller timestep or softer contacts (contact.solref_time) may help"));
  }
}

/// Drives refuse a torque that is not a number and apply 0.
JointVector Plant::Implementation::finite(JointVector torque) {
  if (torque.size() != truth.q.size()) {
    throw Error(text("the command has ", torque.size(), " torques, but the robot has ",
                     truth.q.size(), " joints"));
  }
  for (Eigen::Index i = 0; i < torque.size(); ++i) {
    if (std::isfinite(torque[i])) continue;
    torque[i] = 0.0;
    if (notes.size() >= kMaxNotes) continue;
    notes.push_back(text("t = ", data.time, " s: the torque commanded to joint ", i,
                         " was not finite; 0 was applied"));
  }
  return torque;
}

void Plant::Implementation::write(const JointVector& torque) {
  const MessageCatcher messages(notes);
  actuators.command(finite(torque));
  for (int i = 0; i < steps; ++i) physics_step();
  ++tick;
  observe();
}

Plant::Plant(const model::RobotDescription& description, const PlantOptions& options)
    : implementation_(std::make_unique<Implementation>(description, options)) {}

Plant::~Plant() = default;

const SensorReading& Plant::read() { return implementation_->link.received(); }

void Plant::write(const JointCommand& command) { implementation_->write(command.torque); }

void Plant::push(const Push& push) {
  Push valid = push;
  valid.time = std::max(push.time, implementation_->data.time);
  implementation_->pushes.add(valid, implementation_->data.time);
}

std::vector<std::string> Plant::bodies() const { return implementation_->pushes.bodies(); }

void Plant::fail(const SensorFault& fault) {
  PlantOptions with_fault = implementation_->options;
  SensorFault& valid = with_fault.sensors.faults.emplace_back(fault);
  valid.num_legs = static_cast<int>(implementation_->touched.size());
  valid.time = std::max(fault.time, implementation_->data.time);
  check_options(with_fault);
  implementation_->link.add(valid);
}

const GroundTruth& Plant::truth() const { return implementation_->truth; }

double Plant::time() const { return implementation_->truth.time; }

std::string Plant::model_xml() const { return implementation_->built.xml; }

const std::vector<std::string>& Plant::notes() const { return implementation_->notes; }

double Plant::terrain_height(double x, double y) const {
  return simulation::terrain_height(implementation_->model, implementation_->data, x, y);
}

}  // namespace surefoot::simulation
