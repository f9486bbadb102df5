#include "surefoot/model/robot_model.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/model/body_tree.hpp"

#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <utility>

namespace surefoot::model {
namespace {

/// Pinocchio's precompiled algorithms match only this argument type; any other costs a minute of
/// compilation.
using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

// The root is a translation (rate: v_WB in W), then a ball joint (rate: w_WB_B in B), and the legs
// follow in our order. So Pinocchio's velocity is our u of Eq. (1), without any transformation.
constexpr pinocchio::JointIndex kTranslationJoint = 1;
constexpr pinocchio::JointIndex kBaseJoint = 2;

pinocchio::JointIndex joint_index(Leg leg, int joint) {
  return kBaseJoint + 1 + static_cast<pinocchio::JointIndex>(first_joint(leg) + joint);
}

pinocchio::Inertia to_pinocchio(const Inertia& inertia) {
  return {inertia.mass, inertia.com, inertia.about_com};
}

pinocchio::JointModel revolute(const Vec3& axis) {
  if (axis == Vec3::UnitX()) return pinocchio::JointModelRX();
  if (axis == Vec3::UnitY()) return pinocchio::JointModelRY();
  if (axis == Vec3::UnitZ()) return pinocchio::JointModelRZ();
  return pinocchio::JointModelRevoluteUnaligned(axis);
}

pinocchio::Model make_pinocchio_model(const BodyTree& tree) {
  using pinocchio::SE3;
  pinocchio::Model model;
  model.gravity.linear(Vec3(0.0, 0.0, -kGravity));
  model.addJoint(0, pinocchio::JointModelTranslation(), SE3::Identity(), "base_position");
  model.addJoint(kTranslationJoint, pinocchio::JointModelSpherical(), SE3::Identity(),
                 "base_orientation");
  model.appendBodyToJoint(kBaseJoint, to_pinocchio(tree.base), SE3::Identity());
  for (const Leg leg : tree.legs.legs()) {
    const LegTree& parts = tree.legs[index(leg)];
    pinocchio::JointIndex parent = kBaseJoint;
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      const Hinge& hinge = parts.chain.hinges[j];
      const std::string name = leg_joint_name(first_joint(leg) + static_cast<int>(j),
                                              static_cast<int>(tree.legs.size()));
      parent = model.addJoint(parent, revolute(hinge.axis), SE3(hinge.R, hinge.p), name);
      model.appendBodyToJoint(parent, to_pinocchio(parts.inertias[j]), SE3::Identity());
    }
  }
  for (const LimbBody& body : tree.limb_bodies) {
    const Hinge& hinge = body.hinge;
    const pinocchio::JointIndex joint = model.addJoint(
        kBaseJoint + static_cast<pinocchio::JointIndex>(body.parent), revolute(hinge.axis),
        SE3(hinge.R, hinge.p), "limb_" + std::to_string(model.njoints));
    model.appendBodyToJoint(joint, to_pinocchio(body.inertia), SE3::Identity());
  }
  return model;
}

}  // namespace

struct RobotModel::Implementation {
  Implementation(RobotDescription robot, const Urdf& urdf)
      : description(std::move(robot)),
        notes(urdf.notes),
        tree(make_body_tree(description, urdf)),
        model(make_pinocchio_model(tree)),
        data(model),
        q(Eigen::VectorXd::Zero(model.nq)),
        u(Eigen::VectorXd::Zero(model.nv)),
        zero(Eigen::VectorXd::Zero(model.nv)),
        dynamics(description.num_joints(), tree.arm_tips.size(), description.num_legs()) {
    dynamics.scale = description.scale;
    dynamics.sole = 0.5 * description.sole;
    for (const Leg leg : dynamics.leg_joints.legs())
      dynamics.leg_joints[index(leg)] = description.leg_joints(leg);
    // These blocks stay constant; update() writes the others.
    dynamics.base.J.leftCols<3>().setIdentity();
    for (const Leg leg : tree.legs.legs()) {
      for (PointKinematics* point : {&dynamics.hip[index(leg)], &dynamics.foot[index(leg)]}) {
        point->J.leftCols<3>().setIdentity();
      }
    }
    for (FrameKinematics& tip : dynamics.arm_tips) tip.point.J.leftCols<3>().setIdentity();
    between.point.J = dynamics.base.J;
    between.rotation.J.setZero(3, model.nv);
    chains.resize(static_cast<int>(tree.legs.size()));
    set_leg_lengths(no_errors(static_cast<int>(tree.legs.size())));
    bare_base = model.inertias[kBaseJoint];
    for (std::size_t i = 1; i < dynamics.bodies.size(); ++i)
      dynamics.bodies[i].parent = static_cast<int>(model.parents[kBaseJoint + i] - kBaseJoint);
    // The rest posture's crba gives the mass.
    q[6] = 1.0;
    update_dynamics();
  }

