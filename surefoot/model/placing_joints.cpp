#include "surefoot/model/placing_joints.hpp"

#include <algorithm>

namespace surefoot::model {
namespace {

/// The axis in B with all joints at 0.
Vec3 axis_of(const Urdf& urdf, const std::string& base, const UrdfJoint& joint) {
  Vec3 axis = joint.R * joint.axis;
  for (std::string link = joint.parent; link != base && link != urdf.root;) {
    const auto above = std::ranges::find(urdf.joints, link, &UrdfJoint::child);
    axis = (above->R * axis).eval();
    link = above->parent;
  }
  return axis;
}

}  // namespace

std::vector<const UrdfJoint*> placing_joints(const Urdf& urdf, const std::string& base,
                                             const std::vector<const UrdfJoint*>& chain) {
  std::vector<const UrdfJoint*> placing;
  for (const UrdfJoint* joint : chain) {
    Eigen::Index along = 0;
    axis_of(urdf, base, *joint).cwiseAbs().maxCoeff(&along);
    if (placing.size() < kJointsPerLeg && along == (placing.empty() ? 0 : 1))
      placing.push_back(joint);
  }
  return placing;
}

}  // namespace surefoot::model
