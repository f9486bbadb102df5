#include "surefoot/simulation/series_elastic_drive.hpp"

#include "surefoot/simulation/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace surefoot::simulation {
namespace {

constexpr double kTimestep = 0.0005;

ActuatorOptions drive_options(double quantisation = 0.2) {
  ActuatorOptions options;
  options.model = ActuatorModel::sea;
  options.level = 2;
  options.quantisation = quantisation;
  return options;
}

/// Holds the joint at an angle for a time.
void hold(SeriesElasticDrive& drive, double reference, double q, double duration) {
  for (double time = 0.0; time < duration; time += kTimestep) drive.advance(reference, q);
}

/// Gain of the torque of a held joint at one frequency.
double gain_at(double frequency, double amplitude, const ActuatorOptions& options) {
  SeriesElasticDrive drive(options, kTimestep);
  drive.rest_at(0.0);
  const int ticks = static_cast<int>(std::round(20.0 / frequency / kTimestep));
  std::complex<double> sum = 0.0;
  for (int i = 0; i < ticks; ++i) {
    const double phase = 2.0 * kPi * frequency * kTimestep;
    drive.advance(amplitude * std::sin(phase * i), 0.0);
    if (2 * i >= ticks) sum += drive.torque(0.0) * std::polar(1.0, -phase * (i + 1));
  }
  return std::abs(sum) * 4.0 / ticks / amplitude;
}

/// Time from 10 to 90 % of a step of torque, the joint held [s].
double rise_time(double step) {
  SeriesElasticDrive drive(drive_options(), kTimestep);
  drive.rest_at(0.0);
  int begin = 0, end = 0;
  while (drive.torque(0.0) < 0.9 * step && end < 10'000) {
    drive.advance(step, 0.0);
    ++end;
    if (drive.torque(0.0) < 0.1 * step) begin = end;
  }
  return (end - begin) * kTimestep;
}

TEST(SeriesElasticDrive, starts_without_torque_in_any_posture) {
  for (const double q : {-2.6, 0.0, 1.234}) {
    SeriesElasticDrive drive(drive_options(), kTimestep);
    drive.rest_at(q);
    EXPECT_EQ(drive.torque(q), 0.0);
    hold(drive, 0.0, q, 0.1);
    EXPECT_EQ(drive.torque(q), 0.0);
  }
}

TEST(SeriesElasticDrive, holds_the_reference_within_its_quantum_where_the_joint_is_held) {
  Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const double reference = 39.0 * (2.0 * random.uniform() - 1.0);
    const double q = 2.0 * random.uniform() - 1.0;
    SeriesElasticDrive drive(drive_options(), kTimestep);
    drive.rest_at(q);
    hold(drive, reference, q, 0.5);
    for (int step = 0; step < 400; ++step) {
      drive.advance(reference, q);
      ASSERT_NEAR(drive.torque(q), reference, 0.2) << reference;
    }
  }
}

TEST(SeriesElasticDrive, holds_the_reference_while_the_joint_turns) {
  for (const double speed : {-3.0, -0.5, 0.5, 3.0}) {
    SeriesElasticDrive drive(drive_options(), kTimestep);
    drive.rest_at(0.0);
    double q = 0.0;
    for (int step = 0; step < 1000; ++step) drive.advance(8.0, q += speed * kTimestep);
    EXPECT_NEAR(drive.torque(q), 8.0, 0.25) << speed;
  }
}

TEST(SeriesElasticDrive, has_the_bandwidth_that_was_asked_for_while_its_torque_suffices) {
  for (const double bandwidth : {40.0, 70.0}) {
    ActuatorOptions options = drive_options(0.0);
    options.bandwidth_hz = bandwidth;
    EXPECT_NEAR(gain_at(0.2 * bandwidth, 0.5, options), 1.0, 0.06) << bandwidth;
    EXPECT_NEAR(gain_at(bandwidth, 0.5, options), std::sqrt(0.5), 0.08) << bandwidth;
    EXPECT_LT(gain_at(2.0 * bandwidth, 0.5, options), 0.35) << bandwidth;
  }
}

