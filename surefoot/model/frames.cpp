#include "surefoot/model/frames.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/arm_of_joints.hpp"
#include "surefoot/model/body_tree.hpp"

#include <algorithm>

namespace surefoot::model {

Frames::Frames(const RobotDescription& robot) : robot_(robot.name) {
  const Urdf urdf = read_urdf(robot);
  const BodyTree tree = make_body_tree(robot, urdf);
  for (const UrdfLink& link : urdf.links) add(link.name, tree.links.at(link.name));
  for (const UrdfJoint& joint : urdf.joints) add(joint.name, tree.links.at(joint.child));
  for (std::size_t arm = 0; arm < robot.arms.size(); ++arm)
    add(robot.arms[arm].name, tree.arm_tips[arm]);
  arm_of_body_ = arm_of_joints(robot);
  arm_of_body_.insert(arm_of_body_.begin(), -1);  // the base
}

/// The first of a name is meant.
void Frames::add(const std::string& name, const BodyFrame& frame) {
  if (std::ranges::find(names_, name) != names_.end()) return;
  names_.push_back(name);
  frames_.push_back(frame);
}

int Frames::number(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found != names_.end()) return static_cast<int>(found - names_.begin());
  throw UnknownNameError("the robot " + robot_ + " has no frame \"" + std::string(name) + "\"; " +
                         near_names(name, names_));
}

int Frames::arm_of(int number) const {
  return arm_of_body_[static_cast<std::size_t>((*this)[number].body)];
}

FrameKinematics frame_kinematics(const BodyFrame& frame, const Dynamics& dynamics) noexcept {
  const std::vector<BodyKinematics>& bodies = dynamics.bodies;
  const BodyKinematics& body = bodies[static_cast<std::size_t>(frame.body)];
  const BodyKinematics& base = bodies.front();
  const Vec3 lever = body.R * frame.p;
  FrameKinematics result;
  auto& [point, rotation] = result;
  point.p = body.p + lever;
  point.v = body.v + body.w.cross(lever);
  point.Jdot_u = body.a + body.wdot.cross(lever) + body.w.cross(body.w.cross(lever));
  rotation.R = body.R * frame.R;
  rotation.w = body.w;
  rotation.Jdot_u = body.wdot;
  point.J.setZero(3, dynamics.num_velocities());
  rotation.J.setZero(3, dynamics.num_velocities());
  point.J.leftCols<3>().setIdentity();
  point.J.middleCols<3>(3) = -skew(point.p - base.p) * base.R;
  rotation.J.middleCols<3>(3) = base.R;
  for (int on = frame.body; on > 0; on = bodies[static_cast<std::size_t>(on)].parent) {
    const BodyKinematics& turning = bodies[static_cast<std::size_t>(on)];
    point.J.col(5 + on) = turning.axis.cross(point.p - turning.p);
    rotation.J.col(5 + on) = turning.axis;
  }
  return result;
}

FrameKinematics relative_to_base(const FrameKinematics& frame, const Dynamics& dynamics) noexcept {
  const BodyKinematics& base = dynamics.bodies.front();
  const Mat3 R_BW = base.R.transpose();
  const Vec3 lever = frame.point.p - base.p;
  const Vec3 v = frame.point.v - base.v - base.w.cross(lever);
  const Vec3 w = frame.rotation.w - base.w;
  FrameKinematics result = frame;
  result.point.p = R_BW * lever;
  result.point.v = R_BW * v;
  result.point.Jdot_u = R_BW * (frame.point.Jdot_u - base.a - base.wdot.cross(lever) -
                                base.w.cross(base.w.cross(lever)) - 2.0 * base.w.cross(v));
  result.rotation.R = R_BW * frame.rotation.R;
  result.rotation.w = R_BW * w;
  result.rotation.Jdot_u = R_BW * (frame.rotation.Jdot_u - base.wdot - base.w.cross(w));
  for (Jacobian3* J : {&result.point.J, &result.rotation.J}) {
    J->leftCols<6>().setZero();
    for (Eigen::Index j = 6; j < J->cols(); ++j) J->col(j) = R_BW * Vec3(J->col(j));
  }
  return result;
}

}  // namespace surefoot::model
