#include "tests/config/trial_scenario.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

class PlantOfScenario : public test::TrialScenario {};

TEST_F(PlantOfScenario, draws_every_mismatch_of_the_plant_and_nothing_of_the_controller) {
  const auto load = [](std::uint64_t seed) {
    return load_scenario({"walk_flat_sea", seed, {"randomise.include=mismatch"}});
  };
  const Scenario nominal = load(0), first = load(1), second = load(2);
  EXPECT_TRUE(nominal.drawn.empty());
  EXPECT_EQ(nominal.plant.sensors.encoders.offset, JointVector::Zero(kNumLegJoints));
  EXPECT_EQ(nominal.plant.disturbances.link_mass_scale, JointVector::Ones(kNumLegJoints));
  EXPECT_NE(first.plant.sensors.encoders.offset, second.plant.sensors.encoders.offset);
  EXPECT_NE(first.plant.disturbances.link_mass_scale, second.plant.disturbances.link_mass_scale);
  EXPECT_NE(first.plant.disturbances.thigh_length_offset, PerLeg<double>{});
  EXPECT_NE(first.plant.disturbances.shank_length_offset, PerLeg<double>{});
  EXPECT_NE(first.plant.disturbances.base_com_offset, second.plant.disturbances.base_com_offset);
  EXPECT_NE(first.plant.actuators.joint_torque_gain, JointVector::Ones(kNumLegJoints));
  EXPECT_NE(first.plant.sensors.imu.tilt, Vec3::Zero());
  EXPECT_GT(first.plant.disturbances.payload.mass, 0.0);
  EXPECT_EQ(std::ranges::count(first.sources, "randomise1.yaml", &SourceFile::name), 1);
  EXPECT_EQ(first.controller.planner.force.friction, nominal.controller.planner.force.friction);
}

TEST_F(PlantOfScenario, names_the_file_of_an_included_range_whose_path_is_unknown) {
  test::write_file(folder_ / "worn.yaml", "terrain.friction: [0, 1]\nterrain.fricton: [0, 1]\n");
  EXPECT_TRUE(holds(complaint("randomise: {include: worn.yaml}\n"), "worn.yaml:2: randomise"));
}

TEST_F(PlantOfScenario, takes_the_numbers_of_a_vector_by_name) {
  const Scenario scenario =
      read("sensors: {encoders: {offset: {LF_KFE: 0.005}}}\n", 0,
           {"sensors.encoders.offset.RH_HAA=-0.002", "disturbances.base_com_offset.x=0.01",
            "disturbances.thigh_length_offset=[0.01, 0, 0, -0.01]"});
  EXPECT_EQ(scenario.plant.sensors.encoders.offset[2], 0.005);
  EXPECT_EQ(scenario.plant.sensors.encoders.offset[9], -0.002);
  EXPECT_EQ(scenario.plant.disturbances.base_com_offset, Vec3(0.01, 0.0, 0.0));
  EXPECT_EQ(scenario.plant.disturbances.thigh_length_offset[3], -0.01);
  EXPECT_TRUE(holds(complaint("sensors: {encoders: {offset: {LF_KFF: 1}}}\n"),
                    "trial.yaml:2: sensors.encoders.offset.LF_KFF: unknown key; did you mean"));
  EXPECT_TRUE(holds(complaint("sensors: {encoders: {offset: [1, 2]}}\n"),
                    "a list of 2 is not a list of 12 numbers, nor a map from LF_HAA … RH_KFE"));
  EXPECT_TRUE(holds(complaint("disturbances: {shank_length_offset: {LF: 0.3}}\n"),
                    "shank_length_offset.LF: \"0.3\" is not a number between -0.1 and 0.1 m"));
  EXPECT_TRUE(holds(complaint("disturbances: {link_mass_scale: {LF_HIP: 0}}\n"),
                    "\"0\" is not a number from 0.1 to 10"));
}

