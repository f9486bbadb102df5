#pragma once

#include "surefoot/gaits/parts/calibration_motion.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/angular_momentum.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"

#include <Eigen/QR>

#include <utility>
#include <vector>

namespace surefoot::test {

constexpr double kPeriod = 0.0025;
constexpr double kModelMass = 30.4754;  // [kg]

/// A mass that is fixed to the base; negative where the robot is lighter there.
struct Lump {
  double mass = 0.0;       // [kg]
  Vec3 at = Vec3::Zero();  // in B [m]
};

/// That together move the COM of a robot by an offset in B and change nothing else of it.
inline std::vector<Lump> shifted_by(const Vec3& offset) {
  constexpr double kMass = 10.0;
  const Vec3 arm = kModelMass * offset / (2.0 * kMass);
  return {{kMass, arm}, {-kMass, -arm}};
}

/// A robot whose base carries what its model does not know of, and the ground's forces on it.
class LadenRobot {
 public:
  /// Of the whole, in W.
  struct Actual {
    double mass = 0.0;
    Vec3 com = Vec3::Zero(), velocity = Vec3::Zero();
    Vec3 angular_momentum = Vec3::Zero();  // about the COM
  };

  explicit LadenRobot(std::vector<Lump> lumps)
      : model(anymal_b()), bare_(anymal_b()), lumps_(std::move(lumps)) {
    state_.time = 0.0;
    state_.p_WB = Vec3(0.3, -0.2, 0.5);
    state_.q = model.description().q_nominal;
    stand();
  }

  /// The ground, and the robot with it, turned away from the level [rad].
  void lean(double roll, double pitch) {
    lean_ = Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
                 Eigen::AngleAxisd(roll, Vec3::UnitX()));
    stand();
  }

  void carry(std::vector<Lump> lumps) { lumps_ = std::move(lumps); }

  void stand() {
    state_.q_WB = lean_;
    state_.v_WB.setZero();
    state_.w_WB_B.setZero();
    state_.qd.setZero();
    acceleration_.setZero();
    turning_.setZero();
    update();
  }

  /// The torso as the motion has it at `t`, about B's origin; the legs go along.
  void turn(const gaits::CalibrationMotion& motion, double t) {
    constexpr double kStep = 1e-4;
    const auto momenta = [&](double time) {
      place(motion, time);
      const Actual all = actual();
      return std::pair(Vec3(all.velocity), all.angular_momentum);
    };
    const auto [v1, L1] = momenta(t + kStep);
    const auto [v0, L0] = momenta(t - kStep);
    acceleration_ = (v1 - v0) / (2.0 * kStep);
    turning_ = (L1 - L0) / (2.0 * kStep);
    place(motion, t);
  }

  /// All legs swing in their hips by so much [rad].
  void move_legs(double angle) {
    for (const Leg leg : kLegs) state_.q[first_joint(leg) + 1] += angle;
    update();
  }

  void update() {
    bare_.update(state_, Vec3::UnitZ());
    model.update(state_, Vec3::UnitZ());
  }

  [[nodiscard]] const model::Dynamics& believed() const { return model.dynamics(); }
  [[nodiscard]] Actual actual() const {
    const model::Dynamics& bare = bare_.dynamics();
    const Vec3 w = bare.base_rotation.w;
    Actual all{
        .mass = bare.mass, .com = bare.mass * bare.com.p, .velocity = bare.mass * bare.com.v};
    const auto arm = [&](const Lump& lump) { return Vec3(bare.base_rotation.R * lump.at); };
    for (const Lump& lump : lumps_) {
      all.mass += lump.mass;
      all.com += lump.mass * (bare.base.p + arm(lump));
      all.velocity += lump.mass * (bare.base.v + w.cross(arm(lump)));
    }
    all.com /= all.mass;
    all.velocity /= all.mass;
    all.angular_momentum = model::angular_momentum(bare) +
                           bare.mass * (bare.com.p - all.com).cross(bare.com.v - all.velocity);
    for (const Lump& lump : lumps_) {
      all.angular_momentum +=
          lump.mass * (bare.base.p + arm(lump) - all.com)
                          .cross(bare.base.v + w.cross(arm(lump)) - all.velocity);
    }
    return all;
  }

  /// The smallest that move it as it moves.
  [[nodiscard]] PerLeg<Vec3> forces() const {
    const Actual all = actual();
    Eigen::Matrix<double, 6, 3 * kNumLegs> A;
    for (int k = 0; k < kNumLegs; ++k) {
      const Vec3 lever = bare_.dynamics().contact[static_cast<std::size_t>(k)].p - all.com;
      A.block<3, 3>(0, 3 * k).setIdentity();
      A.block<3, 3>(3, 3 * k) = skew(lever);
    }
    Eigen::Matrix<double, 6, 1> b;
    b << all.mass * (acceleration_ + kGravity * Vec3::UnitZ()), turning_;
    const Eigen::Matrix<double, 3 * kNumLegs, 1> f = A.completeOrthogonalDecomposition().solve(b);
    PerLeg<Vec3> result;
    for (int k = 0; k < kNumLegs; ++k) result[static_cast<std::size_t>(k)] = f.segment<3>(3 * k);
    return result;
  }

  model::RobotModel model;

 private:
  void place(const gaits::CalibrationMotion& motion, double t) {
    const Motion<Vec3> angles = motion.at(t);
    const auto rotation = [&](const Vec3& a) {
      return Quat(Eigen::AngleAxisd(a.z(), Vec3::UnitZ()) *
                  Eigen::AngleAxisd(a.y(), Vec3::UnitY()) *
                  Eigen::AngleAxisd(a.x(), Vec3::UnitX()));
    };
    constexpr double kStep = 1e-6;
    const Quat now = rotation(angles.p);
    const Eigen::AngleAxisd moved(now.conjugate() * rotation(angles.p + kStep * angles.v));
    state_.q_WB = lean_ * now;
    state_.w_WB_B = moved.angle() / kStep * moved.axis();
    update();
  }

  model::RobotModel bare_;
  std::vector<Lump> lumps_;
  RobotState state_;
  Quat lean_{Eigen::AngleAxisd(0.7, Vec3::UnitZ())};
  Vec3 acceleration_ = Vec3::Zero(), turning_ = Vec3::Zero();
};

}  // namespace surefoot::test
