#pragma once

#include "surefoot/math/rotation.hpp"
#include "surefoot/model/angular_momentum.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/planning/calibration_motion.hpp"
#include "tests/support/anymal_b.hpp"

#include <Eigen/QR>

namespace surefoot::test {

constexpr double kPeriod = 0.0025;

/// A robot whose base carries what its model does not know of, and the ground's forces on it.
class LadenRobot {
 public:
  explicit LadenRobot(const BaseLoad& load) : model(anymal_b()), truth_(anymal_b()) {
    truth_.set_base_load(load);
    state_.time = 0.0;
    state_.p_WB = Vec3(0.3, -0.2, 0.5);
    state_.q = model.description().q_nominal;
    stand();
  }

  void stand() {
    state_.q_WB = kHeading;
    state_.v_WB.setZero();
    state_.w_WB_B.setZero();
    state_.qd.setZero();
    acceleration_.setZero();
    turning_.setZero();
    update();
  }

  /// The torso as the motion has it at `t`, about B's origin; the legs go along.
  void turn(const CalibrationMotion& motion, double t) {
    constexpr double kStep = 1e-4;
    const auto momenta = [&](double time) {
      place(motion, time);
      return std::pair(Vec3(actual().mass * actual().com.v), angular_momentum(actual()));
    };
    const auto [p1, L1] = momenta(t + kStep);
    const auto [p0, L0] = momenta(t - kStep);
    acceleration_ = (p1 - p0) / (2.0 * kStep) / actual().mass;
    turning_ = (L1 - L0) / (2.0 * kStep);
    place(motion, t);
  }

  /// All legs swing in their hips by so much [rad].
  void move_legs(double angle) {
    for (const Leg leg : kLegs) state_.q[first_joint(leg) + 1] += angle;
    update();
  }

  void update() {
    truth_.update(state_, Vec3::UnitZ());
    model.update(state_, Vec3::UnitZ());
  }

  [[nodiscard]] const Dynamics& believed() const { return model.dynamics(); }
  [[nodiscard]] const Dynamics& actual() const { return truth_.dynamics(); }

  /// The smallest that move it as it moves.
  [[nodiscard]] PerLeg<Vec3> forces() const {
    Eigen::Matrix<double, 6, 3 * kNumLegs> A;
    for (int k = 0; k < kNumLegs; ++k) {
      const Vec3 lever = actual().contact[static_cast<std::size_t>(k)].p - actual().com.p;
      A.block<3, 3>(0, 3 * k).setIdentity();
      A.block<3, 3>(3, 3 * k) = skew(lever);
    }
    Eigen::Matrix<double, 6, 1> b;
    b << actual().mass * (acceleration_ + kGravity * Vec3::UnitZ()), turning_;
    const Eigen::Matrix<double, 3 * kNumLegs, 1> f = A.completeOrthogonalDecomposition().solve(b);
    PerLeg<Vec3> result;
    for (int k = 0; k < kNumLegs; ++k) result[static_cast<std::size_t>(k)] = f.segment<3>(3 * k);
    return result;
  }

  RobotModel model;

 private:
  inline static const Quat kHeading{Eigen::AngleAxisd(0.7, Vec3::UnitZ())};

  void place(const CalibrationMotion& motion, double t) {
    const Motion<Vec3> angles = motion.at(t);
    const auto rotation = [&](const Vec3& a) {
      return Quat(Eigen::AngleAxisd(a.z(), Vec3::UnitZ()) *
                  Eigen::AngleAxisd(a.y(), Vec3::UnitY()) *
                  Eigen::AngleAxisd(a.x(), Vec3::UnitX()));
    };
    constexpr double kStep = 1e-6;
    const Quat now = rotation(angles.p);
    const Eigen::AngleAxisd moved(now.conjugate() * rotation(angles.p + kStep * angles.v));
    state_.q_WB = kHeading * now;
    state_.w_WB_B = moved.angle() / kStep * moved.axis();
    update();
  }

  RobotModel truth_;
  RobotState state_;
  Vec3 acceleration_ = Vec3::Zero(), turning_ = Vec3::Zero();
};

}  // namespace surefoot::test