TEST_F(PlantOfScenario, has_actuators_of_two_levels) {
  EXPECT_EQ(read("").plant.actuators.model, simulation::ActuatorModel::sea)
      << "ideal ones must be asked for";
  EXPECT_EQ(read("").plant.actuators.level, 1);
  const simulation::ActuatorOptions actuators =
      read(
          "actuators: {model: sea, level: 2, spring: {stiffness: 150}, rotor: {inertia: 3e-5, "
          "coulomb: 0.5}, torque_loop: {damping: 1}}\n")
          .plant.actuators;
  EXPECT_EQ(actuators.level, 2);
  EXPECT_EQ(actuators.spring.stiffness, 150.0);
  EXPECT_EQ(actuators.rotor.inertia, 3e-5);
  EXPECT_EQ(actuators.rotor.coulomb, 0.5);
  EXPECT_EQ(actuators.torque_loop.damping, 1.0);
  EXPECT_TRUE(
      holds(complaint("actuators: ideal\n"), "trial.yaml:2: actuators: \"ideal\" is not a map"));
  EXPECT_TRUE(holds(complaint("actuators: ideal\n"), "\"actuators.model\": sea or ideal"));
  EXPECT_TRUE(holds(complaint("actuators: {level: 3}\n"),
                    "trial.yaml:2: actuators.level: \"3\" is more than 2"));
  EXPECT_TRUE(holds(complaint("actuators: {rotor: {inertia: 0}}\n"), "actuators.rotor.inertia"));
  EXPECT_TRUE(holds(complaint("actuators: {spring: {stifness: 1}}\n"), "mean \"stiffness\"?"));
}

TEST_F(PlantOfScenario, has_sensors_that_fail) {
  const std::vector<simulation::SensorFault> faults =
      read(
          "sensors: {faults: {a: {sensor: imu, kind: stops, time: 3}, b: {sensor: encoders, kind: "
          "late, time: 1, duration: 0.5, size: 4, joint: RF_HFE}, c: }}\n")
          .plant.sensors.faults;
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].kind, simulation::FaultKind::stops);
  EXPECT_EQ(faults[0].time, 3.0);
  EXPECT_TRUE(std::isinf(faults[0].duration));
  EXPECT_EQ(faults[1].sensor, simulation::FaultySensor::encoders);
  EXPECT_EQ(faults[1].size, 4.0);
  EXPECT_EQ(faults[1].joint, 4);
}

TEST_F(PlantOfScenario, with_a_fault_that_makes_no_sense_names_key_and_reason) {
  const auto says = [&](const std::string& fault, const char* what) {
    const std::string text = complaint("sensors: {faults: {a: {" + fault + "}}}\n");
    EXPECT_TRUE(holds(text, "trial.yaml:2: sensors.faults.a")) << text;
    EXPECT_TRUE(holds(text, what)) << text;
  };
  says("kind: stops, time: 1", "sensor: this key is missing");
  says("sensor: gps, kind: stops, time: 1", "unknown choice \"gps\"");
  says("sensor: imu, kind: stop, time: 1", "did you mean \"stops\"?");
  says("sensor: imu, kind: stops, time: -1", "at least 0");
  says("sensor: imu, kind: stops, time: 1, duration: 0", "above 0");
  says("sensor: imu, kind: stops, time: 1, size: 2", "only jump, spike, scaled and late have one");
  says("sensor: gyro, kind: jump, time: 1", "size: this key is missing");
  says("sensor: imu, kind: jump, time: 1, size: 1", "have different units");
  says("sensor: gyro, kind: late, time: 1, size: 2.5", "a whole number of ticks from 1 to 1000");
  says("sensor: gyro, kind: spike, time: 1, size: 2, duration: 1", "a spike is one sample");
  says("sensor: gyro, kind: nan, time: 1, joint: LF_HAA", "only encoders and joint_torques");
  says("sensor: encoders, kind: nan, time: 1, joint: LF_HIP", "unknown joint \"LF_HIP\"");
  says("sensor: imu, kind: nan, time: 1, leg: LF", "leg: only foot_force has legs");
  says("sensor: foot_force, kind: nan, time: 1", "sensors.foot_force.present: true gives it one");
}

