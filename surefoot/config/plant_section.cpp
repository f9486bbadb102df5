#include "surefoot/config/plant_section.hpp"

#include "surefoot/config/plant_vectors.hpp"
#include "surefoot/config/sensor_section.hpp"
#include "surefoot/config/terrain_section.hpp"

#include <cmath>

namespace surefoot {
namespace {

void read_foot_contact(Section& section, double timestep, ContactOptions& contact) {
  constexpr NumberRange kImpedance{.min = 1e-4, .max = 0.9999, .words = "a number between 0 and 1"};
  section.number("solref_time", contact.solref_time, kPositive);
  section.number("solref_damping", contact.solref_damping, kPositive);
  section.number("solimp_min", contact.solimp_min, kImpedance);
  section.number("solimp_max", contact.solimp_max, kImpedance);
  section.number("solimp_width", contact.solimp_width, kPositive);
  section.number("impratio", contact.impratio, kPositive);
  if (contact.solref_time < 2.0 * timestep)
    section.fail("solref_time", "must be at least two timesteps");
  section.require_order("solimp_min", contact.solimp_min, "solimp_max", contact.solimp_max);
}

void read_rotor(Section& section, RotorOptions& rotor) {
  section.number("inertia", rotor.inertia, kPositive);
  section.number("gear_ratio", rotor.gear_ratio, kPositive);
  section.number("viscous", rotor.viscous, kNotNegative);
  section.number("coulomb", rotor.coulomb, kNotNegative);
  section.number("coulomb_speed", rotor.coulomb_speed, kPositive);
}

void read_actuators(Section& section, ActuatorOptions& actuators) {
  section.choice<ActuatorModel>("model", actuators.model,
                                {{"ideal", ActuatorModel::ideal}, {"sea", ActuatorModel::sea}});
  section.integer("level", actuators.level, 1, 2);
  section.integer("delay_ticks", actuators.delay_ticks, 0, kMaxDelayTicks);
  section.number("bandwidth_hz", actuators.bandwidth_hz, kPositive);
  section.number("stall_torque", actuators.stall_torque, kPositive);
  section.number("no_load_speed", actuators.no_load_speed, kPositive);
  section.number("quantisation", actuators.quantisation, kNotNegative);
  section.number("torque_gain", actuators.torque_gain, kPositive);
  section.elements("joint_torque_gain", actuators.joint_torque_gain.data(), joint_elements(),
                   kPositive);
  section.section("spring", [&](Section& spring) {
    spring.number(
        "stiffness", actuators.spring.stiffness,
        {.min = 0.0, .max = 1e5, .min_included = false, .words = "above 0, at most 1e5 N·m/rad"});
  });
  section.section("rotor", [&](Section& rotor) { read_rotor(rotor, actuators.rotor); });
  section.section("torque_loop", [&](Section& loop) {
    loop.number("damping", actuators.torque_loop.damping, kPositive);
    loop.number("integral_time", actuators.torque_loop.integral_time, kPositive);
  });
}

/// The force of a push along the ground, from its magnitude and direction.
Vec3 read_level_force(Section& section) {
  double magnitude = 0.0, direction = 0.0;
  section.require("direction");
  section.number("magnitude", magnitude, kNotNegative);
  section.number("direction", direction);
  return magnitude * Vec3(std::cos(direction), std::sin(direction), 0.0);
}

/// A push has a force, an impulse that is spread over its duration, or a magnitude and a direction.
void read_push(Section& section, Push& push) {
  section.require("time");
  section.text("body", push.body);
  section.number("time", push.time, kNotNegative);
  section.number("duration", push.duration, kPositive);
  Vec3 impulse = Vec3::Zero();
  section.vector("force", push.force);
  section.vector("impulse", impulse);
  const auto has = [&](const char* key) { return section.node(key) != nullptr ? 1 : 0; };
  if (has("force") + has("impulse") + has("magnitude") != 1)
    section.fail("force", "a push has either a force, an impulse or a magnitude");
  if (has("direction") > has("magnitude"))
    section.fail("direction", "only a push with a magnitude has a direction");
  if (has("impulse") == 1) push.force = impulse / push.duration;
  if (has("magnitude") == 1) push.force = read_level_force(section);
}

/// Pushes have names, so that another file or --set can change one.
void read_pushes(Section& section, std::vector<Push>& pushes) {
  for (const std::string& name : section.keys()) {
    if (section.node(name.c_str())->kind == ConfigNode::Kind::null) continue;
    section.section(name.c_str(), [&](Section& s) { read_push(s, pushes.emplace_back()); });
  }
}

void read_lift(Section& section, Lift& lift) {
  section.require("time");
  section.number("time", lift.time, kNotNegative);
  section.number("height", lift.height,
                 {.min = 0.0, .max = 2.0, .min_included = false, .words = "above 0, at most 2 m"});
  section.number("duration", lift.duration, kPositive);
  section.number("hold", lift.hold, kNotNegative);
  section.vector("point", lift.point);
}

/// Named, as pushes are.
void read_lifts(Section& section, std::vector<Lift>& lifts) {
  for (const std::string& name : section.keys()) {
    if (section.node(name.c_str())->kind == ConfigNode::Kind::null) continue;
    section.section(name.c_str(), [&](Section& s) { read_lift(s, lifts.emplace_back()); });
  }
}

/// Also if it is empty; nothing behind the name takes away what a base has.
bool is_map(Section& section, const char* key) {
  const ConfigNode* given = section.node(key);
  return given != nullptr && given->kind == ConfigNode::Kind::map;
}

void read_disturbances(Section& section, DisturbanceOptions& disturbances) {
  section.section("pushes", [&](Section& s) { read_pushes(s, disturbances.pushes); });
  section.section("lifts", [&](Section& s) { read_lifts(s, disturbances.lifts); });
  section.section("payload", [&](Section& payload) {
    if (is_map(section, "payload")) payload.require("mass");
    constexpr NumberRange kMass{
        .min = 0.0, .max = kMaxPayload, .words = "a number from 0 to 200 kg"};
    payload.number("mass", disturbances.payload.mass, kMass);
    payload.vector("position", disturbances.payload.position);
  });
  constexpr NumberRange kScale{
      .min = 1.0 / kMaxMassScale, .max = kMaxMassScale, .words = "a number from 0.1 to 10"};
  section.number("base_mass_scale", disturbances.base_mass_scale, kScale);
  section.number("leg_mass_scale", disturbances.leg_mass_scale, kScale);
  section.elements("link_mass_scale", disturbances.link_mass_scale.data(), link_elements(), kScale);
  section.vector("base_com_offset", disturbances.base_com_offset);
  constexpr NumberRange kLength{.min = -kMaxLengthOffset,
                                .max = kMaxLengthOffset,
                                .words = "a number between -0.1 and 0.1 m"};
  section.elements("thigh_length_offset", disturbances.thigh_length_offset.data(), leg_elements(),
                   kLength);
  section.elements("shank_length_offset", disturbances.shank_length_offset.data(), leg_elements(),
                   kLength);
}

}  // namespace

void read_plant(Section& scenario, PlantOptions& options) {
  scenario.number("timestep", options.timestep,
                  {.min = 1e-5, .words = "a number of at least 1e-5 s"});
  scenario.section("terrain", [&](Section& s) { read_terrain(s, options.terrain); });
  scenario.section("foot_contact",
                   [&](Section& s) { read_foot_contact(s, options.timestep, options.contact); });
  options.actuators.model = ActuatorModel::sea;  // of a scenario that names none
  const ConfigNode* actuators = scenario.node("actuators");
  if (actuators != nullptr && actuators->kind == ConfigNode::Kind::scalar) {
    scenario.fail("actuators", "\"" + actuators->text +
                                   "\" is not a map of keys and values; which model is "
                                   "\"actuators.model\": sea or ideal");
  }
  scenario.section("actuators", [&](Section& s) { read_actuators(s, options.actuators); });
  scenario.section("sensors", [&](Section& s) { read_sensors(s, options.sensors); });
  scenario.section("disturbances", [&](Section& s) { read_disturbances(s, options.disturbances); });
}

}  // namespace surefoot
