#include "surefoot/simulation/model_agreement.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/body_tree.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/simulation/mjcf_robot.hpp"
#include "surefoot/simulation/text.hpp"
#include "surefoot/simulation/urdf_spec.hpp"

#include <algorithm>
#include <random>
#include <sstream>
#include <type_traits>
#include <utility>

namespace surefoot::simulation {
namespace {

constexpr double kRounding = 1e-9;  // share of a quantity
using RowMajor3 = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
using RowMajorMass = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Compares at one posture after another, and says each difference once.
class ModelComparison {
 public:
  ModelComparison(const model::RobotDescription& robot, const mjModel& physics)
      : robot_(robot),
        physics_(physics),
        data_(mj_makeData(&physics)),
        tree_(model::make_body_tree(robot, model::read_urdf(robot))),
        model_(robot) {
    state_.v_WB = state_.w_WB_B = Vec3::Zero();
    state_.q = state_.qd = JointVector::Zero(robot.num_joints());
    for (const std::string& name : robot.joint_names())
      joints_.push_back(id_of(physics, mjOBJ_JOINT, name));
  }

  std::vector<std::string> compare(int num_postures) {
    compare_bodies();
    std::mt19937 random(1);
    for (int i = 0; i < num_postures && differences_.empty(); ++i) {
      set_posture(random);
      compare_places();
      if (differences_.empty()) compare_dynamics();
    }
    return std::move(differences_);
  }

 private:
  void compare_bodies() {
    const int base = id_of(physics_, mjOBJ_BODY, robot_.base_link);
    compare_body(robot_.base_link, tree_.base, base, Vec3::Zero());
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const int joint = joints_[i], body = physics_.jnt_bodyid[joint];
      compare_body(mj_id2name(&physics_, mjOBJ_BODY, body), tree_.limb_bodies[i].inertia, body,
                   Vec3(physics_.jnt_pos + 3 * joint));
    }
  }

  void compare_body(const std::string& link, const model::Inertia& ours, int body,
                    const Vec3& anchor) {
    const model::Inertia theirs = solid(body).placed(Mat3::Identity(), -anchor);
    tell("link \"" + link + "\": its mass", ours.mass, theirs.mass, ours.mass);
    tell("link \"" + link + "\": its centre of mass", ours.com, theirs.com, 1.0);
    tell("link \"" + link + "\": its inertia", Vec3(ours.about_com.diagonal()),
         Vec3(theirs.about_com.diagonal()), ours.about_com.trace());
    const auto products = [](const Mat3& I) { return Vec3(I(0, 1), I(0, 2), I(1, 2)); };
    tell("link \"" + link + "\": its products of inertia", products(ours.about_com),
         products(theirs.about_com), ours.about_com.trace());
  }

  /// Does a joint of ours move it? Others are held.
  [[nodiscard]] bool is_moved(int body) const {
    const int first = physics_.body_jntadr[body], count = physics_.body_jntnum[body];
    return std::ranges::any_of(
        joints_, [&](int joint) { return count > 0 && joint >= first && joint < first + count; });
  }

  /// A body with all that is fixed to it, in its frame.
  [[nodiscard]] model::Inertia solid(int body) const {
    const Vec3 moments(physics_.body_inertia + 3 * body);
    const Mat3 R = rotation_of(physics_.body_iquat + 4 * body);
    model::Inertia sum{physics_.body_mass[body], Vec3(physics_.body_ipos + 3 * body),
                       R * moments.asDiagonal() * R.transpose()};
    for (int child = body + 1; child < physics_.nbody; ++child) {
      if (physics_.body_parentid[child] != body || is_moved(child)) continue;
      sum = sum + solid(child).placed(rotation_of(physics_.body_quat + 4 * child),
                                      Vec3(physics_.body_pos + 3 * child));
    }
    return sum;
  }

  static Mat3 rotation_of(const double* q) {
    return Quat(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }

  void set_posture(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto vector = [&] { return Vec3(unit(random), unit(random), unit(random)); };
    state_.p_WB = vector();
    state_.q_WB = exp_rotation(2.0 * vector());
    double* const qpos = data_->qpos;
    const int base = id_of(physics_, mjOBJ_BODY, robot_.base_link);
    double* const free = qpos + physics_.jnt_qposadr[physics_.body_jntadr[base]];
    Eigen::Map<Eigen::Matrix<double, 7, 1>>(free) << state_.p_WB, state_.q_WB.w(),
        state_.q_WB.vec();
    for (Eigen::Index i = 0; i < state_.q.size(); ++i) {
      const double middle = 0.5 * (robot_.q_min[i] + robot_.q_max[i]);
      state_.q[i] = middle + 0.5 * unit(random) * (robot_.q_max[i] - robot_.q_min[i]);
      qpos[physics_.jnt_qposadr[joints_[static_cast<std::size_t>(i)]]] = state_.q[i];
    }
    mj_fwdPosition(&physics_, data_.get());
    mj_fwdVelocity(&physics_, data_.get());
    (void)model_.update(state_, Vec3::UnitZ());
  }

  void compare_places() {
    compare_joints_on(0, {state_.q_WB.toRotationMatrix(), state_.p_WB});
    for (const Leg leg : robot_.legs.legs()) {
      const model::LegDescription& names = robot_.legs[index(leg)];
      compare_frame("foot", names.foot_frame, model_.dynamics().foot[index(leg)].p,
                    names.foot_center);
    }
    for (std::size_t arm = 0; arm < robot_.arms.size(); ++arm) {
      const std::string& name = robot_.arms[arm].tip_frame;
      compare_frame("tip", name, model_.dynamics().arm_tips[arm].point.p, Vec3::Zero());
    }
  }

  struct Place {
    Mat3 R;
    Vec3 p;
  };

  /// All that a body moves.
  void compare_joints_on(int body, const Place& place) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const model::LimbBody& moved = tree_.limb_bodies[i];
      if (moved.parent != body) continue;
      compare_joints_on(static_cast<int>(i) + 1, compare_joint(i, place, moved.hinge));
    }
  }