TEST_F(PlantOfScenario, has_foot_sensors_that_fail) {
  const auto options = [](const std::string& leg) {
    return "sensors:\n  foot_force: {present: true, delay_ticks: 2}\n  faults:\n    a: {sensor: "
           "foot_force, kind: jump, time: 3, size: 80, leg: " +
           leg + "}\n";
  };
  const simulation::SensorOptions sensors = read(options("LH")).plant.sensors;
  EXPECT_EQ(sensors.foot_force.delay_ticks, 2);
  ASSERT_EQ(sensors.faults.size(), 1u);
  EXPECT_EQ(sensors.faults[0].sensor, simulation::FaultySensor::foot_force);
  EXPECT_EQ(sensors.faults[0].leg, 2);
  EXPECT_TRUE(holds(complaint(options("HL")), "sensors.faults.a.leg: unknown leg \"HL\""));
}

TEST_F(PlantOfScenario, whose_period_is_not_made_of_timesteps_names_the_key) {
  EXPECT_TRUE(holds(complaint("period: 0.0023\n"),
                    "trial.yaml:2: period: 0.0023 s is not a whole multiple of the timestep"));
}

TEST_F(PlantOfScenario, with_a_push_on_an_unknown_link_names_the_push_and_the_nearest) {
  const std::string message =
      complaint("disturbances:\n  pushes:\n    kick: {time: 1, force: [0, 9, 0], body: LF_TIGH}\n");
  EXPECT_TRUE(holds(message, "trial.yaml:4: disturbances.pushes.kick.body"));
  EXPECT_TRUE(holds(message, "did you mean \"LF_THIGH\"?"));
}

TEST_F(PlantOfScenario, says_what_a_shape_or_payload_needs) {
  const auto element = [&](const std::string& text) {
    return complaint("terrain: {elements: {a: {" + text + "}}}\n");
  };
  EXPECT_TRUE(holds(element("height: -0.2"), "a.shape: this key is missing, and \"a\" is a new"));
  EXPECT_TRUE(
      holds(complaint("terrain: {elements: {ground: {shape: plane}, grond: {height: 1}}}\n"),
            "terrain.elements.grond.shape: this key is missing, and \"grond\" is a new "
            "element; did you mean \"ground\"?"));
  EXPECT_TRUE(holds(element("shape: box"), "trial.yaml:2: terrain.elements.a.size: this key is"));
  EXPECT_TRUE(holds(element("shape: height_field"), "either heights, with columns and rows, or"));
  EXPECT_TRUE(holds(element("shape: height_field, amplitude: 0.02"), "terrain.elements.a.size_x"));
  EXPECT_TRUE(holds(element("shape: height_field, size_x: 1, size_y: 1, columns: 2, rows: 2, "
                            "heights: [0, 0, 0]"),
                    "3 numbers are not columns × rows = 4"));
  EXPECT_TRUE(holds(element("shape: random_boxes, size_x: 1, size_y: 1"), "a.max_height"));
  EXPECT_TRUE(holds(element("shape: steps"), "a.height: this key is missing"));
  EXPECT_TRUE(holds(element("shape: slope"), "a pitch, a roll or both"));
  EXPECT_TRUE(holds(element("shape: slope, pitch: 0.1, incline: 0.1"), "or instead of them"));
  EXPECT_TRUE(holds(complaint("disturbances: {payload: {}}\n"),
                    "trial.yaml:2: disturbances.payload.mass: this key is missing"));
  EXPECT_EQ(read("disturbances: {payload: }\n").plant.disturbances.payload.mass, 0.0);
}

TEST_F(PlantOfScenario, whose_foot_contact_is_too_stiff_for_the_timestep_names_the_key) {
  EXPECT_TRUE(holds(complaint("foot_contact: {solref_time: 0.0001}\n"),
                    "trial.yaml:2: foot_contact.solref_time: must be at least two timesteps"));
}

