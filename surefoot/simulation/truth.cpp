#include "surefoot/simulation/truth.hpp"

#include <algorithm>

namespace surefoot::simulation {

namespace {

using ConstVec3 = Eigen::Map<const Vec3>;

Vec3 vec3(const mjtNum* values) { return ConstVec3(values); }

/// Sums over the contacts of one foot, weighted by force.
struct FootSum {
  Vec3 normal = Vec3::Zero();
  Vec3 point = Vec3::Zero();
  double weight = 0.0;
  double largest = -1.0;
};

const GeomOwner& owner_of(const RobotParts& parts, int geom) {
  return parts.owner[static_cast<std::size_t>(geom)];
}

/// The leg whose foot touches the terrain at this contact; −1: none.
int foot_on_terrain(const mjContact& contact, const RobotParts& parts) {
  const GeomOwner& first = owner_of(parts, contact.geom[0]);
  const GeomOwner& second = owner_of(parts, contact.geom[1]);
  if ((first.part == Part::terrain) == (second.part == Part::terrain)) return -1;
  const GeomOwner& owner = first.part == Part::terrain ? second : first;
  return owner.part == Part::foot ? owner.leg : -1;
}

/// Force on the second geom, in S.
Vec3 contact_force(const mjModel& model, const mjData& data, int id) {
  mjtNum force[6];
  mj_contactForce(&model, &data, id, force);
  const mjtNum* frame = data.contact[id].frame;
  return force[0] * vec3(frame) + force[1] * vec3(frame + 3) + force[2] * vec3(frame + 6);
}

void add_foot_contact(const mjContact& contact, const Vec3& force, double sign, TrueContact& foot,
                      FootSum& sum) {
  const Vec3 normal = sign * vec3(contact.frame);
  const double size = std::max(force.dot(normal), 1e-12);
  foot.touching = foot.touching || force.dot(normal) > 0.0;
  foot.force += force;
  foot.penetration = std::max(foot.penetration, -contact.dist);
  sum.normal += size * normal;
  sum.point += size * vec3(contact.pos);
  sum.weight += size;
  if (size > sum.largest) {
    sum.largest = size;
    foot.friction = contact.friction[0];
  }
}

void add_body_contact(const GeomOwner& owner, bool with_terrain, double force, GroundTruth& truth) {
  if (owner.part == Part::terrain || owner.part == Part::foot) return;
  truth.body_contact_force = std::max(truth.body_contact_force, force);
  if (!with_terrain) return;
  if (owner.part == Part::torso) truth.torso_contact = true;
  if (owner.part == Part::leg) truth.shank_contacts |= 1 << owner.leg;
}

Vec3 point_velocity(const mjModel& model, const mjData& data, int body, const Vec3& point) {
  mjtNum velocity[6];
  mj_objectVelocity(&model, &data, mjOBJ_XBODY, body, velocity, 0);
  const Vec3 arm = point - vec3(data.xpos + 3 * body);
  return vec3(velocity + 3) + vec3(velocity).cross(arm);
}

void finish_foot(const mjModel& model, const mjData& data, int body, const FootSum& sum,
                 TrueContact& foot) {
  if (sum.weight <= 0.0) return;
  foot.normal = sum.normal.normalized();
  foot.point = sum.point / sum.weight;
  const Vec3 velocity = point_velocity(model, data, body, foot.point);
  foot.slip_velocity = velocity - foot.normal.dot(velocity) * foot.normal;
}

void extract_contacts(const mjModel& model, const mjData& data, const RobotParts& parts,
                      GroundTruth& truth) {
  truth.feet = PerLeg<TrueContact>(static_cast<int>(parts.foot_geom.size()), TrueContact{});
  truth.body_contact_force = 0.0;
  truth.torso_contact = false;
  truth.shank_contacts = 0;
  PerLeg<FootSum> sums(static_cast<int>(parts.foot_geom.size()), FootSum{});
  for (int id = 0; id < data.ncon; ++id) {
    const mjContact& contact = data.contact[id];
    if (contact.efc_address < 0) continue;
    const GeomOwner& first = owner_of(parts, contact.geom[0]);
    const GeomOwner& second = owner_of(parts, contact.geom[1]);
    const bool with_terrain = first.part == Part::terrain || second.part == Part::terrain;
    const Vec3 force = contact_force(model, data, id);
    add_body_contact(first, with_terrain, force.norm(), truth);
    add_body_contact(second, with_terrain, force.norm(), truth);

    const int foot = foot_on_terrain(contact, parts);
    if (foot < 0) continue;
    const double sign = first.part == Part::terrain ? 1.0 : -1.0;  // they act on the second geom
    const auto leg = static_cast<std::size_t>(foot);
    add_foot_contact(contact, sign * force, sign, truth.feet[leg], sums[leg]);
  }
  for (std::size_t leg = 0; leg < sums.size(); ++leg) {
    finish_foot(model, data, parts.foot_body[leg], sums[leg], truth.feet[leg]);
  }
}

void extract_feet(const mjModel& model, const mjData& data, const RobotParts& parts,
                  GroundTruth& truth) {
  truth.p_SF.resize(static_cast<int>(parts.foot_geom.size()));
  truth.v_SF.resize(static_cast<int>(parts.foot_geom.size()));
  for (std::size_t leg = 0; leg < truth.p_SF.size(); ++leg) {
    const int geom = parts.foot_geom[leg];
    truth.p_SF[leg] = vec3(data.geom_xpos + 3 * geom);
    if (model.geom_type[geom] == mjGEOM_BOX) {  // its lower face is the sole
      const mjtNum* R = data.geom_xmat + 9 * geom;
      truth.p_SF[leg] -= model.geom_size[3 * geom + 2] * Vec3(R[2], R[5], R[8]);
    }
    truth.v_SF[leg] = point_velocity(model, data, parts.foot_body[leg], truth.p_SF[leg]);
  }
  truth.p_ST.clear();
  for (const int body : parts.tip_body) truth.p_ST.push_back(vec3(data.xpos + 3 * body));
}

}  // namespace

void note_touches(const mjModel& model, const mjData& data, const RobotParts& parts,
                  PerLeg<bool>& touched) noexcept {
  for (int id = 0; id < data.ncon; ++id) {
    const mjContact& contact = data.contact[id];
    if (contact.efc_address < 0) continue;
    const int leg = foot_on_terrain(contact, parts);
    if (leg < 0) continue;
    mjtNum force[6];
    mj_contactForce(&model, &data, id, force);
    if (force[0] > 0.0) touched[static_cast<std::size_t>(leg)] = true;
  }
}

JointVector joint_positions(const mjData& data, const RobotParts& parts) noexcept {
  JointVector q(parts.qpos.size());
  for (std::size_t i = 0; i < parts.qpos.size(); ++i) {
    q[static_cast<Eigen::Index>(i)] = data.qpos[parts.qpos[i]];
  }
  return q;
}

JointVector joint_velocities(const mjData& data, const RobotParts& parts) noexcept {
  JointVector qd(parts.dof.size());
  for (std::size_t i = 0; i < parts.dof.size(); ++i) {
    qd[static_cast<Eigen::Index>(i)] = data.qvel[parts.dof[i]];
  }
  return qd;
}

Quat base_orientation(const mjData& data, const RobotParts& parts) noexcept {
  const mjtNum* q = data.qpos + parts.base_qpos + 3;
  return {q[0], q[1], q[2], q[3]};
}

Vec3 base_velocity(const mjData& data, const RobotParts& parts) noexcept {
  return vec3(data.qvel + parts.base_dof);
}

void extract_truth(const mjModel& model, mjData& data, const RobotParts& parts,
                   GroundTruth& truth) noexcept {
  truth.p_SB = vec3(data.qpos + parts.base_qpos);
  truth.q_SB = base_orientation(data, parts);
  truth.v_SB = base_velocity(data, parts);
  truth.w_SB_B = vec3(data.qvel + parts.base_dof + 3);
  truth.q = joint_positions(data, parts);
  truth.qd = joint_velocities(data, parts);
  truth.torque.resize(truth.q.size());
  for (std::size_t i = 0; i < parts.dof.size(); ++i) {
    truth.torque[static_cast<Eigen::Index>(i)] = data.qfrc_actuator[parts.dof[i]];
  }
  mj_subtreeVel(&model, &data);
  truth.p_SCom = vec3(data.subtree_com + 3 * parts.base_body);
  truth.v_SCom = vec3(data.subtree_linvel + 3 * parts.base_body);
  extract_feet(model, data, parts, truth);
  extract_contacts(model, data, parts, truth);
  truth.qpos.assign(data.qpos, data.qpos + model.nq);
  truth.qvel.assign(data.qvel, data.qvel + model.nv);
  truth.ctrl.assign(data.ctrl, data.ctrl + model.nu);
  truth.xfrc_applied.assign(data.xfrc_applied, data.xfrc_applied + 6 * model.nbody);
}

}  // namespace surefoot::simulation
