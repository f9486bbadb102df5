#include "surefoot/model/robot_model.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/model/body_tree.hpp"

#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <algorithm>
#include <utility>

namespace surefoot::model {
namespace {

/// Pinocchio's precompiled algorithms match only this argument type; any other costs a minute of
/// compilation.
using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

// The root is a translation (rate: v_WB in W), then a ball joint (rate: w_WB_B in B), and the
// joints follow. So Pinocchio's velocity is our u of Eq. (1), if not in our order: see `columns`.
constexpr pinocchio::JointIndex kTranslationJoint = 1;
constexpr pinocchio::JointIndex kBaseJoint = 2;

pinocchio::Inertia to_pinocchio(const Inertia& inertia) {
  return {inertia.mass, inertia.com, inertia.about_com};
}

pinocchio::JointModel revolute(const Vec3& axis) {
  if (axis == Vec3::UnitX()) return pinocchio::JointModelRX();
  if (axis == Vec3::UnitY()) return pinocchio::JointModelRY();
  if (axis == Vec3::UnitZ()) return pinocchio::JointModelRZ();
  return pinocchio::JointModelRevoluteUnaligned(axis);
}

/// Adds the bodies on `parent`, each followed by those on it, as Pinocchio's algorithms ask.
/// `joints`: by body.
void add_bodies(const BodyTree& tree, int parent, pinocchio::Model& model,
                std::vector<pinocchio::JointIndex>& joints) {
  for (std::size_t i = 0; i < tree.limb_bodies.size(); ++i) {
    const LimbBody& body = tree.limb_bodies[i];
    if (body.parent != parent) continue;
    const Hinge& hinge = body.hinge;
    joints[i + 1] = model.addJoint(joints[static_cast<std::size_t>(parent)], revolute(hinge.axis),
                                   pinocchio::SE3(hinge.R, hinge.p), "joint_" + std::to_string(i));
    model.appendBodyToJoint(joints[i + 1], to_pinocchio(body.inertia), pinocchio::SE3::Identity());
    add_bodies(tree, static_cast<int>(i) + 1, model, joints);
  }
}

pinocchio::Model make_pinocchio_model(const BodyTree& tree,
                                      std::vector<pinocchio::JointIndex>& joints) {
  using pinocchio::SE3;
  pinocchio::Model model;
  model.gravity.linear(Vec3(0.0, 0.0, -kGravity));
  model.addJoint(0, pinocchio::JointModelTranslation(), SE3::Identity(), "base_position");
  model.addJoint(kTranslationJoint, pinocchio::JointModelSpherical(), SE3::Identity(),
                 "base_orientation");
  model.appendBodyToJoint(kBaseJoint, to_pinocchio(tree.base), SE3::Identity());
  joints.assign(tree.limb_bodies.size() + 1, kBaseJoint);
  add_bodies(tree, 0, model, joints);
  return model;
}

}  // namespace

struct RobotModel::Implementation {
  Implementation(RobotDescription robot, const Urdf& urdf)
      : description(std::move(robot)),
        notes(urdf.notes),
        tree(make_body_tree(description, urdf)),
        model(make_pinocchio_model(tree, joints)),
        data(model),
        q(Eigen::VectorXd::Zero(model.nq)),
        u(Eigen::VectorXd::Zero(model.nv)),
        zero(Eigen::VectorXd::Zero(model.nv)),
        dynamics(description.num_joints(), tree.arm_tips.size(), description.num_legs()) {
    dynamics.scale = description.scale;
    dynamics.sole = 0.5 * description.sole;
    further_joints.resize(description.num_legs());
    for (const Leg leg : dynamics.leg_joints.legs()) {
      dynamics.leg_joints[index(leg)] = description.leg_joints(leg);
      further_joints[index(leg)] = description.further_joints(leg);
    }
    for (Eigen::Index i = 0; i < 6; ++i) columns.push_back(i);
    for (std::size_t i = 1; i < joints.size(); ++i)
      columns.push_back(5 + static_cast<Eigen::Index>(joints[i] - kBaseJoint));
    is_in_order = std::ranges::is_sorted(columns);
    // These blocks stay constant; update() writes the others.
    dynamics.base.J.leftCols<3>().setIdentity();
    for (const Leg leg : tree.feet.legs()) {
      for (PointKinematics* point : {&dynamics.hip[index(leg)], &dynamics.foot[index(leg)]}) {
        point->J.leftCols<3>().setIdentity();
      }
    }
    for (FrameKinematics& tip : dynamics.arm_tips) tip.point.J.leftCols<3>().setIdentity();
    feet = tree.feet;
    bare_base = model.inertias[kBaseJoint];
    for (std::size_t i = 0; i < tree.limb_bodies.size(); ++i)
      dynamics.bodies[i + 1].parent = tree.limb_bodies[i].parent;
    // The rest posture's crba gives the mass.
    q[6] = 1.0;
    update_dynamics();
  }

