#include "surefoot/simulation/check_options.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/fields.hpp"
#include "surefoot/simulation/text.hpp"

#include <cmath>

namespace surefoot::simulation {

namespace {

// Larger grids take minutes to compile and gigabytes of memory.
constexpr int kMaxGridPoints = 4'000'000;
constexpr double kMaxRandomBoxes = 20'000.0;

void require(bool valid, const std::string& name, double given, const std::string& expected) {
  if (!valid) throw Error(text(name, " is ", given, "; it must be ", expected));
}

void require_finite(const std::string& name, double value) {
  require(std::isfinite(value), name, value, "a finite number");
}

template <typename Vector>
void require_all_finite(const std::string& name, const Vector& value) {
  for (Eigen::Index i = 0; i < value.size(); ++i) require_finite(text(name, "[", i, "]"), value[i]);
}

void require_positive(const std::string& name, double value) {
  require(std::isfinite(value) && value > 0.0, name, value, "a finite number above 0");
}

void require_not_negative(const std::string& name, double value) {
  require(std::isfinite(value) && value >= 0.0, name, value, "0 or a finite number above");
}

/// What ranges of single options do not say.
void check_size(const std::string& name, const TerrainHeightField& field) {
  const bool automatic = field.heights.empty() && field.columns == 0 && field.rows == 0;
  if (automatic) return;
  require(field.columns >= 2, name + ".columns", field.columns, "at least 2");
  require(field.rows >= 2, name + ".rows", field.rows, "at least 2");
  require(field.columns <= kMaxGridPoints / field.rows, name + ".columns", field.columns,
          text("at most ", kMaxGridPoints, " points with rows"));
  const std::size_t points =
      static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows);
  if (!field.heights.empty() && field.heights.size() != points) {
    throw Error(text(name, ".heights has ", field.heights.size(), " numbers; rows × columns is ",
                     field.rows, " × ", field.columns, " = ", points));
  }
}

void check_size(const std::string& name, const TerrainRandomBoxes& boxes) {
  const double count = (boxes.size_x / boxes.cell) * (boxes.size_y / boxes.cell);
  require(count <= kMaxRandomBoxes, name + ".cell", boxes.cell,
          text("large enough for at most ", kMaxRandomBoxes, " boxes"));
}
template <typename Element>
void check_size(const std::string& /*name*/, const Element& /*element*/) {}

void check(TerrainOptions& terrain) {
  require_not_negative("terrain.friction", terrain.friction);
  for (std::size_t i = 0; i < terrain.elements.size(); ++i) {
    const std::string name = text("terrain.elements[", i, "]");
    std::visit(
        [&name](auto& element) {
          check_fields(name, fields(element));
          check_size(name, element);
        },
        terrain.elements[i]);
  }
}

void check(ContactOptions& contact, double timestep) {
  require(contact.solimp_max >= contact.solimp_min, "contact.solimp_max", contact.solimp_max,
          "between solimp_min and 1");
  check_fields("contact", fields(contact));
  require(contact.solref_time >= 2.0 * timestep, "contact.solref_time", contact.solref_time,
          text("at least two timesteps, ", 2.0 * timestep, " s"));
}

void check(const std::string& name, const SensorFault& fault) {
  require(fault.joint >= -1 && fault.joint < kMaxJoints, name + ".joint", fault.joint,
          text("between 0 and ", kMaxJoints - 1, ", or -1 for all"));
  require(fault.leg >= -1 && fault.leg < fault.num_legs, name + ".leg", fault.leg,
          text("between 0 and ", fault.num_legs - 1, ", or -1 for all"));
  const bool is_of_joints =
      fault.sensor == FaultySensor::encoders || fault.sensor == FaultySensor::joint_torques;
  require(is_of_joints || fault.joint == -1, name + ".joint", fault.joint,
          "-1, as only encoders and joint torques have joints");
  const bool is_of_feet = fault.sensor == FaultySensor::foot_force;
  require(is_of_feet || fault.leg == -1, name + ".leg", fault.leg,
          "-1, as only foot sensors have legs");
  if (fault.kind != FaultKind::late) return;
  require(fault.size >= 1.0 && fault.size <= kMaxDelayTicks && fault.size == std::floor(fault.size),
          name + ".size", fault.size,
          text("a whole number of ticks between 1 and ", kMaxDelayTicks));
}

void check(SensorOptions& sensors) {
  check_fields("sensors", sensor_fields(sensors));
  for (std::size_t i = 0; i < sensors.faults.size(); ++i) {
    const std::string name = text("sensors.faults[", i, "]");
    check_fields(name, fields(sensors.faults[i]));
    check(name, sensors.faults[i]);
    if (sensors.faults[i].sensor == FaultySensor::foot_force && !sensors.foot_force.present)
      throw Error(text(name, ".sensor is foot_force; the robot has none"));
  }
}

void check(DisturbanceOptions& disturbances) {
  for (std::size_t i = 0; i < disturbances.pushes.size(); ++i)
    check_fields(text("disturbances.pushes[", i, "]"), fields(disturbances.pushes[i]));
  for (std::size_t i = 0; i < disturbances.lifts.size(); ++i)
    check_fields(text("disturbances.lifts[", i, "]"), fields(disturbances.lifts[i]));
  check_fields("disturbances", disturbance_fields(disturbances));
}

void check(const InitialState& initial) {
  require_finite("initial.position[0]", initial.position.x());
  require_finite("initial.position[1]", initial.position.y());
  require(!std::isinf(initial.position.z()), "initial.position[2]", initial.position.z(),
          "finite, or NaN for feet on the terrain");
  require_finite("initial.yaw", initial.yaw);
  require_all_finite("initial.q", initial.q);
}

}  // namespace

int steps_per_period(const PlantOptions& options) {
  const double steps = std::round(options.control_period / options.timestep);
  const bool whole =
      steps >= 1.0 && steps <= 1e6 &&
      std::abs(steps * options.timestep - options.control_period) <= 1e-6 * options.timestep;
  require(whole, "control_period", options.control_period,
          text("a whole multiple of the timestep, ", options.timestep, " s"));
  return static_cast<int>(steps);
}

void check_options(const PlantOptions& given) {
  PlantOptions options = given;
  require_positive("timestep", options.timestep);
  require_positive("control_period", options.control_period);
  static_cast<void>(steps_per_period(options));
  check(options.terrain);
  check(options.contact, options.timestep);
  check_fields("actuators", fields(options.actuators));
  check(options.sensors);
  check(options.disturbances);
  check(options.initial);
}

}  // namespace surefoot::simulation
