#include "surefoot/simulation/robot_parts.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/simulation/terrain.hpp"

#include <algorithm>

namespace surefoot::simulation {

namespace {

/// Throws Error where the model does not have the name.
int found(const mjModel& model, mjtObj type, const std::string& name) {
  const int id = id_of(model, type, name);
  if (id < 0) throw Error("the physics model lost \"" + name + "\" of the robot");
  return id;
}

bool is_below(const mjModel& model, int body, int ancestor) {
  while (body > ancestor) body = model.body_parentid[body];
  return body == ancestor;
}

/// The leg whose thigh or shank a body belongs to; −1 for the torso.
int leg_of(const mjModel& model, const PerLeg<int>& thigh_body, int body) {
  for (const Leg leg : thigh_body.legs()) {
    if (is_below(model, body, thigh_body[index(leg)])) return static_cast<int>(leg);
  }
  return -1;
}

void find_joints(const mjModel& model, const model::RobotDescription& description,
                 RobotParts& parts) {
  for (const std::string& name : description.joint_names()) {
    const int joint = found(model, mjOBJ_JOINT, name);
    parts.qpos.push_back(model.jnt_qposadr[joint]);
    parts.dof.push_back(model.jnt_dofadr[joint]);
    parts.actuator.push_back(found(model, mjOBJ_ACTUATOR, name));
  }
}

void find_owners(const mjModel& model, const model::RobotDescription& description,
                 RobotParts& parts) {
  PerLeg<int> thigh_body(description.num_legs(), -1);
  for (const Leg leg : thigh_body.legs()) {
    const std::vector<std::string>& joints = description.legs[index(leg)].joints;
    const std::string& thigh = joints[std::min<std::size_t>(1, joints.size() - 1)];
    thigh_body[index(leg)] = model.jnt_bodyid[found(model, mjOBJ_JOINT, thigh)];
  }
  for (int geom = 0; geom < model.ngeom; ++geom) {
    GeomOwner owner;
    if (model.geom_group[geom] != kTerrainGroup) {
      owner.leg = leg_of(model, thigh_body, model.geom_bodyid[geom]);
      owner.part = owner.leg < 0 ? Part::torso : Part::leg;
    }
    parts.owner.push_back(owner);
  }
  for (const Leg leg : parts.foot_geom.legs()) {
    parts.owner[static_cast<std::size_t>(parts.foot_geom[index(leg)])].part = Part::foot;
  }
}

}  // namespace

std::string foot_geom_name(Leg leg, int num_legs) {
  return std::string(leg_name(leg, num_legs)) + (num_legs < kNumLegs ? "_sole" : "_foot_sphere");
}

RobotParts find_parts(const mjModel& model, const model::RobotDescription& description) {
  RobotParts parts;
  parts.base_body = found(model, mjOBJ_BODY, description.base_link);
  parts.base_qpos = model.jnt_qposadr[model.body_jntadr[parts.base_body]];
  parts.base_dof = model.jnt_dofadr[model.body_jntadr[parts.base_body]];
  const int num_legs = description.num_legs();
  parts.num_leg_joints = description.num_leg_joints();
  parts.foot_geom.resize(num_legs);
  parts.foot_body.resize(num_legs);
  for (const Leg leg : parts.foot_geom.legs()) {
    const int geom = found(model, mjOBJ_GEOM, foot_geom_name(leg, num_legs));
    parts.foot_geom[index(leg)] = geom;
    parts.foot_body[index(leg)] = model.geom_bodyid[geom];
  }
  for (const model::ArmDescription& arm : description.arms) {
    parts.tip_body.push_back(found(model, mjOBJ_BODY, arm.tip_frame));
  }
  find_joints(model, description, parts);
  find_owners(model, description, parts);
  return parts;
}

}  // namespace surefoot::simulation
