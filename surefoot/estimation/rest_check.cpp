#include "surefoot/estimation/rest_check.hpp"

#include <algorithm>

namespace surefoot::estimation {
namespace {

constexpr double kStandingSpeed = 0.5;      // of a standing robot [rad/s]
constexpr double kMaxGyroBias = 0.5;        // beyond any gyroscope's [rad/s]
constexpr double kMinLoad = 0.5;            // share of the weight
constexpr double kFaultDifference = 0.5;    // share of the larger of weight and force
constexpr double kLastingDifference = 0.4;  // … for an IMU that was faulty before

}  // namespace

void RestCheck::update(const SensorReading& reading, const JointVector& joint_velocity,
                       const Vec3& force, double mass) noexcept {
  const double weight = mass * kGravity;
  const bool stands =
      joint_velocity.head(num_leg_joints_).cwiseAbs().maxCoeff() < scale_.rate() * kStandingSpeed &&
      force.norm() > kMinLoad * weight;  // not if it is NaN
  if (!stands) return;
  const double error = (mass * reading.accelerometer - force).norm();
  const double max_error = wrong_for_ > 0.0 ? kLastingDifference : kFaultDifference;
  const bool is_off = error > max_error * std::max(weight, force.norm());
  const bool turns = reading.gyro.norm() > kMaxGyroBias;
  torques_pull_ = force.z() < 0.0;
  wrong_for_ = is_off || turns ? wrong_for_ + period_ : 0.0;
}

}  // namespace surefoot::estimation
