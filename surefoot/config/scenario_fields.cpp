#include "surefoot/config/scenario_fields.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/names_of.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/terrain_fields.hpp"
#include "surefoot/simulation/check_options.hpp"
#include "surefoot/simulation/plant_elements.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::config {
namespace {

/// Of a run: limited, as the times of all ticks are stored.
constexpr NumberRange kDuration{
    .min = 0.0, .max = 1e6, .min_included = false, .words = "a number above 0, at most 1e6 s"};
constexpr NumberRange kSettle{.min = 0.0, .max = 5.0, .words = "from 0 to 5 s"};
constexpr NumberRange kTimestep{.min = 1e-5, .words = "a number of at least 1e-5 s"};
constexpr NumberRange kHeight{.min = -UserCommand::kMostHeight,
                              .max = UserCommand::kMostHeight,
                              .words = "from -0.3 to 0.3 m"};
static_assert(UserCommand::kMostHeight == 0.3);

/// A push in a file: a force, an impulse over its duration, or magnitude and direction.
struct PushInFile {
  simulation::Push push;
  Vec3 impulse = Vec3::Zero();
  double magnitude = 0.0, direction = 0.0;
};

Group fields(PushInFile& o) {
  return fields(o.push).and_also(
      {{"impulse", Numbers{o.impulse.data(), simulation::axis_elements()}, kAnyNumber, "N·s",
        "in S, over the duration, instead of a force"},
       {"magnitude", &o.magnitude, kNotNegative, "N", "of a level force, instead of a force"},
       {"direction", &o.direction, kAnyNumber, "rad", "of a magnitude, from S's x about z"}});
}

simulation::Push push_of(const PushInFile& o, const Given& given) {
  const bool has_force = given.has("force"), has_impulse = given.has("impulse"),
             has_magnitude = given.has("magnitude");
  if (int{has_force} + int{has_impulse} + int{has_magnitude} != 1)
    given.fail("force", "a push has either a force, an impulse or a magnitude");
  if (given.has("direction") && !has_magnitude)
    given.fail("direction", "only a push with a magnitude has a direction");
  if (has_magnitude && !given.has("direction")) given.fail("direction", "this key is missing");
  simulation::Push push = o.push;
  if (has_impulse) push.force = o.impulse / push.duration;
  if (has_magnitude)
    push.force = o.magnitude * Vec3(std::cos(o.direction), std::sin(o.direction), 0.0);
  return push;
}

/// Size of a fault: in the sensor's unit for jumps and spikes, in ticks for late samples, a factor
/// for scaled ones; the others have none.
void check_size(const simulation::SensorFault& fault, const Given& given) {
  const bool late = fault.kind == simulation::FaultKind::late;
  const bool off =
      fault.kind == simulation::FaultKind::jump || fault.kind == simulation::FaultKind::spike;
  const bool has_size = late || off || fault.kind == simulation::FaultKind::scaled;
  if (given.has("size") && !has_size)
    given.fail("size", "only jump, spike, scaled and late have one");
  if (off && fault.sensor == simulation::FaultySensor::imu)
    given.fail("sensor",
               "a jump or spike is of the gyro or of the accelerometer, which have "
               "different units");
  const bool whole = fault.size == std::floor(fault.size) && fault.size >= 1.0 &&
                     fault.size <= simulation::kMaxDelayTicks;
  if (late && given.has("size") && !whole)
    given.fail("size", "must be a whole number of ticks from 1 to " +
                           std::to_string(simulation::kMaxDelayTicks));
  if (has_size && !given.has("size")) given.fail("size", "this key is missing");
}

void check_fault(const simulation::SensorFault& fault, bool has_foot_sensors, const Given& given) {
  for (const char* key : {"sensor", "kind", "time"}) {
    if (!given.has(key)) given.fail(key, "this key is missing");
  }
  const bool is_of_feet = fault.sensor == simulation::FaultySensor::foot_force;
  if (is_of_feet && !has_foot_sensors)
    given.fail("sensor", "the robot has none; sensors.foot_force.present: true gives it one");
  if (fault.kind == simulation::FaultKind::spike && given.has("duration"))
    given.fail("duration", "a spike is one sample and has none; a jump has");
  const bool is_of_joints = fault.sensor == simulation::FaultySensor::encoders ||
                            fault.sensor == simulation::FaultySensor::joint_torques;
  if (fault.joint >= 0 && !is_of_joints)
    given.fail("joint", "only encoders and joint_torques have joints");
  if (fault.leg >= 0 && !is_of_feet) given.fail("leg", "only foot_force has legs");
  check_size(fault, given);
}

/// Legs that are not given keep the joints of the stance.
Group initial_joints(simulation::InitialState& o) {
  o.q.setConstant(kNaN);
  Group joints;
  const int num_legs = static_cast<int>(o.q.size()) / kJointsPerLeg;
  for (const Leg leg : first_legs(num_legs)) {
    joints.fields.emplace_back(
        std::string(leg_name(leg, num_legs)),
        Numbers{&o.q[first_joint(leg)], {kJointNames.begin(), kJointNames.end()}}, kAnyNumber,
        "rad", "without them those of the stance");
  }
  return joints;
}

Group initial_fields(simulation::InitialState& o) {
  return Group{{"x", &o.position.x(), kAnyNumber, "m", "of the base"},
               {"y", &o.position.y(), kAnyNumber, "m", "of the base"},
               {"z", &o.position.z(), kAnyNumber, "m", "without it the feet are on the ground",
                Sizing::base_height},
               {"yaw", &o.yaw, kAnyNumber, "rad", "of the base"},
               {"joints", initial_joints(o), "a posture of its own"},
               {"limp", &o.limp, "nothing holds the joints while it settles"},
               {"settle", &o.settle, kSettle, "s", "springs hold the joints before the run"}}
      .with([&o](const Given& given) {
        o.is_given = given.has("joints") && !o.q.array().isNaN().all();
        if (o.limp && o.settle == 0.0)
          given.fail("limp", "needs time to sink down: a settle above 0 s");
      });
}

Group plant_fields(simulation::PlantOptions& o) {
  o.actuators.model = simulation::ActuatorModel::sea;  // default of scenarios
  const Entries faults{{shape_of<simulation::SensorFault>(
      "",
      [&o](const auto& fault, const Given& given) {
        check_fault(fault, o.sensors.foot_force.present, given);
        o.sensors.faults.push_back(fault);
      },
      simulation::SensorFault{.num_legs =
                                  static_cast<int>(o.disturbances.thigh_length_offset.size())})}};
  const Entries pushes{{shape_of<PushInFile>("", [&o](const auto& push, const Given& given) {
    o.disturbances.pushes.push_back(push_of(push, given));
  })}};
  const Entries lifts{{shape_of<simulation::Lift>(
      "", [&o](const auto& lift, const Given&) { o.disturbances.lifts.push_back(lift); })}};
  return {
      {"timestep", &o.timestep, kTimestep, "s", "of the physics", Sizing::none},
      {"terrain", terrain_fields(o.terrain), "the ground"},
      {"foot_contact", fields(o.contact).with([&o](const Given& given) {
         if (o.contact.solref_time < 2.0 * o.timestep)
           given.fail("solref_time", "must be at least two timesteps");
       }),
       "MuJoCo's solref, solimp and impratio of the feet"},
      {"actuators", fields(o.actuators), "drives"},
      {"sensors",
       simulation::sensor_fields(o.sensors).and_also({{"faults", faults, "sensors that fail"}}),
       "what the controller gets"},
      {"disturbances",
       Group{{"pushes", pushes, "forces on a link"}, {"lifts", lifts, "a hand that lifts the base"}}
           .and_also(simulation::disturbance_fields(o.disturbances)),
       "that the controller does not know of"},
      {"initial", initial_fields(o.initial), "where the robot begins"}};
}

/// The control period is a multiple of the timestep.
void check_period(Scenario& scenario, const Given& given) {
  scenario.plant.control_period = scenario.controller.period;
  try {
    (void)simulation::steps_per_period(scenario.plant);
  } catch (const Error&) {
    given.fail("period", formatted("%g s is not a whole multiple of the timestep, %g s",
                                   scenario.controller.period, scenario.plant.timestep));
  }
}

void check_scenario(Scenario& scenario, const Given& given) {
  check_period(scenario, given);
  if (scenario.controller.contact_force.use_foot_sensor &&
      !scenario.plant.sensors.foot_force.present) {
    given.fail("contact_force.use_foot_sensor",
               "the robot has none; sensors.foot_force.present: true gives it one");
  }
}

/// Names of files, and sections that are read with the robot or the stack.
Group named_fields(Scenario& scenario) {
  std::vector<control::LevelSwitch>& switches = scenario.controller.level_switches;
  const Entries changes{
      {shape_of<control::LevelSwitch>(
          "", [&switches](const auto& change, const Given&) { switches.push_back(change); })},
      "must be a list of switches, each with its time"};
  return {{"base", Other{"text"}, "scenario that this one is laid over"},
          {kScaled, Other{"flag"}, "numbers are for ANYmal B; another robot gets its own by size"},
          {"robot", Other{"text"}, "name or file"},
          {"stack", Other{"text"}, "name or file"},
          {"gait", Other{"text"},
           "name or file, laid under planner; none: the crawl; auto: by the speed"},
          {"gaits", Other{"gaits"}, "names of those that the user may change to"},
          {"tasks", Other{"tasks"}, "changes to the stack's tasks"},
          {"stack_switches", changes, "levels that come and go"},
          {"randomise", Other{"randomise"}, "ranges that the seed draws from"},
          {"criteria", Other{"criteria"}, "limits on metrics"},
          {"paper", Other{"paper"}, "figures to print beside metrics"}};
}

void check_random_commands(const RandomCommands& random, const Given& given) {
  if ((random.velocity_min.array() <= random.velocity_max.array()).all()) return;
  given.fail("velocity_min", "must not be above velocity_max");
}

Group run_fields(Scenario& scenario) {
  RandomCommands& random = scenario.random_commands;
  std::vector<TimedCommand>& commands = scenario.commands;
  const Entries user{{shape_of<TimedCommand>("",
                                             [&commands](const auto& command, const Given& given) {
                                               if (command.time < commands.back().time)
                                                 given.fail("time",
                                                            "must not be before the command above");
                                               commands.push_back(command);
                                             })},
                     "must be a list of commands, each with its time"};
  return {
      {"name", &scenario.name, "for lists and tables"},
      {"description", &scenario.description, "for lists and tables"},
      {"duration", &scenario.duration, kDuration, "s", "longest run", Sizing::walk},
      {"judged_after", &scenario.judged_after, NumberRange{.min = 0.0, .none = kNaN}, "s",
       "criteria need so much of a run that nothing ends; the file's duration by default",
       Sizing::walk},
      {"estimation", choice(scenario.estimation, names_of(estimation::kEstimations)),
       "truth: the simulator's state"},
      {"estimator", fields(scenario.estimator), "of estimation: sensors"},
      {"user", user, "commands from a time on, each complete"},
      {"random_commands",
       Group{{"from", &random.from, NumberRange{.min = 0.0, .none = kNaN}, "s",
              "from which on they take the place of user's", Sizing::walk},
             {"period", &random.period, kPositive, "s", "from command to command"},
             {"velocity_min", Numbers{random.velocity_min.data(), {"x", "y"}}, kAnyNumber, "m/s",
              "smallest, forward and to the left", Sizing::stride},
             {"velocity_max", Numbers{random.velocity_max.data(), {"x", "y"}}, kAnyNumber, "m/s",
              "largest", Sizing::stride},
             {"yaw_rate", &random.yaw_rate, kNotNegative, "rad/s", "largest, to either side"},
             {"gaits", &random.gaits, "in any of the scenario's gaits"}}
           .with([&random](const Given& given) { check_random_commands(random, given); }),
       "drawn from the seed, one after the other"},
      {"goal",
       Group{{"feet_beyond_x", &scenario.goal.feet_beyond_x, kAnyNumber, "m", "of all feet, in S"},
             {"walk_on", &scenario.goal.walk_on, kNotNegative, "m", "by the base, after that"}},
       "when the run ends early"},
      {"success_rate", &scenario.success_rate, kShare, "", "of the runs that must succeed"}};
}

const Field* find(const std::vector<Field>& fields, const std::string& key) {
  const auto found = std::ranges::find(fields, key, &Field::key);
  return found == fields.end() ? nullptr : &*found;
}

bool visit_option(const Group& group, const std::string& path,
                  const std::function<void(const Field&)>& use) {
  const std::size_t dot = std::min(path.find('.'), path.size());
  const Field* field = find(group.fields, path.substr(0, dot));
  if (field == nullptr) return false;
  if (dot == path.size()) {
    use(*field);
    return true;
  }
  const std::string rest = path.substr(dot + 1);
  if (const auto* below = std::get_if<Group>(&field->value)) return visit_option(*below, rest, use);
  const auto* entries = std::get_if<Entries>(&field->value);
  const std::size_t name_end = rest.find('.');
  if (entries == nullptr || name_end == std::string::npos) return false;
  return std::ranges::any_of(entries->shapes, [&](const Entries::Shape& shape) {
    return visit_option(shape.add(), rest.substr(name_end + 1), use);
  });
}

}  // namespace

