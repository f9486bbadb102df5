#include "surefoot/simulation/stand_up.hpp"

#include "surefoot/model/leg_jacobian.hpp"
#include "surefoot/simulation/truth.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <vector>

namespace surefoot::simulation {
namespace {

constexpr double kStiffness = 1500.0;   // of the springs [N·m/rad]
constexpr double kDamping = 25.0;       // [N·m·s/rad]
constexpr double kMaxAirTime = 0.03;    // until a foot is lowered [s]
constexpr double kLoweringSpeed = 0.1;  // of a foot [m/s]
constexpr double kMaxLowering = 0.15;   // of a foot [m]
constexpr double kMaxDuration = 5.0;    // [s]
constexpr double kRestSpeed = 0.005;    // of the base [m/s]
constexpr double kRestRate = 0.02;      // of the joints [rad/s]
// Damping that acts in steps throws joints to and fro where it would stop them twice as fast as a
// step is long; stops and friction bear a little more.
constexpr double kUnstable = 2.5;

struct Foot {
  double in_the_air = 0.0;  // [s]
  double lowered = 0.0;     // [m]
};

bool touches(const mjData& data, int geom) {
  for (int id = 0; id < data.ncon; ++id) {
    const mjContact& contact = data.contact[id];
    if (contact.dist < 0.0 && (contact.geom[0] == geom || contact.geom[1] == geom)) return true;
  }
  return false;
}

bool at_rest(const mjData& data, const RobotParts& parts, const Scale& scale) {
  return base_velocity(data, parts).norm() < scale.speed() * kRestSpeed &&
         joint_velocities(data, parts).cwiseAbs().maxCoeff() < scale.rate() * kRestRate;
}

/// Jacobian of the foot for its own joints, in S.
Mat3 foot_jacobian(const mjModel& model, const mjData& data, const RobotParts& parts, Leg leg) {
  std::vector<mjtNum> jacobian(static_cast<std::size_t>(3 * model.nv));
  const auto nv = static_cast<std::size_t>(model.nv);
  mj_jac(&model, &data, jacobian.data(), nullptr, data.geom_xpos + 3 * parts.foot_geom[index(leg)],
         parts.foot_body[index(leg)]);
  Mat3 J;
  for (int j = 0; j < kJointsPerLeg; ++j) {
    const auto dof =
        static_cast<std::size_t>(parts.dof[static_cast<std::size_t>(first_joint(leg) + j)]);
    for (std::size_t row = 0; row < 3; ++row) {
      J(static_cast<Eigen::Index>(row), j) = jacobian[row * nv + dof];
    }
  }
  return J;
}

/// Springs would make the light bodies of arms chatter: arms are carried, and stand still.
void hold_arms(const JointVector& q, const RobotParts& parts, mjData& data, JointVector& torque) {
  for (auto i = static_cast<std::size_t>(parts.num_leg_joints); i < parts.qpos.size(); ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    data.qpos[parts.qpos[i]] = q[joint];
    data.qvel[parts.dof[i]] = 0.0;
    torque[joint] = data.qfrc_bias[parts.dof[i]];
  }
}

/// As much of the damping as is stable for legs that nothing else holds: (M⁻¹)_jj d Δt < 2.
double stable_damping(const mjModel& model, mjData& data, const RobotParts& parts, double damping,
                      double timestep) {
  const auto nv = static_cast<Eigen::Index>(model.nv);
  const auto n = static_cast<std::size_t>(parts.num_leg_joints);
  Eigen::MatrixXd mobility(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    Eigen::VectorXd unit = Eigen::VectorXd::Unit(nv, parts.dof[j]), column(nv);
    mj_solveM(&model, &data, column.data(), unit.data(), 1);
    for (std::size_t i = 0; i < n; ++i)
      mobility(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = column[parts.dof[i]];
  }
  const Eigen::SelfAdjointEigenSolver<decltype(mobility)> modes(mobility, Eigen::EigenvaluesOnly);
  const double fastest = damping * timestep * modes.eigenvalues().maxCoeff();
  return fastest < kUnstable ? damping : damping / fastest;
}

/// Springs of each joint.
struct Springs {
  JointVector stiffness, damping;  // [N·m/rad], [N·m·s/rad]
};

/// The same for all joints of legs with three. Of others some turn so little that they only bear
/// weaker ones, until the ground holds them.
Springs springs(const mjModel& model, mjData& data, const RobotParts& parts, double stiffness,
                double damping, double timestep) {
  // Of what is unstable without contact; in a walker's leg the three other joints add to it.
  const double stiff_share = parts.is_walker() ? 0.08 : 0.2;
  const double damp_share = parts.is_walker() ? 0.2 : 0.5;
  const auto n = static_cast<Eigen::Index>(parts.dof.size());
  Springs result{JointVector::Constant(n, stiffness), JointVector::Constant(n, damping)};
  const int num_placing = kJointsPerLeg * static_cast<int>(parts.foot_geom.size());
  if (parts.is_walker() && parts.num_leg_joints == num_placing) return result;
  for (Eigen::Index j = 0; j < n; ++j) {
    const int dof = parts.dof[static_cast<std::size_t>(j)];
    Eigen::VectorXd unit = Eigen::VectorXd::Unit(model.nv, dof), column(model.nv);
    mj_solveM(&model, &data, column.data(), unit.data(), 1);
    const double inertia = 1.0 / column[dof];
    result.stiffness[j] = std::min(stiffness, stiff_share * inertia / (timestep * timestep));
    result.damping[j] = std::min(damping, damp_share * inertia / timestep);
  }
  return result;
}

}  // namespace

JointVector stand_up(const mjModel& model, mjData& data, const RobotParts& parts,
                     const StandUpOptions& options) {
  const Scale& scale = options.scale;
  const double stiffness = options.limp ? 0.0 : scale.torque() * kStiffness;
  double damping = scale.torque() * scale.time() * kDamping;
  if (options.limp) damping = stable_damping(model, data, parts, damping, options.timestep);
  const Springs spring = springs(model, data, parts, stiffness, damping, options.timestep);
  JointVector held = options.q, torque = JointVector::Zero(held.size());
  PerLeg<Foot> feet(static_cast<int>(parts.foot_geom.size()), Foot{});
  const auto least = std::lround(options.at_least / options.timestep);
  const auto most = std::lround(scale.time() * kMaxDuration / options.timestep);
  for (long step = 0; step < least || (step < most && !at_rest(data, parts, scale)); ++step) {
    for (const Leg leg : feet.legs()) {
      Foot& foot = feet[index(leg)];
      foot.in_the_air =
          touches(data, parts.foot_geom[index(leg)]) ? 0.0 : foot.in_the_air + options.timestep;
      const bool is_lowered = parts.is_walker();
      if (!is_lowered || foot.in_the_air < scale.time() * kMaxAirTime) continue;
      if (foot.lowered > scale.length * kMaxLowering) continue;
      const double down = scale.speed() * kLoweringSpeed * options.timestep;
      foot.lowered += down;
      held.segment<3>(first_joint(leg)) +=
          model::damped_inverse(foot_jacobian(model, data, parts, leg), scale) *
          Vec3(0.0, 0.0, -down);
    }
    torque = spring.stiffness.cwiseProduct(held - joint_positions(data, parts)) -
             spring.damping.cwiseProduct(joint_velocities(data, parts));
    torque = torque.cwiseMin(options.torque_limit).cwiseMax(-options.torque_limit);
    hold_arms(options.q, parts, data, torque);
    for (std::size_t i = 0; i < parts.actuator.size(); ++i) {
      data.ctrl[parts.actuator[i]] = torque[static_cast<Eigen::Index>(i)];
    }
    mj_step2(&model, &data);
    mj_step1(&model, &data);
  }
  data.time = 0.0;
  return torque;
}

}  // namespace surefoot::simulation
