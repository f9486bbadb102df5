#include "surefoot/model/proportions.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::model {
namespace {

/// ANYmal B, from the URDF of example-robot-data and the limits of robots/anymal_b.yaml.
constexpr Proportions kReference{.leg = 0.56433096076673273,
                                 .mass = 30.475396462000006,
                                 .half_length = 0.3405,
                                 .half_width = 0.246,
                                 .hip_height = 0.0};

constexpr double kStandingHeight = 0.46;  // of the reference's hips over its feet [m]
constexpr double kHalfStride = 0.235;     // from the hip, of its walk, with some room [m]
constexpr double kLeastWidth = 0.85;      // of the feet, as a share of the reference's on such legs
constexpr double kWeakKnees = 0.15;       // torque over m g l: a wider stance asks too much of them
constexpr double kStrongKnees = 0.2;
constexpr double kRounding = 1e-6;

/// From the HFE axis to the sphere centre, across the axis.
double extension(const RobotModel& model, Leg leg, const Vec3& q) {
  const Vec3 hip_to_foot = model.foot_in_base(leg, q) - model.hip_in_base(leg, q);
  const Vec3 turned(q.x(), q.y() + kPi, q.z());  // half a turn leaves the part along the axis
  const Vec3 other = model.foot_in_base(leg, turned) - model.hip_in_base(leg, turned);
  return 0.5 * (hip_to_foot - other).norm();
}

double leg_length(const RobotModel& model, Leg leg) {
  const Eigen::Index knee = first_joint(leg) + 2;
  const double from = std::max(model.description().q_min[knee], -kPi);
  const double to = std::min(model.description().q_max[knee], kPi);
  return longest(from, to,
                 [&](double q_knee) { return extension(model, leg, Vec3(0.0, 0.0, q_knee)); });
}

/// How far the foot goes ahead and back of its hip at a stance's height, the knee bent as in the
/// nominal posture, until a joint meets its stop [m].
double stroke(const RobotModel& model, Leg leg, double height, double longest) {
  constexpr int kSteps = 40;
  const RobotDescription& robot = model.description();
  const Eigen::Index first = first_joint(leg);
  const Vec3 guess = robot.q_nominal.segment<3>(first);
  if (guess.z() == 0.0) return kInfinity;
  Vec3 p_BF = model.hip_in_base(leg, Vec3::Zero());
  p_BF.y() = model.foot_in_base(leg, Vec3::Zero()).y();
  p_BF.z() -= height;
  for (int i = 0; i <= kSteps; ++i) {
    for (const double side : {1.0, -1.0}) {
      const double way = longest * i / kSteps;
      Vec3 q;
      const bool is_there =
          model.inverse_kinematics(leg, p_BF + side * way * Vec3::UnitX(), guess, q);
      const bool is_free = (q.array() > robot.q_min.segment<3>(first).array()).all() &&
                           (q.array() < robot.q_max.segment<3>(first).array()).all();
      if (is_there && is_free) continue;
      return i == 0 ? kInfinity : (i - 1) * longest / kSteps;
    }
  }
  return kInfinity;
}

/// What the least of the knees may exert.
double knee_torque(const RobotDescription& robot) {
  double result = kInfinity;
  for (const Leg leg : robot.legs.legs())
    result = std::min(result, robot.torque_limit[first_joint(leg) + 2]);
  return result;
}

/// Margins go with legs, and so does the least width. But the knees of a wider stance have more to
/// carry, so weak ones stand below their hips.
double least_width(const Proportions& robot, double length) {
  const double strength = robot.knee_torque / (robot.mass * kGravity * robot.leg);
  const double share = (strength - kWeakKnees) / (kStrongKnees - kWeakKnees);
  return std::clamp(share, 0.0, 1.0) * kLeastWidth * length;
}

double ratio(double length, double reference) {
  const double result = length / reference;
  return std::abs(result - 1.0) < kRounding ? 1.0 : result;
}

/// Legs and hips in the nominal posture, which a biped's legs nearly stretch in. The rectangle of
/// four feet keeps ANYmal B's shape.
Proportions standing_proportions(RobotModel& model) {
  RobotState state;
  state.p_WB.setZero();
  state.q_WB.setIdentity();
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.q = model.description().q_nominal;
  state.qd.setZero(state.q.size());
  const Dynamics& dynamics = model.update(state, Vec3::UnitZ());
  Proportions result;
  result.num_legs = dynamics.num_legs();
  for (const Leg leg : dynamics.foot.legs()) {
    const Vec3& hip = dynamics.hip[index(leg)].p;
    result.leg += (hip - dynamics.foot[index(leg)].p).norm() / result.num_legs;
    result.hip_height += hip.z() / result.num_legs;
  }
  result.mass = model.mass();
  result.half_length = result.leg / kReference.leg * kReference.half_length;
  result.half_width = result.leg / kReference.leg * kReference.half_width;
  return result;
}

}  // namespace

double longest(double from, double to, const std::function<double(double q_knee)>& length) {
  constexpr int kAngles = 2000;
  double result = 0.0;
  for (int i = 0; i <= kAngles; ++i)
    result = std::max(result, length(from + (to - from) * i / kAngles));
  return result;
}

Proportions proportions_of(RobotModel& model) {
  if (!model.description().can_walk()) return standing_proportions(model);
  Proportions result;
  result.num_legs = model.description().num_legs();
  result.leg = kInfinity;
  for (const Leg leg : first_legs(result.num_legs)) {
    const Vec3 hip = model.hip_in_base(leg, Vec3::Zero());
    result.leg = std::min(result.leg, leg_length(model, leg));
    if (is_front(leg) || is_hind(leg, result.num_legs)) result.half_length += std::abs(hip.x()) / 4;
    result.half_width += std::abs(model.foot_in_base(leg, Vec3::Zero()).y()) / result.num_legs;
    result.hip_height += hip.z() / result.num_legs;
  }
  result.mass = model.mass();
  result.knee_torque = knee_torque(model.description());
  const double length = result.leg / kReference.leg;
  for (const Leg leg : first_legs(result.num_legs))
    result.stroke =
        std::min(result.stroke, stroke(model, leg, length * kStandingHeight, length * kHalfStride));
  return result;
}

Scale scale_of(const Proportions& robot) {
  Scale scale;
  scale.length = ratio(robot.leg, kReference.leg);
  scale.mass = ratio(robot.mass, kReference.mass);
  scale.half_length = ratio(robot.half_length, kReference.half_length);
  scale.half_width = ratio(robot.half_width, kReference.half_width);
  const double hip_height = robot.hip_height - scale.length * kReference.hip_height;
  scale.hip_height = std::abs(hip_height) < kRounding ? 0.0 : hip_height;
  if (robot.num_legs < kNumLegs) return scale;
  scale.half_width = std::max(scale.half_width, least_width(robot, scale.length));
  const int pairs = robot.num_legs / 2;  // hips stand closer, and a cycle has more swings
  const double gap = scale.half_length / (pairs - 1);
  scale.stride = std::min(1.0, gap / scale.length) * (2.0 / pairs);
  scale.stride = std::min(scale.stride, robot.stroke / (scale.length * kHalfStride));
  return scale;
}

}  // namespace surefoot::model
