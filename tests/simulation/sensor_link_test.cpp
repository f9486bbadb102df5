#include "surefoot/simulation/sensor_link.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surefoot::simulation {
namespace {

constexpr double kPeriod = 0.0025;

/// A reading whose every value tells the tick that it was sampled at.
SensorReading sampled_at(int tick) {
  SensorReading reading;
  reading.time = tick * kPeriod;
  reading.encoder_time = reading.torque_time = reading.imu_time = reading.time;
  reading.q.setConstant(1000.0 + tick);
  reading.torque.setConstant(2000.0 + tick);
  reading.gyro.setConstant(3000.0 + tick);
  reading.accelerometer.setConstant(4000.0 + tick);
  reading.foot_force.fill(5000.0 + tick);
  return reading;
}

constexpr int kTicks = 40;

std::vector<SensorReading> received(const SensorOptions& options) {
  SensorLink link(options, kPeriod);
  std::vector<SensorReading> readings;
  for (int tick = 0; tick < kTicks; ++tick) {
    link.transmit(sampled_at(tick));
    readings.push_back(link.received());
  }
  return readings;
}

/// Calls `expect(tick, what was received)` for every tick.
template <typename Expect>
void at_each_tick(const SensorOptions& options, const Expect& expect, int first = 0) {
  const std::vector<SensorReading> readings = received(options);
  for (int tick = first; tick < kTicks; ++tick)
    expect(tick, readings[static_cast<std::size_t>(tick)]);
}

SensorOptions with_fault(SensorFault fault) {
  SensorOptions options;
  options.faults = {fault};
  return options;
}

/// From tick 10 on for 5 ticks.
SensorFault fault(FaultySensor sensor, FaultKind kind, double size = 0.0) {
  return {
      .sensor = sensor, .kind = kind, .time = 10 * kPeriod, .duration = 5 * kPeriod, .size = size};
}

bool active(int tick) { return tick >= 10 && tick < 15; }

void expect_same(const SensorReading& a, const SensorReading& b, int tick) {
  EXPECT_EQ(a.q, b.q) << tick;
  EXPECT_EQ(a.torque, b.torque) << tick;
  EXPECT_EQ(a.gyro, b.gyro) << tick;
  EXPECT_EQ(a.accelerometer, b.accelerometer) << tick;
  EXPECT_EQ(a.foot_force, b.foot_force) << tick;
  EXPECT_EQ(a.encoder_time, b.encoder_time) << tick;
  EXPECT_EQ(a.torque_time, b.torque_time) << tick;
  EXPECT_EQ(a.imu_time, b.imu_time) << tick;
}

TEST(SensorLink, passes_everything_on_where_nothing_is_wrong) {
  at_each_tick({}, [](int tick, const SensorReading& reading) {
    expect_same(reading, sampled_at(tick), tick);
  });
}

TEST(SensorLink, delays_each_sensor_by_its_own_ticks) {
  SensorOptions options;
  options.encoders.delay_ticks = 3;
  options.joint_torques.delay_ticks = 1;
  options.imu.delay_ticks = 7;
  options.foot_force.delay_ticks = 2;
  at_each_tick(options, [](int tick, const SensorReading& reading) {
    EXPECT_EQ(reading.time, tick * kPeriod);
    EXPECT_EQ(reading.q[5], 1000.0 + std::max(0, tick - 3));
    EXPECT_EQ(reading.torque[5], 2000.0 + std::max(0, tick - 1));
    EXPECT_EQ(reading.gyro.y(), 3000.0 + std::max(0, tick - 7));
    EXPECT_EQ(reading.accelerometer.y(), 4000.0 + std::max(0, tick - 7));
    EXPECT_EQ(reading.foot_force[1], 5000.0 + std::max(0, tick - 2));
    EXPECT_EQ(reading.encoder_time, std::max(0, tick - 3) * kPeriod);
    EXPECT_EQ(reading.imu_time, std::max(0, tick - 7) * kPeriod);
  });
}

TEST(SensorLink, gives_nothing_but_the_last_time_of_a_sensor_that_stops) {
  at_each_tick(with_fault(fault(FaultySensor::imu, FaultKind::stops)),
               [](int tick, const SensorReading& reading) {
                 EXPECT_EQ(std::isnan(reading.gyro.z()), active(tick)) << tick;
                 EXPECT_EQ(std::isnan(reading.accelerometer.z()), active(tick)) << tick;
                 EXPECT_EQ(reading.imu_time, (active(tick) ? 9 : tick) * kPeriod) << tick;
                 EXPECT_EQ(reading.q, sampled_at(tick).q) << tick;
               });
}

TEST(SensorLink, gives_nan_with_a_fresh_time_of_a_sensor_that_sends_it) {
  at_each_tick(with_fault(fault(FaultySensor::encoders, FaultKind::nan)),
               [](int tick, const SensorReading& reading) {
                 EXPECT_EQ(reading.q.hasNaN(), active(tick)) << tick;
                 EXPECT_EQ(reading.encoder_time, tick * kPeriod) << tick;
                 EXPECT_EQ(reading.torque, sampled_at(tick).torque) << tick;
               });
}

TEST(SensorLink, repeats_the_last_sample_with_its_time) {
  at_each_tick(with_fault(fault(FaultySensor::joint_torques, FaultKind::repeats)),
               [](int tick, const SensorReading& reading) {
                 const int sample = active(tick) ? 9 : tick;
                 EXPECT_EQ(reading.torque, sampled_at(sample).torque) << tick;
                 EXPECT_EQ(reading.torque_time, sample * kPeriod) << tick;
               });
}

TEST(SensorLink, adds_the_size_of_a_jump_while_it_lasts) {
  at_each_tick(with_fault(fault(FaultySensor::gyro, FaultKind::jump, 0.25)),
               [](int tick, const SensorReading& reading) {
                 EXPECT_EQ(reading.gyro.x(), 3000.0 + tick + (active(tick) ? 0.25 : 0.0)) << tick;
                 EXPECT_EQ(reading.accelerometer, sampled_at(tick).accelerometer) << tick;
                 EXPECT_EQ(reading.imu_time, tick * kPeriod) << tick;
               });
}

TEST(SensorLink, adds_the_size_of_a_spike_to_one_sample) {
  at_each_tick(with_fault(fault(FaultySensor::accelerometer, FaultKind::spike, -20.0)),
               [](int tick, const SensorReading& reading) {
                 EXPECT_EQ(reading.accelerometer.z(), 4000.0 + tick - (tick == 10 ? 20.0 : 0.0))
                     << tick;
               });
}

TEST(SensorLink, scales_every_sample_of_another_unit_or_sign) {
  at_each_tick(with_fault(fault(FaultySensor::gyro, FaultKind::scaled, -57.3)),
               [](int tick, const SensorReading& reading) {
                 EXPECT_EQ(reading.gyro.x(), (active(tick) ? -57.3 : 1.0) * (3000.0 + tick))
                     << tick;
                 EXPECT_EQ(reading.accelerometer, sampled_at(tick).accelerometer) << tick;
                 EXPECT_EQ(reading.imu_time, tick * kPeriod) << tick;
               });
}

TEST(SensorLink, makes_late_samples_later_than_the_usual_delay) {
  SensorOptions options = with_fault(fault(FaultySensor::encoders, FaultKind::late, 4.0));
  options.encoders.delay_ticks = 2;
  const auto expect = [](int tick, const SensorReading& reading) {
    const int sample = tick - 2 - (active(tick) ? 4 : 0);
    EXPECT_EQ(reading.q[0], 1000.0 + sample) << tick;
    EXPECT_EQ(reading.encoder_time, sample * kPeriod) << tick;
  };
  at_each_tick(options, expect, 6);
}

TEST(SensorLink, takes_a_fault_while_it_runs) {
  for (const FaultKind kind : {FaultKind::stops, FaultKind::repeats, FaultKind::jump}) {
    const SensorFault later = fault(FaultySensor::encoders, kind, 5.0);
    const std::vector<SensorReading> planned = received(with_fault(later));
    SensorLink link({}, kPeriod);
    for (int tick = 0; tick < kTicks; ++tick) {
      if (tick == 10) link.add(later);
      link.transmit(sampled_at(tick));
      const SensorReading& expected = planned[static_cast<std::size_t>(tick)];
      EXPECT_TRUE(link.received().q.array().isNaN().all() || link.received().q == expected.q)
          << tick;
      EXPECT_EQ(link.received().q.hasNaN(), expected.q.hasNaN()) << tick;
      EXPECT_EQ(link.received().encoder_time, expected.encoder_time) << tick;
    }
  }
}

TEST(SensorLink, becomes_late_while_it_runs_without_samples_that_were_never_kept) {
  SensorOptions options;
  options.encoders.delay_ticks = 2;
  SensorLink link(options, kPeriod);
  for (int tick = 0; tick < kTicks; ++tick) {
    if (tick == 10) link.add(fault(FaultySensor::encoders, FaultKind::late, 3.0));
    link.transmit(sampled_at(tick));
    const int sample = active(tick) ? std::max(tick - 5, 7) : tick - 2;
    if (tick < 2) continue;
    EXPECT_EQ(link.received().q[0], 1000.0 + sample) << tick;
  }
}

TEST(SensorLink, spoils_one_joint_alone_where_it_is_named) {
  SensorFault one = fault(FaultySensor::encoders, FaultKind::stops);
  one.joint = 7;
  const std::vector<SensorReading> readings = received(with_fault(one));
  const SensorReading& reading = readings[12];
  for (Eigen::Index joint = 0; joint < kNumLegJoints; ++joint)
    EXPECT_EQ(std::isnan(reading.q[joint]), joint == 7);
  EXPECT_EQ(reading.encoder_time, 12 * kPeriod);
}

TEST(SensorLink, spoils_one_foot_alone_where_it_is_named) {
  SensorFault one = fault(FaultySensor::foot_force, FaultKind::late, 3.0);
  one.leg = 2;
  const auto expect = [](int tick, const SensorReading& reading) {
    for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
      EXPECT_EQ(reading.foot_force[leg], 5000.0 + tick - (active(tick) && leg == 2 ? 3.0 : 0.0));
    }
    EXPECT_EQ(reading.q, sampled_at(tick).q) << tick;
  };
  at_each_tick(with_fault(one), expect, 3);
}

TEST(SensorLink, spoils_all_feet_unless_one_is_named) {
  for (const FaultKind kind : {FaultKind::stops, FaultKind::nan}) {
    at_each_tick(with_fault(fault(FaultySensor::foot_force, kind)),
                 [](int tick, const SensorReading& reading) {
                   for (const double force : reading.foot_force)
                     EXPECT_EQ(std::isnan(force), active(tick)) << tick;
                 });
  }
}

TEST(SensorLink, that_fails_from_the_first_tick_on_has_the_first_sample_to_repeat) {
  SensorFault repeats = fault(FaultySensor::encoders, FaultKind::repeats);
  repeats.time = 0.0;
  const std::vector<SensorReading> readings = received(with_fault(repeats));
  EXPECT_EQ(readings[0].q[0], 1000.0);
  EXPECT_EQ(readings[3].q[0], 1000.0);
  EXPECT_EQ(readings[5].q[0], 1005.0);
}

TEST(SensorLink, without_an_end_stays_faulty) {
  SensorFault stops = fault(FaultySensor::imu, FaultKind::stops);
  stops.duration = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(received(with_fault(stops)).back().gyro.hasNaN());
}

}  // namespace
}  // namespace surefoot::simulation
