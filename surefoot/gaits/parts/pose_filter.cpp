#include "surefoot/gaits/parts/pose_filter.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>

namespace surefoot::gaits {
namespace {

constexpr double kRate = 3.0;  // ω [rad/s]
constexpr double kLongest =
    0.2;  // way that counts, which limits the speed to kRate / 3 times it [m]
constexpr double kFarthest = 0.6;   // the same of a turn [rad]
constexpr double kLeash = 0.02;     // most distance from a limb [m]
constexpr double kTurnLeash = 0.2;  // the same of a turn [rad]

void follow(const Vec3& target, double most, double rate, double period, Motion<Vec3>& motion) {
  const Vec3 way = clip_norm<3>(target - motion.p, most);
  const Vec3 jerk = rate * rate * rate * way - 3.0 * rate * rate * motion.v - 3.0 * rate * motion.a;
  motion.a += period * jerk;
  motion.v += period * motion.a;
  motion.p += period * motion.v;
}

void hold_near(const Vec3& limb, double leash, Motion<Vec3>& motion) {
  const Vec3 ahead = motion.p - limb;
  if (!(ahead.norm() > leash)) return;
  const Vec3 outward = ahead.normalized();
  motion.p = limb + leash * outward;
  motion.v -= std::max(0.0, outward.dot(motion.v)) * outward;
  motion.a -= std::max(0.0, outward.dot(motion.a)) * outward;
}

}  // namespace

PoseFilter::PoseFilter(double period, const Scale& scale)
    : period_(period),
      rate_(scale.rate() * kRate),
      longest_(scale.length * kLongest),
      leash_(scale.length * kLeash) {}

void PoseFilter::begin(const Vec3& p, const Vec3& v, const Quat& q) {
  position_ = {p, v, Vec3::Zero()};
  turn_ = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  first_ = q;
}

void PoseFilter::update(const Vec3& position, const Vec3& orientation) noexcept {
  follow(position, longest_, rate_, period_, position_);
  const Vec3 turn = orientation.allFinite() ? box_minus(from_roll_pitch_yaw(orientation), first_)
                                            : Vec3(Vec3::Zero());
  follow(turn, kFarthest, rate_, period_, turn_);
}

void PoseFilter::wait_for(const Vec3& p, const Quat& q) noexcept {
  hold_near(p, leash_, position_);
  hold_near(box_minus(q, first_), kTurnLeash, turn_);
}

Quat PoseFilter::orientation() const { return exp_rotation(turn_.p) * first_; }

}  // namespace surefoot::gaits