TEST(SeriesElasticDrive, is_slower_the_larger_the_torque) {
  EXPECT_LT(rise_time(1.0), 0.006);
  EXPECT_GT(rise_time(10.0), 1.5 * rise_time(1.0));
  EXPECT_GT(rise_time(40.0), 2.0 * rise_time(10.0));
  EXPECT_LT(gain_at(70.0, 10.0, drive_options()), 0.2);
}

/// A joint of some inertia with nothing else on it, integrated as MuJoCo does.
struct FreeJoint {
  void step(SeriesElasticDrive& drive, double reference) {
    speed += kTimestep * drive.torque(angle) / inertia;
    angle += kTimestep * speed;
    drive.advance(reference, angle);
  }

  double inertia = 0.05;
  double angle = 0.3;
  double speed = 0.0;
};

TEST(SeriesElasticDrive, runs_away_no_faster_than_the_motor_turns) {
  SeriesElasticDrive drive(drive_options(), kTimestep);
  FreeJoint joint;
  drive.rest_at(joint.angle);
  for (int step = 0; step < 4000; ++step) joint.step(drive, 40.0);
  const double begin = joint.angle;
  for (int step = 0; step < 1000; ++step) joint.step(drive, 40.0);
  const double speed = (joint.angle - begin) / (1000 * kTimestep);
  EXPECT_LT(speed, 12.0);
  EXPECT_GT(speed, 10.0);
}

TEST(SeriesElasticDrive, gives_no_energy_to_a_joint_that_nothing_is_asked_of) {
  for (const double inertia : {0.02, 0.1, 1.0}) {
    for (const double speed : {-8.0, 1.0, 8.0}) {
      SeriesElasticDrive drive(drive_options(), kTimestep);
      FreeJoint joint{.inertia = inertia, .speed = speed};
      drive.rest_at(joint.angle);
      const double start = 0.5 * inertia * speed * speed;
      double late = 0.0;
      for (int step = 0; step < 8000; ++step) {
        joint.step(drive, 0.0);
        const double kinetic = 0.5 * inertia * joint.speed * joint.speed;
        ASSERT_LE(kinetic, 1.001 * start) << inertia << ", " << speed << ", step " << step;
        if (step > 7000) late = std::max(late, kinetic);
      }
      EXPECT_LE(late, 0.9 * start) << inertia << ", " << speed << ": " << late / start;
    }
  }
}

TEST(SeriesElasticDrive, keeps_the_energy_of_rotor_and_spring_where_nothing_takes_it) {
  ActuatorOptions options = drive_options(0.0);
  options.rotor.viscous = options.rotor.coulomb = 0.0;
  options.stall_torque.setConstant(1e-12);  // the motor is off
  SeriesElasticDrive drive(options, kTimestep);
  drive.rest_at(0.1);
  drive.advance(0.0, 0.0);
  double early = 0.0, late = 0.0;  // amplitudes
  for (int step = 0; step < 20'000; ++step) {
    drive.advance(0.0, 0.0);
    double& amplitude = step < 1000 ? early : late;
    if (step < 1000 || step >= 19'000) amplitude = std::max(amplitude, drive.torque(0.0));
  }
  EXPECT_NEAR(late / early, 1.0, 1e-3);
}

TEST(SeriesElasticDrive, stays_finite_with_a_rotor_of_almost_no_inertia_and_a_stiff_spring) {
  for (const double stiffness : {180.9, 1e6}) {
    ActuatorOptions options = drive_options();
    options.rotor.inertia = 1e-9;
    options.spring.stiffness = stiffness;
    SeriesElasticDrive drive(options, kTimestep);
    drive.rest_at(0.0);
    hold(drive, 5.0, 0.0, 1.0);
    EXPECT_LT(std::abs(drive.torque(0.0)), 60.0 + stiffness * 12.0 * kTimestep) << stiffness;
  }
}

}  // namespace
}  // namespace surefoot::simulation