TEST_F(PlantOfScenario, begins_in_the_stance_or_with_joints_of_its_own) {
  const simulation::InitialState stance = read("").plant.initial;
  EXPECT_FALSE(stance.is_given);
  const simulation::InitialState given =
      read("initial: {joints: {LF: [0.1, 1.4, -2.8], RH: {KFE: 2.5}}}\n").plant.initial;
  EXPECT_TRUE(given.is_given);
  EXPECT_EQ(given.q.head<3>(), Vec3(0.1, 1.4, -2.8));
  EXPECT_EQ((given.q - stance.q).segment<8>(3).norm(), 0.0);
  EXPECT_EQ(given.q[11], 2.5);
  EXPECT_TRUE(holds(complaint("initial: {joints: {LF: [0, 3, -2.8]}}\n"),
                    "initial.joints.LF: HFE is 3 rad; valid is -2.6 to 2.6 rad"));
  EXPECT_TRUE(holds(complaint("initial: {joints: {FL: [0, 1, -2]}}\n"), "initial.joints.FL"));
  EXPECT_TRUE(holds(complaint("initial: {joints: {LF: [0, 1]}}\n"), "HAA … KFE"));
}

TEST_F(PlantOfScenario, is_lifted_by_hands) {
  const simulation::DisturbanceOptions disturbances =
      read("disturbances: {lifts: {up: {time: 3, height: 0.2, hold: 2}, off: ~}}\n")
          .plant.disturbances;
  ASSERT_EQ(disturbances.lifts.size(), 1U);
  EXPECT_EQ(disturbances.lifts[0].time, 3.0);
  EXPECT_EQ(disturbances.lifts[0].height, 0.2);
  EXPECT_EQ(disturbances.lifts[0].hold, 2.0);
  EXPECT_TRUE(holds(complaint("disturbances: {lifts: {up: {height: 0.2}}}\n"), "time"));
  EXPECT_TRUE(holds(complaint("disturbances: {lifts: {up: {time: 1, height: 3}}}\n"),
                    "disturbances.lifts.up.height"));
}

TEST_F(PlantOfScenario, reads_a_push_as_force_or_as_impulse) {
  const Scenario scenario = read(
      "disturbances: {pushes: {a: {time: 1, force: [0, 9, 0]}, b: {time: 2, duration: 0.5, "
      "impulse: [0, 0, 3]}}}\n");
  ASSERT_EQ(scenario.plant.disturbances.pushes.size(), 2u);
  EXPECT_EQ(scenario.plant.disturbances.pushes[0].force, Vec3(0, 9, 0));
  EXPECT_EQ(scenario.plant.disturbances.pushes[1].force, Vec3(0, 0, 6));
  EXPECT_TRUE(
      holds(complaint("disturbances: {pushes: {a: {time: 1}}}\n"), "either a force, an impulse"));
}

TEST_F(PlantOfScenario, reads_a_push_along_the_ground_by_magnitude_and_direction) {
  const Scenario scenario = read(
      "disturbances: {pushes: {a: {time: 1, magnitude: 50, direction: 2.5}}}\n"
      "randomise: {disturbances.pushes.a.direction: [-3, 3]}\n");
  const Vec3& force = scenario.plant.disturbances.pushes.at(0).force;
  EXPECT_LT((force - 50.0 * Vec3(std::cos(2.5), std::sin(2.5), 0.0)).norm(), 1e-12);
  const auto push = [&](const std::string& text) {
    return complaint("disturbances: {pushes: {a: {time: 1, " + text + "}}}\n");
  };
  EXPECT_TRUE(holds(push("magnitude: 5"), "pushes.a.direction: this key is missing"));
  EXPECT_TRUE(holds(push("magnitude: -5, direction: 0"), "pushes.a.magnitude"));
  EXPECT_TRUE(holds(push("magnitude: 5, direction: 0, force: [1, 0, 0]"), "either a force, an"));
  EXPECT_TRUE(holds(push("force: [1, 0, 0], direction: 0"), "only a push with a magnitude has"));
}

}  // namespace
}  // namespace surefoot::config