  void set_base_load(const BaseLoad& load) {
    pinocchio::Inertia& base = model.inertias[kBaseJoint];
    base.mass() = bare_base.mass() + load.mass;
    base.lever() = (bare_base.mass() * bare_base.lever() + load.first_moment) / base.mass();
  }

  void set_leg_lengths(const KinematicErrors& legs) {
    for (const Leg leg : chains.legs()) {
      const std::size_t k = index(leg);
      chains[k] = tree.legs[k].chain.lengthened(legs.thigh[k], legs.shank[k]);
      model.jointPlacements[joint_index(leg, 2)].translation() = chains[k].hinges[2].p;
    }
  }

  void set_state(const RobotState& state) {
    const Quat q_WB = state.q_WB.normalized();
    q << state.p_WB, q_WB.x(), q_WB.y(), q_WB.z(), q_WB.w(), state.q;
    u << state.v_WB, state.w_WB_B, state.qd;
    dynamics.q = state.q;
    dynamics.u = u;
  }

  void run_algorithms() {
    const ConstVector position(q);
    const ConstVector velocity(u);
    const ConstVector no_acceleration(zero);
    pinocchio::crba(model, data, position);
    pinocchio::nonLinearEffects(model, data, position, velocity);
    pinocchio::forwardKinematics(model, data, position, velocity, no_acceleration);
    pinocchio::computeJointJacobians(model, data);
  }

  void update_dynamics() {
    run_algorithms();
    dynamics.M = data.M.selfadjointView<Eigen::Upper>();
    dynamics.h = data.nle;
    update_base();
    update_com();
  }

  void update_base() {
    const Mat3& R_WB = data.oMi[kBaseJoint].rotation();
    dynamics.base.p = q.head<3>();
    dynamics.base.v = u.head<3>();
    dynamics.base_rotation.R = R_WB;
    dynamics.base_rotation.w = R_WB * u.segment<3>(3);
    dynamics.base_rotation.J.middleCols<3>(3) = R_WB;
  }

  /// The first three rows of the equations of motion are those of the whole mass: m a_com = Σ f.
  void update_com() {
    const pinocchio::Inertia& whole = data.Ycrb[kTranslationJoint];
    dynamics.mass = whole.mass();
    dynamics.com.p = dynamics.base.p + whole.lever();
    dynamics.com.J = dynamics.M.topRows<3>() / dynamics.mass;
    dynamics.com.v = product(dynamics.com.J, u);
    dynamics.com.Jdot_u = dynamics.h.head<3>() / dynamics.mass - kGravity * Vec3::UnitZ();
  }

  /// A point at `offset` in a body's frame; the Jacobian's columns of joints stay as they are.
  void update_point(pinocchio::JointIndex body, const Vec3& offset, PointKinematics& point) const {
    const Mat3& R = data.oMi[body].rotation();
    const Vec3 v = data.v[body].linear() + data.v[body].angular().cross(offset);
    point.p = data.oMi[body].translation() + R * offset;
    point.v = R * v;
    // Classical acceleration: spatial acceleration at the point, plus ω × v.
    point.Jdot_u = R * (data.a[body].linear() + data.a[body].angular().cross(offset) +
                        data.v[body].angular().cross(v));
    point.J.middleCols<3>(3) = -skew(point.p - dynamics.base.p) * data.oMi[kBaseJoint].rotation();
  }

  void update_column(Eigen::Index column, PointKinematics& point) const {
    const auto twist = data.J.col(column);  // linear part: at W's origin
    point.J.col(column) = twist.head<3>() + Vec3(twist.tail<3>()).cross(point.p);
  }

  void update_point(Leg leg, int joint, const Vec3& offset, PointKinematics& point) const {
    update_point(joint_index(leg, joint), offset, point);
    for (int j = 0; j <= joint; ++j) update_column(6 + first_joint(leg) + j, point);
  }