Group fields(ReachCommand& o) {
  return {{"arm", &o.arm, NumberRange{.min = 0.0, .words = "a number of at least 0", .none = -1.0},
           "", "which, by its place in the robot's list of arms, from 0"},
          {"in_world", &o.in_world, "in W; else in B, so that it moves with the torso"},
          Field{"position", Numbers{o.position.data(), simulation::axis_elements()}, kAnyNumber,
                "m", "of the tip or frame"}
              .required(),
          {"orientation", Numbers{o.orientation.data(), simulation::angle_elements()},
           NumberRange{.none = kNaN}, "rad", "of the tip or frame; without it as it was at first"}};
}

Group fields(TimedCommand& o) {
  return {
      Field{"time", &o.time, kNotNegative, "s", "from which on it holds"}.required(),
      {"walk", &o.user.walk, "or else stand"},
      {"velocity", Numbers{o.user.velocity.data(), {"x", "y"}}, kAnyNumber, "m/s",
       "forward and to the left", Sizing::stride},
      {"yaw_rate", &o.user.yaw_rate, kAnyNumber, "rad/s", "to the left"},
      {"height", &o.user.height, kHeight, "m", "over the stance's height"},
      {"calibrate", &o.user.calibrate, "stand, begin the estimate anew, calibrate, go on"},
      {"gait", &o.gait, "name or file; auto: by the speed; without it the scenario's"},
      {"reach",
       fields(o.user.reach)
           .and_also(Group{{"frame", &o.frame, "instead of an arm: one that the stack follows"}}),
       "the tip of an arm follows this, or a frame"},
      {"shift", Numbers{o.user.shift.data(), {"x", "y"}}, kAnyNumber, "m",
       "of the centre of mass of flat feet, forward and to the left"}};
}

Group scenario_fields(Scenario& scenario, int num_legs) {
  gaits::set_num_legs(scenario.controller.planner, num_legs);
  simulation::set_num_legs(scenario.plant, num_legs);
  return run_fields(scenario)
      .and_also(named_fields(scenario))
      .and_also(fields(scenario.controller))
      .and_also(plant_fields(scenario.plant))
      .with([&scenario](const Given& given) { check_scenario(scenario, given); });
}

bool visit_scenario_option(const std::string& path, const std::function<void(const Field&)>& use,
                           int num_legs) {
  static Scenario quadruped, hexapod;
  static const Group kOfQuadruped = scenario_fields(quadruped, kNumLegs);
  static const Group kOfHexapod = scenario_fields(hexapod, kMaxLegs);
  return visit_option(num_legs == kNumLegs ? kOfQuadruped : kOfHexapod, path, use);
}

}  // namespace surefoot::config
