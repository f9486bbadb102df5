#include "surefoot/estimation/rest_check.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kSlowJoints = 0.5;   // of a robot that stands [rad/s]
constexpr double kFastestBias = 0.5;  // beyond any gyroscope's [rad/s]
constexpr double kBears = 0.5;        // share of the weight
constexpr double kUnlike = 0.5;       // of the larger of weight and force …
constexpr double kStillUnlike = 0.4;  // … of an IMU that was wrong before

}  // namespace

void RestCheck::update(const SensorReading& reading, const JointVector& joint_velocity,
                       const Vec3& force, double mass) noexcept {
  const double weight = mass * kGravity;
  const bool stands = joint_velocity.cwiseAbs().maxCoeff() < kSlowJoints &&
                      force.norm() > kBears * weight;  // not if it is NaN
  if (!stands) return;
  const double off = (mass * reading.accelerometer - force).norm();
  const double unlike = wrong_for_ > 0.0 ? kStillUnlike : kUnlike;
  const bool is_off = off > unlike * std::max(weight, force.norm());
  const bool turns = reading.gyro.norm() > kFastestBias;
  torques_pull_ = force.z() < 0.0;
  wrong_for_ = is_off || turns ? wrong_for_ + period_ : 0.0;
}

}  // namespace surefoot
