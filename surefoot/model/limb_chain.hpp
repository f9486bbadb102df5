#pragma once

#include "surefoot/model/body_tree.hpp"

#include <vector>

namespace surefoot::model {

/// Kinematics of a leg with any number of joints in B.
struct LimbChain {
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxLegJoints>;

  JointRange joints;
  std::vector<Hinge> hinges;  ///< from the base on
  BodyFrame foot;             ///< of the sole, on the last body

  struct Pose {
    Vec3 p = Vec3::Zero();
    Mat3 R = Mat3::Identity();
    Columns J;  ///< ∂p/∂q of these joints
  };
  /// The sole's centre and axes at the joint angles of the robot [rad]. Does not allocate.
  [[nodiscard]] Pose foot_in_base(const JointVector& q) const noexcept;
};

/// Of a robot that only stands.
[[nodiscard]] LimbChain limb_chain(const BodyTree& tree, Leg leg, const JointRange& joints);

}  // namespace surefoot::model
