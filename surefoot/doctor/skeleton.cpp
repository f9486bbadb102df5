#include "surefoot/doctor/skeleton.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace surefoot::doctor {
namespace {

struct Frame {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
};

std::map<std::string, double> angles(const Diagnosis& robot) {
  std::map<std::string, double> angles;
  if (!robot.robot) return angles;
  const std::vector<std::string> names = robot.robot->joint_names();
  for (std::size_t i = 0; i < names.size(); ++i)
    angles[names[i]] = robot.robot->q_nominal[static_cast<Eigen::Index>(i)];
  return angles;
}

/// The frames of all links, in that of the root.
class Frames {
 public:
  explicit Frames(const Diagnosis& robot) : urdf_(robot.urdf), angles_(angles(robot)) {
    add(urdf_.root, Frame());
  }
  [[nodiscard]] const Frame& of(const std::string& link) const { return frames_.at(link); }

 private:
  void add(const std::string& link, const Frame& frame) {
    frames_[link] = frame;
    for (const model::UrdfJoint& joint : urdf_.joints) {
      if (joint.parent != link) continue;
      const auto angle = angles_.find(joint.name);
      const double q = angle == angles_.end() ? 0.0 : angle->second;
      add(joint.child, {frame.R * joint.R * Eigen::AngleAxisd(q, joint.axis).toRotationMatrix(),
                        frame.p + frame.R * joint.p});
    }
  }

  const model::Urdf& urdf_;
  const std::map<std::string, double> angles_;
  std::map<std::string, Frame> frames_;
};

DrawnLimb drawn(const std::vector<model::UrdfJoint>& joints, const Frames& frames) {
  DrawnLimb limb{.leg = {}, .name = {}, .joints = {}, .foot = {}, .tip = Vec3::Zero()};
  for (const model::UrdfJoint& joint : joints) {
    const Frame& frame = frames.of(joint.child);
    limb.joints.push_back({joint.name, frame.p, frame.R * joint.axis});
    limb.tip = frame.p;
  }
  return limb;
}

DrawnLimb drawn(const FoundLeg& leg, const Frames& frames) {
  DrawnLimb limb = drawn(leg.all_joints, frames);
  const Frame& foot = frames.of(leg.foot.link);
  limb.foot = leg.foot.link;
  limb.tip = foot.p + foot.R * leg.foot.center;
  limb.radius = leg.foot.radius;
  return limb;
}

}  // namespace

Skeleton skeleton_of(const Diagnosis& robot) {
  const Frames frames(robot);
  Skeleton skeleton;
  const Anatomy& anatomy = robot.anatomy;
  if (anatomy.legs) {
    for (const Leg leg : anatomy.legs->legs()) {
      skeleton.limbs.push_back(drawn((*anatomy.legs)[index(leg)], frames));
      skeleton.limbs.back().leg = leg;
      skeleton.limbs.back().name = leg_name(leg, static_cast<int>(anatomy.legs->size()));
    }
  }
  if (anatomy.flat_legs) {
    for (const Leg leg : first_legs(2)) {
      const FlatLeg& flat = anatomy.flat_legs->legs[index(leg)];
      skeleton.limbs.push_back(drawn(flat.joints, frames));
      skeleton.limbs.back().leg = leg;
      skeleton.limbs.back().name = leg_name(leg, 2);
    }
  }
  for (const FoundLeg& leg : anatomy.loose) skeleton.limbs.push_back(drawn(leg, frames));
  for (const Limb& limb : anatomy.others) skeleton.limbs.push_back(drawn(limb.joints, frames));
  for (const model::UrdfLink& link : robot.urdf.links) {
    const Frame& frame = frames.of(link.name);
    skeleton.mass += link.inertia.mass;
    skeleton.com += link.inertia.mass * (frame.p + frame.R * link.inertia.com);
  }
  if (skeleton.mass > 0.0) skeleton.com /= skeleton.mass;
  return skeleton;
}

}  // namespace surefoot::doctor