  void set_base_load(const BaseLoad& load) {
    pinocchio::Inertia& base = model.inertias[kBaseJoint];
    base.mass() = bare_base.mass() + load.mass;
    base.lever() = (bare_base.mass() * bare_base.lever() + load.first_moment) / base.mass();
  }

  /// What lies behind the HFE and the KFE moves away from them.
  void set_leg_lengths(const KinematicErrors& legs) {
    for (const Leg leg : tree.legs.legs()) {
      const auto& [bodies, chain] = tree.legs[index(leg)];
      move_behind(leg, 1, legs.thigh[index(leg)] * chain.along_thigh());
      move_behind(leg, 2, legs.shank[index(leg)] * chain.along_shank());
    }
  }

  /// Moves the next body behind a leg's joint, or its foot.
  void move_behind(Leg leg, int joint, const Vec3& way) {
    const std::vector<int>& bodies = tree.legs[index(leg)].bodies;
    const auto next = std::ranges::find(bodies, 1 + first_joint(leg) + joint) + 1;
    if (next == bodies.end()) {
      feet[index(leg)].p = tree.feet[index(leg)].p + way;
    } else {
      const auto body = static_cast<std::size_t>(*next);
      model.jointPlacements[joints[body]].translation() = tree.limb_bodies[body - 1].hinge.p + way;
    }
  }

  void set_state(const RobotState& state) {
    const Quat q_WB = state.q_WB.normalized();
    q.head<7>() << state.p_WB, q_WB.x(), q_WB.y(), q_WB.z(), q_WB.w();
    dynamics.q = state.q;
    dynamics.u << state.v_WB, state.w_WB_B, state.qd;
    for (std::size_t i = 0; i < columns.size(); ++i)
      u[columns[i]] = dynamics.u[static_cast<Eigen::Index>(i)];
    for (Eigen::Index j = 0; j < state.q.size(); ++j) q[1 + column_of(j + 1)] = state.q[j];
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
    if (is_in_order) {
      dynamics.M = data.M.selfadjointView<Eigen::Upper>();
      dynamics.h = data.nle;
    } else {
      put_in_order();
    }
    update_base();
    update_com();
  }

  void put_in_order() {
    const auto n = static_cast<Eigen::Index>(columns.size());
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index row = columns[static_cast<std::size_t>(i)];
      dynamics.h[i] = data.nle[row];
      for (Eigen::Index j = 0; j < n; ++j) {
        const Eigen::Index column = columns[static_cast<std::size_t>(j)];
        dynamics.M(i, j) = data.M(std::min(row, column), std::max(row, column));
      }
    }
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
    dynamics.com.v = product(dynamics.com.J, dynamics.u);
    dynamics.com.Jdot_u = dynamics.h.head<3>() / dynamics.mass - kGravity * Vec3::UnitZ();
  }

  /// Pinocchio's column of the joint that a body is behind.
  [[nodiscard]] Eigen::Index column_of(Eigen::Index body) const {
    return columns[static_cast<std::size_t>(5 + body)];
  }

  /// Calls `update(column, Pinocchio's twist of it)` for each joint that moves a body.
  template <typename Update>
  void for_joints_of(int body, const Update& update) const {
    for (int on = body; on > 0; on = tree.limb_bodies[static_cast<std::size_t>(on - 1)].parent)
      update(5 + on, data.J.col(column_of(on)));
  }

  /// The Jacobian's columns of joints that do not move it stay as they are.
  void update_point(const BodyFrame& frame, PointKinematics& point) const {
    const pinocchio::JointIndex body = joints[static_cast<std::size_t>(frame.body)];
    const Vec3& offset = frame.p;
    const Mat3& R = data.oMi[body].rotation();
    const Vec3 v = data.v[body].linear() + data.v[body].angular().cross(offset);
    point.p = data.oMi[body].translation() + R * offset;
    point.v = R * v;
    // Classical acceleration: spatial acceleration at the point, plus ω × v.
    point.Jdot_u = R * (data.a[body].linear() + data.a[body].angular().cross(offset) +
                        data.v[body].angular().cross(v));
    point.J.middleCols<3>(3) = -skew(point.p - dynamics.base.p) * data.oMi[kBaseJoint].rotation();
    for_joints_of(frame.body, [&point](Eigen::Index column, const auto& twist) {
      point.J.col(column) =
          twist.template head<3>() + Vec3(twist.template tail<3>()).cross(point.p);
    });
  }

