#include "surefoot/model/limb_chain.hpp"

namespace surefoot::model {

LimbChain::Pose LimbChain::foot_in_base(const JointVector& q) const noexcept {
  Pose pose;
  pose.J.resize(3, joints.count);
  Columns origins(3, joints.count);
  for (int j = 0; j < joints.count; ++j) {
    const Hinge& hinge = hinges[static_cast<std::size_t>(j)];
    pose.p += pose.R * hinge.p;
    pose.R =
        pose.R * hinge.R * Eigen::AngleAxisd(q[joints.first + j], hinge.axis).toRotationMatrix();
    pose.J.col(j) = pose.R * hinge.axis;
    origins.col(j) = pose.p;
  }
  pose.p += pose.R * foot.p;
  pose.R = pose.R * foot.R;
  for (int j = 0; j < joints.count; ++j) {
    const Vec3 axis = pose.J.col(j);
    pose.J.col(j) = axis.cross(pose.p - origins.col(j));
  }
  return pose;
}

LimbChain limb_chain(const BodyTree& tree, Leg leg, const JointRange& joints) {
  LimbChain chain{.joints = joints, .hinges = {}, .foot = tree.feet[index(leg)]};
  for (int j = joints.first; j < joints.first + joints.count; ++j)
    chain.hinges.push_back(tree.limb_bodies[static_cast<std::size_t>(j)].hinge);
  return chain;
}

}  // namespace surefoot::model