  void update_tip(const BodyFrame& frame, FrameKinematics& tip) const {
    const pinocchio::JointIndex body = kBaseJoint + static_cast<pinocchio::JointIndex>(frame.body);
    update_point(body, frame.p, tip.point);
    const Mat3& R = data.oMi[body].rotation();
    tip.rotation.R = R * frame.R;
    tip.rotation.w = R * data.v[body].angular();
    tip.rotation.Jdot_u = R * data.a[body].angular();
    tip.rotation.J.middleCols<3>(3) = data.oMi[kBaseJoint].rotation();
    for (pinocchio::JointIndex on = body; on > kBaseJoint; on = model.parents[on]) {
      const auto column = static_cast<Eigen::Index>(on - kBaseJoint) + 5;
      update_column(column, tip.point);
      tip.rotation.J.col(column) = data.J.col(column).tail<3>();
    }
  }

  void update_shank(Leg leg, RotationKinematics& shank) const {
    const pinocchio::JointIndex body = joint_index(leg, 2);
    const Mat3& R = data.oMi[body].rotation();
    shank.R = R * tree.legs[index(leg)].R_shank;
    shank.w = R * data.v[body].angular();
    shank.Jdot_u = R * data.a[body].angular();
    shank.J.middleCols<3>(3) = data.oMi[kBaseJoint].rotation();
    shank.J.middleCols<3>(6 + first_joint(leg)) = data.J.block<3, 3>(3, 6 + first_joint(leg));
  }

  /// Moves from the sphere's centre to its lowest point by the lever −r n, constant along n. The
  /// centripetal part is missing, because the contact point wanders over the rolling sphere.
  void update_contact(Leg leg, const Vec3& normal) {
    const PointKinematics& foot = dynamics.foot[index(leg)];
    const RotationKinematics& shank = dynamics.shank[index(leg)];
    PointKinematics& contact = dynamics.contact[index(leg)];
    const Vec3 lever = -description.legs[index(leg)].foot_radius * normal;
    contact.p = foot.p + lever;
    contact.v = foot.v + shank.w.cross(lever);
    contact.J = foot.J;
    contact.J.middleCols<3>(3) -= skew(lever) * shank.J.middleCols<3>(3);
    contact.J.middleCols<3>(6 + first_joint(leg)) -=
        skew(lever) * shank.J.middleCols<3>(6 + first_joint(leg));
    contact.Jdot_u = foot.Jdot_u + shank.Jdot_u.cross(lever);
  }

  void update_links(Leg leg) {
    LegLinks& links = dynamics.links[index(leg)];
    for (int l = 0; l < kJointsPerLeg; ++l) {
      const pinocchio::JointIndex body = joint_index(leg, l);
      const pinocchio::Inertia& inertia = model.inertias[body];
      const pinocchio::Force momentum = data.oMi[body].act(inertia * data.v[body]);
      const Vec3 weight(0.0, 0.0, -kGravity * inertia.mass());
      const pinocchio::Force pull(weight, data.oMi[body].act(inertia.lever()).cross(weight));
      for (int j = 0; j <= l; ++j) {
        const pinocchio::JointIndex hinge = joint_index(leg, j);
        const pinocchio::Motion axis(data.J.col(6 + first_joint(leg) + j));
        const pinocchio::Motion turning = data.oMi[hinge].act(data.v[hinge]);
        links.momentum(j, l) = axis.dot(momentum);
        links.free_rate(j, l) = turning.cross(axis).dot(momentum) + axis.dot(pull);
      }
    }
  }

  void update_bodies() {
    for (std::size_t i = 0; i < dynamics.bodies.size(); ++i) {
      const pinocchio::JointIndex joint = kBaseJoint + i;
      const pinocchio::Motion &velocity = data.v[joint], &acceleration = data.a[joint];
      BodyKinematics& body = dynamics.bodies[i];
      body.R = data.oMi[joint].rotation();
      body.p = data.oMi[joint].translation();
      body.v = body.R * velocity.linear();
      body.w = body.R * velocity.angular();
      body.a = body.R * (acceleration.linear() + velocity.angular().cross(velocity.linear()));
      body.wdot = body.R * acceleration.angular();
      if (i > 0) body.axis = data.J.col(static_cast<Eigen::Index>(5 + i)).tail<3>();
    }
  }

  void update_tips() {
    for (std::size_t i = 0; i < tree.arm_tips.size(); ++i) {
      update_tip(tree.arm_tips[i], dynamics.arm_tips[i]);
    }
  }

