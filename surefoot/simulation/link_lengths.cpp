#include "surefoot/simulation/link_lengths.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/simulation/text.hpp"
#include "surefoot/simulation/urdf_spec.hpp"

#include <vector>

namespace surefoot::simulation {

namespace {

Vec3 position_of(const mjsBody& body) { return {body.pos[0], body.pos[1], body.pos[2]}; }

Quat orientation_of(const mjsBody& body) {
  return {body.quat[0], body.quat[1], body.quat[2], body.quat[3]};
}

/// The bodies below `link` down to `end`, inclusive.
std::vector<mjsBody*> way(mjsBody& link, mjsBody& end) {
  std::vector<mjsBody*> bodies;
  for (mjsBody* body = &end; body != &link; body = mjs_getParent(body->element)) {
    bodies.insert(bodies.begin(), body);
  }
  return bodies;
}

Vec3 axis_of(mjsBody& link) {
  const mjsJoint& joint = *mjs_asJoint(mjs_firstChild(&link, mjOBJ_JOINT, 0));
  return Vec3(joint.axis[0], joint.axis[1], joint.axis[2]).normalized();
}

/// Moves all bodies fixed to the link, with their collision shapes, so that `point` of the body
/// `end` is further from the link's axis.
void lengthen(mjsBody& link, mjsBody& end, const Vec3& point, double offset) {
  if (offset == 0.0) return;
  const std::vector<mjsBody*> bodies = way(link, end);
  if (bodies.empty()) {
    throw Error(text("link \"", name_of(link.element),
                     "\" has no fixed link before its end, so its ", "length can't be changed"));
  }
  Quat q_link_body = Quat::Identity();
  Vec3 p_link = Vec3::Zero();  // of the point
  for (mjsBody* body : bodies) {
    p_link += q_link_body * position_of(*body);
    q_link_body = q_link_body * orientation_of(*body);
  }
  p_link += q_link_body * point;
  const Vec3 axis = axis_of(link);
  const Vec3 away = (p_link - axis * axis.dot(p_link)).normalized();
  for (int i = 0; i < 3; ++i) bodies.front()->pos[i] += offset * away[i];
}

}  // namespace

void change_link_lengths(mjSpec& spec, const model::RobotDescription& description,
                         const DisturbanceOptions& options) {
  if (!description.can_walk()) return;
  for (const Leg leg : description.legs.legs()) {
    const model::LegDescription& names = description.legs[index(leg)];
    mjsBody& thigh = find_body(spec, names.thigh_link, "thigh link");
    mjsBody& shank = find_body(spec, names.shank_link, "shank link");
    mjsBody& foot = find_body(spec, names.foot_frame, "foot frame");
    lengthen(thigh, shank, Vec3::Zero(), options.thigh_length_offset[index(leg)]);
    lengthen(shank, foot, names.foot_center, options.shank_length_offset[index(leg)]);
  }
}

}  // namespace surefoot::simulation
