#include "tests/model/mujoco_reference.hpp"

#include "tests/support/sizes.hpp"

#include <mujoco/mujoco.h>

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace surefoot::test {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, kNumVelocities, Eigen::RowMajor>;
using RowMajorMass = Eigen::Matrix<double, kNumVelocities, kNumVelocities, Eigen::RowMajor>;

/// The URDF's text with MuJoCo's settings: every link stays a body, shapes do not count as mass.
std::string urdf_for_mujoco(const std::string& path) {
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::size_t after_robot = text.find('>', text.find("<robot")) + 1;
  text.insert(after_robot,
              "<mujoco><compiler discardvisual=\"true\" fusestatic=\"false\" strippath=\"true\" "
              "inertiafromgeom=\"false\"/></mujoco>");
  return text;
}

/// MuJoCo refuses the root link's dummy inertia.
void free_root_without_dummy_inertia(mjSpec* spec, const std::string& root) {
  mjsBody* body = mjs_findBody(spec, root.c_str());
  body->explicitinertial = 0;
  body->mass = 0.0;
  for (double& value : body->inertia) value = 0.0;
  body->fullinertia[0] = NAN;
  mjs_addFreeJoint(body)->align = mjALIGNFREE_FALSE;
}

}  // namespace

struct MujocoReference::Implementation {
  explicit Implementation(const model::RobotDescription& robot) : description(robot) {
    const std::string text = urdf_for_mujoco(robot.urdf_path);
    std::array<char, 1000> error{};
    mjSpec* spec = mj_parseXMLString(text.c_str(), nullptr, error.data(), 1000);
    if (spec == nullptr) throw std::runtime_error(error.data());
    free_root_without_dummy_inertia(spec, robot.base_link);
    spec->option.gravity[2] = -kGravity;
    model = mj_compile(spec, nullptr);
    const std::string message = mjs_getError(spec);
    mj_deleteSpec(spec);
    if (model == nullptr) throw std::runtime_error(message);
    data = mj_makeData(model);
    columns.head<6>() << 0, 1, 2, 3, 4, 5;
    for (const Leg leg : kLegs) {
      for (int j = 0; j < kJointsPerLeg; ++j) {
        columns[6 + first_joint(leg) + j] = model->jnt_dofadr[joint(leg, j)];
      }
    }
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }

  [[nodiscard]] int joint(Leg leg, int j) const {
    const std::string& name = description.legs[index(leg)].joints[static_cast<std::size_t>(j)];
    return mj_name2id(model, mjOBJ_JOINT, name.c_str());
  }
  [[nodiscard]] int body(const std::string& name) const {
    return mj_name2id(model, mjOBJ_BODY, name.c_str());
  }
  [[nodiscard]] GeneralizedVector velocity() const {
    return Eigen::Map<const GeneralizedVector>(data->qvel, kNumVelocities);
  }
  [[nodiscard]] model::Jacobian3 in_our_order(const RowMajor3& J) const {
    model::Jacobian3 result(3, kNumVelocities);
    for (int i = 0; i < kNumVelocities; ++i) result.col(i) = J.col(columns[i]);
    return result;
  }

  [[nodiscard]] model::PointKinematics point(int id, const Vec3& p_W) const {
    RowMajor3 J = RowMajor3::Zero();
    RowMajor3 Jdot = RowMajor3::Zero();
    mj_jac(model, data, J.data(), nullptr, p_W.data(), id);
    mj_jacDot(model, data, Jdot.data(), nullptr, p_W.data(), id);
    return {p_W, J * velocity(), in_our_order(J), Jdot * velocity()};
  }

  model::RobotDescription description;
  mjModel* model = nullptr;
  mjData* data = nullptr;
  Eigen::Matrix<int, kNumVelocities, 1> columns;  ///< MuJoCo's number of our velocities
};

MujocoReference::MujocoReference(const model::RobotDescription& description)
    : implementation_(std::make_unique<Implementation>(description)) {}

MujocoReference::~MujocoReference() = default;

void MujocoReference::set_state(const RobotState& state) {
  mjData* data = implementation_->data;
  Eigen::Map<Eigen::Matrix<double, 7 + kNumLegJoints, 1>> q(data->qpos);
  Eigen::Map<GeneralizedVector> v(data->qvel, kNumVelocities);
  q.head<7>() << state.p_WB, state.q_WB.w(), state.q_WB.vec();
  v.head<6>() << state.v_WB, state.w_WB_B;
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const int joint = implementation_->joint(leg, j);
      q[implementation_->model->jnt_qposadr[joint]] = state.q[first_joint(leg) + j];
      v[implementation_->model->jnt_dofadr[joint]] = state.qd[first_joint(leg) + j];
    }
  }
  mj_forward(implementation_->model, data);
}

model::MassMatrix MujocoReference::mass_matrix() const {
  RowMajorMass M;
  mj_fullM(implementation_->model, implementation_->data, M.data());
  return M(implementation_->columns, implementation_->columns);
}

GeneralizedVector MujocoReference::bias() const {
  const Eigen::Map<const GeneralizedVector> h(implementation_->data->qfrc_bias, kNumVelocities);
  return h(implementation_->columns);
}

double MujocoReference::mass() const { return mj_getTotalmass(implementation_->model); }

model::PointKinematics MujocoReference::com() const {
  model::PointKinematics sum;
  for (int id = 1; id < implementation_->model->nbody; ++id) {
    const double weight = implementation_->model->body_mass[id] / mass();
    const model::PointKinematics part =
        implementation_->point(id, Vec3(implementation_->data->xipos + 3 * id));
    sum.p += weight * part.p;
    sum.v += weight * part.v;
    sum.J += weight * part.J;
    sum.Jdot_u += weight * part.Jdot_u;
  }
  return sum;
}

model::PointKinematics MujocoReference::point(const std::string& link, const Vec3& p_link) const {
  const int id = implementation_->body(link);
  const Vec3 origin(implementation_->data->xpos + 3 * id);
  return implementation_->point(id, origin + rotation(link).R * p_link);
}

model::PointKinematics MujocoReference::material_point(const std::string& link,
                                                       const Vec3& p_W) const {
  return implementation_->point(implementation_->body(link), p_W);
}

model::RotationKinematics MujocoReference::rotation(const std::string& link) const {
  const int id = implementation_->body(link);
  const mjData* data = implementation_->data;
  const Vec3 origin(data->xpos + 3 * id);
  RowMajor3 J = RowMajor3::Zero();
  RowMajor3 Jdot = RowMajor3::Zero();
  mj_jac(implementation_->model, data, nullptr, J.data(), origin.data(), id);
  mj_jacDot(implementation_->model, data, nullptr, Jdot.data(), origin.data(), id);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(data->xmat + 9 * id);
  const GeneralizedVector v = implementation_->velocity();
  return {R, J * v, implementation_->in_our_order(J), Jdot * v};
}

}  // namespace surefoot::test