  /// Of a leg without closed forms, with a flat foot.
  void update_sole(Leg leg) {
    const std::size_t k = index(leg);
    update_tip(tree.hips[k], between);
    dynamics.hip[k] = between.point;
    between.point.J.rightCols(model.nv - 6).setZero();
    between.rotation.J.rightCols(model.nv - 6).setZero();
    update_tip(tree.soles[k], between);
    dynamics.foot[k] = dynamics.contact[k] = between.point;
    dynamics.shank[k] = between.rotation;
    between.point.J.rightCols(model.nv - 6).setZero();
    between.rotation.J.rightCols(model.nv - 6).setZero();
  }

  void update_leg(Leg leg, const Vec3& normal) {
    const LegChain& chain = chains[index(leg)];
    update_point(leg, chain.hip_hinge, chain.hip, dynamics.hip[index(leg)]);
    update_point(leg, 2, chain.foot, dynamics.foot[index(leg)]);
    update_shank(leg, dynamics.shank[index(leg)]);
    update_contact(leg, normal);
    update_links(leg);
  }

  const RobotDescription description;
  const std::vector<std::string> notes;
  const BodyTree tree;
  pinocchio::Model model;
  pinocchio::Data data;
  PerLeg<LegChain> chains;       // with the estimated lengths
  pinocchio::Inertia bare_base;  // without payload
  Eigen::VectorXd q;             // p_WB, q_WB (x y z w), joints
  Eigen::VectorXd u;
  const Eigen::VectorXd zero;
  Dynamics dynamics;
  FrameKinematics between;  // of `update_sole`, with the columns of joints 0 between two frames
};

RobotModel::RobotModel(RobotDescription description) {
  const Urdf urdf = read_urdf(description);
  implementation_ = std::make_unique<Implementation>(std::move(description), urdf);
}

RobotModel::~RobotModel() = default;
RobotModel::RobotModel(RobotModel&&) noexcept = default;
RobotModel& RobotModel::operator=(RobotModel&&) noexcept = default;

const Dynamics& RobotModel::update(const RobotState& state, const Vec3& terrain_normal_W) noexcept {
  implementation_->set_state(state);
  implementation_->update_dynamics();
  for (const Leg leg : implementation_->chains.legs())
    implementation_->update_leg(leg, terrain_normal_W);
  for (const Leg leg : implementation_->tree.soles.legs()) implementation_->update_sole(leg);
  implementation_->update_tips();
  implementation_->update_bodies();
  return implementation_->dynamics;
}

void RobotModel::set_leg_lengths(const KinematicErrors& legs) noexcept {
  implementation_->set_leg_lengths(legs);
}

void RobotModel::set_base_load(const BaseLoad& load) noexcept {
  implementation_->set_base_load(load);
}

void RobotModel::apply_wrench(const Vec3& force, const Vec3& moment) noexcept {
  Dynamics& dynamics = implementation_->dynamics;
  const Vec3 lever = dynamics.com.p - dynamics.base.p;
  const Vec3 about_base = moment + lever.cross(force);
  dynamics.h.head<3>() -= force;
  dynamics.h.segment<3>(3) -= dynamics.base_rotation.R.transpose() * about_base;
}

const Dynamics& RobotModel::dynamics() const { return implementation_->dynamics; }
const RobotDescription& RobotModel::description() const { return implementation_->description; }
double RobotModel::mass() const { return implementation_->dynamics.mass; }
double RobotModel::base_mass() const { return implementation_->bare_base.mass(); }
const std::vector<std::string>& RobotModel::notes() const { return implementation_->notes; }

Vec3 RobotModel::foot_in_base(Leg leg, const Vec3& q_leg) const noexcept {
  return implementation_->tree.legs[index(leg)].chain.foot_in_base(q_leg);
}

Vec3 RobotModel::hip_in_base(Leg leg, const Vec3& q_leg) const noexcept {
  return implementation_->tree.legs[index(leg)].chain.hip_in_base(q_leg);
}

bool RobotModel::inverse_kinematics(Leg leg, const Vec3& p_BF, const Vec3& guess,
                                    Vec3& q_leg) const noexcept {
  return implementation_->tree.legs[index(leg)].chain.inverse_kinematics(p_BF, guess, q_leg);
}

}  // namespace surefoot::model