  void update_rotation(const BodyFrame& frame, RotationKinematics& rotation) const {
    const pinocchio::JointIndex body = joints[static_cast<std::size_t>(frame.body)];
    const Mat3& R = data.oMi[body].rotation();
    rotation.R = R * frame.R;
    rotation.w = R * data.v[body].angular();
    rotation.Jdot_u = R * data.a[body].angular();
    rotation.J.middleCols<3>(3) = data.oMi[kBaseJoint].rotation();
    for_joints_of(frame.body, [&rotation](Eigen::Index column, const auto& twist) {
      rotation.J.col(column) = twist.template tail<3>();
    });
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
    const JointRange& further = further_joints[index(leg)];
    for (int j = 0; j < further.count; ++j) {
      const Eigen::Index column = 6 + further.first + j;
      contact.J.col(column) += Vec3(shank.J.col(column)).cross(lever);
    }
    contact.Jdot_u = foot.Jdot_u + shank.Jdot_u.cross(lever);
  }

  /// Bodies behind further joints belong to the link before them.
  void update_links(Leg leg) {
    LegLinks& links = dynamics.links[index(leg)];
    links = LegLinks();
    const int first = 1 + first_joint(leg);
    int l = -1;
    for (const int behind : tree.legs[index(leg)].bodies) {
      if (behind == first + l + 1) ++l;
      if (l < 0) continue;
      const pinocchio::JointIndex body = joints[static_cast<std::size_t>(behind)];
      const pinocchio::Inertia& inertia = model.inertias[body];
      const pinocchio::Force momentum = data.oMi[body].act(inertia * data.v[body]);
      const Vec3 weight(0.0, 0.0, -kGravity * inertia.mass());
      const pinocchio::Force pull(weight, data.oMi[body].act(inertia.lever()).cross(weight));
      for (int j = 0; j <= l; ++j) {
        const pinocchio::JointIndex hinge = joints[static_cast<std::size_t>(first + j)];
        const pinocchio::Motion axis(data.J.col(column_of(first + j)));
        const pinocchio::Motion turning = data.oMi[hinge].act(data.v[hinge]);
        links.momentum(j, l) += axis.dot(momentum);
        links.free_rate(j, l) += turning.cross(axis).dot(momentum) + axis.dot(pull);
      }
    }
  }

  void update_bodies() {
    for (std::size_t i = 0; i < dynamics.bodies.size(); ++i) {
      const pinocchio::JointIndex joint = joints[i];
      const pinocchio::Motion &velocity = data.v[joint], &acceleration = data.a[joint];
      BodyKinematics& body = dynamics.bodies[i];
      body.R = data.oMi[joint].rotation();
      body.p = data.oMi[joint].translation();
      body.v = body.R * velocity.linear();
      body.w = body.R * velocity.angular();
      body.a = body.R * (acceleration.linear() + velocity.angular().cross(velocity.linear()));
      body.wdot = body.R * acceleration.angular();
      if (i > 0) body.axis = data.J.col(column_of(static_cast<Eigen::Index>(i))).tail<3>();
    }
  }

  void update_tips() {
    for (std::size_t i = 0; i < tree.arm_tips.size(); ++i) {
      update_point(tree.arm_tips[i], dynamics.arm_tips[i].point);
      update_rotation(tree.arm_tips[i], dynamics.arm_tips[i].rotation);
    }
  }

  void update_leg(Leg leg, const Vec3& normal) {
    const std::size_t k = index(leg);
    update_point(tree.hips[k], dynamics.hip[k]);
    update_point(feet[k], dynamics.foot[k]);
    update_rotation(feet[k], dynamics.shank[k]);
    if (dynamics.has_flat_feet()) {
      dynamics.contact[k] = dynamics.foot[k];
      return;
    }
    update_contact(leg, normal);
    update_links(leg);
  }

  const RobotDescription description;
  const std::vector<std::string> notes;
  const BodyTree tree;
  std::vector<pinocchio::JointIndex> joints;  // by body
  pinocchio::Model model;
  pinocchio::Data data;
  std::vector<Eigen::Index> columns;  // of Pinocchio's vectors, by ours
  bool is_in_order = true;            // all columns are the same
  PerLeg<BodyFrame> feet;             // with the estimated lengths
  PerLeg<JointRange> further_joints;
  pinocchio::Inertia bare_base;  // without payload
  Eigen::VectorXd q;             // p_WB, q_WB (x y z w), joints
  Eigen::VectorXd u;
  const Eigen::VectorXd zero;
  Dynamics dynamics;
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
  for (const Leg leg : implementation_->feet.legs())
    implementation_->update_leg(leg, terrain_normal_W);
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