  /// The place of the body behind the joint.
  Place compare_joint(std::size_t i, const Place& parent, const model::Hinge& hinge) {
    const int joint = joints_[i];
    const std::string name = "joint \"" + robot_.joint_names()[i] + "\": its ";
    const Vec3 p = parent.p + parent.R * hinge.p;
    const Mat3 R = parent.R * hinge.R;
    tell(name + "place", p, Vec3(data_->xanchor + 3 * joint), 1.0);
    tell(name + "axis", Vec3(R * hinge.axis), Vec3(data_->xaxis + 3 * joint), 1.0);
    const double angle = state_.q[static_cast<Eigen::Index>(i)];
    return {R * exp_rotation(angle * hinge.axis).toRotationMatrix(), p};
  }

  /// A body, or a geom or site of an MJCF, and a point in it.
  void compare_frame(const char* what, const std::string& name, const Vec3& ours,
                     const Vec3& point) {
    const double *p = nullptr, *R = nullptr;
    if (const int body = id_of(physics_, mjOBJ_BODY, name); body >= 0) {
      p = data_->xpos + 3 * body;
      R = data_->xmat + 9 * body;
    } else if (const int geom = id_of(physics_, mjOBJ_GEOM, name); geom >= 0) {
      p = data_->geom_xpos + 3 * geom;
      R = data_->geom_xmat + 9 * geom;
    } else if (const int site = id_of(physics_, mjOBJ_SITE, name); site >= 0) {
      p = data_->site_xpos + 3 * site;
      R = data_->site_xmat + 9 * site;
    }
    if (p == nullptr) return;
    tell(what + (" \"" + name + "\": its place"), ours, Vec3(Vec3(p) + RowMajor3(R) * point), 1.0);
  }

  void compare_dynamics() {
    const model::Dynamics& ours = model_.dynamics();
    const int num_velocities = ours.num_velocities();
    Eigen::VectorXi columns(num_velocities);
    columns.head<6>() << 0, 1, 2, 3, 4, 5;
    for (Eigen::Index i = 0; i < ours.num_joints(); ++i)
      columns[6 + i] = physics_.jnt_dofadr[joints_[static_cast<std::size_t>(i)]];
    RowMajorMass whole(num_velocities, num_velocities);
    mj_fullM(&physics_, data_.get(), whole.data());
    const model::MassMatrix M = whole(columns, columns);
    const GeneralizedVector bias =
        Eigen::Map<const GeneralizedVector>(data_->qfrc_bias, num_velocities)(columns);
    const int base = id_of(physics_, mjOBJ_BODY, robot_.base_link);
    tell("robot: its centre of mass", ours.com.p, Vec3(data_->subtree_com + 3 * base), 1.0);
    tell_share("mass matrix", ours.M - M, M);
    tell_share("forces of gravity", ours.h - bias, bias);
  }

  void tell_share(const char* what, const Eigen::MatrixXd& difference,
                  const Eigen::MatrixXd& whole) {
    const double part = difference.cwiseAbs().maxCoeff() / whole.cwiseAbs().maxCoeff();
    if (!(part <= kRounding))
      differences_.push_back(text("robot: its ", what, " differs from MuJoCo's by ", part));
  }

  template <typename Value>
  void tell(const std::string& what, const Value& ours, const Value& theirs, double whole) {
    double difference = 0.0;
    std::ostringstream numbers;
    numbers.precision(12);
    if constexpr (std::is_arithmetic_v<Value>) {
      difference = std::abs(ours - theirs);
      numbers << ours << ", but MuJoCo has " << theirs;
    } else {
      difference = (ours - theirs).cwiseAbs().maxCoeff();
      numbers << ours.transpose() << ", but MuJoCo has " << theirs.transpose();
    }
    if (difference <= kRounding * whole) return;
    differences_.push_back(what + " is " + numbers.str());
  }

  const model::RobotDescription& robot_;
  const mjModel& physics_;
  const DataHandle data_;
  const model::BodyTree tree_;
  model::RobotModel model_;
  std::vector<int> joints_;  // MuJoCo's numbers of our joints
  RobotState state_;
  std::vector<std::string> differences_;
};

/// What MuJoCo alone makes of the file; null if it refuses it.
ModelHandle read_by_mujoco(const model::RobotDescription& robot) {
  if (!robot.urdf_text.empty()) return std::move(read_mjcf(robot.urdf_path).model);
  const SpecHandle spec = read_bare_spec(robot);
  if (!spec) return nullptr;
  spec->option.gravity[2] = -kGravity;
  return ModelHandle(mj_compile(spec.get(), nullptr));
}

ModelHandle compiled(const model::RobotDescription& robot) {
  if (ModelHandle model = read_by_mujoco(robot)) return model;
  std::vector<std::string> notes;
  const SpecHandle spec = read_spec(robot, notes);
  spec->option.gravity[2] = -kGravity;
  ModelHandle model(mj_compile(spec.get(), nullptr));
  if (!model) throw FileError(text(robot.urdf_path, ": ", one_line(mjs_getError(spec.get()))));
  return model;
}

}  // namespace

bool is_read_by_mujoco(const model::RobotDescription& robot) {
  return read_by_mujoco(robot) != nullptr;
}

std::vector<std::string> disagreements(const model::RobotDescription& robot, int num_postures) {
  const ModelHandle physics = compiled(robot);
  return ModelComparison(robot, *physics).compare(num_postures);
}

}  // namespace surefoot::simulation
