#include "surefoot/estimation/standing_start.hpp"

#include "surefoot/math/rotation.hpp"

#include <cmath>

namespace surefoot::estimation {
namespace {

// A robot that stands:
constexpr double kMaxTurn = 0.2;          // of the base, including the gyroscope's bias [rad/s]
constexpr double kMaxJointSpeed = 0.5;    // [rad/s]
constexpr double kMaxAcceleration = 1.0;  // difference of the specific force from g [m/s²]
// A robot that did not stand at the first reading:
constexpr double kStandingTime = 0.1;  // [s]
constexpr double kMaxBias = 0.06;      // of a gyroscope; a larger one means moving legs [rad/s]
constexpr double kDoubt = 3.0;

}  // namespace

bool StandingStart::stands(const SensorReading& reading, const JointVector& joint_velocity,
                           const PerLeg<Vec3>& p_BC, const PerLeg<Vec3>& v_BC) noexcept {
  const bool is_complete =
      reading.q.allFinite() && reading.gyro.allFinite() && reading.accelerometer.allFinite();
  const bool is_slow =
      is_complete && reading.gyro.norm() < kMaxTurn &&
      joint_velocity.head(num_leg_joints_).cwiseAbs().maxCoeff() < scale_.rate() * kMaxJointSpeed &&
      std::abs(reading.accelerometer.norm() - kGravity) < kMaxAcceleration;
  const bool has_gap = reading.time - time_ > 1.5 * period_;
  time_ = reading.time;
  has_waited_ = has_waited_ || !is_slow || has_gap;
  if (!is_slow || has_gap) window_ = {};
  if (!is_slow) return false;
  const BaseMotion motion = base_motion(p_BC, v_BC);
  window_.gyro.add(reading.gyro);
  window_.force.add(reading.accelerometer);
  window_.v.add(motion.v);
  window_.w.add(motion.w);
  if (!has_waited_) return true;
  if (window_.gyro.size() * period_ <= kStandingTime) return false;
  const bool agrees = state().gyro_bias.norm() < kMaxBias;
  if (!agrees) window_ = {};
  return agrees;
}

void StandingStart::restart() noexcept {
  window_ = {};
  has_waited_ = true;
}

// The means belong to the window's middle; the base has turned since.
StandingStart::State StandingStart::state() const noexcept {
  const Vec3 w = window_.w.mean();
  const Vec3 acceleration = window_.v.slope() / period_ + w.cross(window_.v.mean());
  const Vec3 turn = 0.5 * (window_.w.size() - 1) * period_ * w;
  return {.gyro_bias = window_.gyro.mean() - w,
          .specific_force = exp_rotation(-turn) * (window_.force.mean() - acceleration),
          .v_WB_B = window_.v.last(),
          .doubt = has_waited_ ? kDoubt : 1.0};
}

}  // namespace surefoot::estimation
