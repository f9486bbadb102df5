#pragma once

#include "surefoot/base/error.hpp"
#include "surefoot/simulation/plant.hpp"
#include "tests/support/anymal_b.hpp"

#include <Eigen/LU>
#include <mujoco/mujoco.h>

#include <array>
#include <memory>
#include <string>

namespace surefoot::test {

inline constexpr double kMass = 30.475396462;  ///< sum over the URDF's links without the dummy [kg]

/// Sensors that add nothing to the truth.
inline simulation::SensorOptions exact_sensors() {
  simulation::SensorOptions sensors;
  sensors.encoders.resolution = 0.0;
  sensors.joint_torques.noise = 0.0;
  sensors.imu.gyro_noise = sensors.imu.gyro_bias = 0.0;
  sensors.imu.accelerometer_noise = sensors.imu.accelerometer_bias = 0.0;
  sensors.foot_force.noise = 0.0;
  return sensors;
}

/// Nominal posture on the terrain, exact sensors.
inline simulation::PlantOptions standing_options() {
  simulation::PlantOptions options;
  options.sensors = exact_sensors();
  options.initial.q = anymal_b().q_nominal;
  return options;
}

/// The same robot, high above the ground.
inline simulation::PlantOptions falling_options() {
  simulation::PlantOptions options = standing_options();
  options.initial.position.z() = 50.0;
  return options;
}

inline mjModel* load_model(const std::string& xml) {
  std::array<char, 1000> error{};
  mjVFS vfs;
  mj_defaultVFS(&vfs);
  mj_addBufferVFS(&vfs, "model.xml", xml.data(), static_cast<int>(xml.size()));
  mjModel* model = mj_loadXML("model.xml", &vfs, error.data(), static_cast<int>(error.size()));
  mj_deleteVFS(&vfs);
  if (model == nullptr) throw Error(error.data());
  return model;
}

/// The logged model as stock MuJoCo loads it, brought to the state of a truth.
struct StockMujoco {
  StockMujoco(const std::string& xml, const simulation::GroundTruth& truth)
      : model(load_model(xml), &mj_deleteModel), data(mj_makeData(model.get()), &mj_deleteData) {
    std::copy(truth.qpos.begin(), truth.qpos.end(), data->qpos);
    std::copy(truth.qvel.begin(), truth.qvel.end(), data->qvel);
    std::copy(truth.ctrl.begin(), truth.ctrl.end(), data->ctrl);
    std::copy(truth.xfrc_applied.begin(), truth.xfrc_applied.end(), data->xfrc_applied);
    mj_forward(model.get(), data.get());
  }
  [[nodiscard]] int body(const std::string& name) const {
    return mj_name2id(model.get(), mjOBJ_BODY, name.c_str());
  }

  std::unique_ptr<mjModel, void (*)(mjModel*)> model;
  std::unique_ptr<mjData, void (*)(mjData*)> data;
};

/// Vertical forces of least norm on four feet that carry the weight at the centre of mass.
inline Eigen::Vector4d carrying_forces(const simulation::GroundTruth& truth, double weight) {
  Eigen::Matrix<double, 3, 4> balance;
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    balance.col(static_cast<Eigen::Index>(leg)) << 1.0, truth.p_SF[leg].x(), truth.p_SF[leg].y();
  }
  const Vec3 load = weight * Vec3(1.0, truth.p_SCom.x(), truth.p_SCom.y());
  return balance.transpose() * (balance * balance.transpose()).inverse() * load;
}

/// Joint torques that carry the robot's weight in its present posture, from stock MuJoCo.
inline JointVector carrying_torques(const simulation::Plant& plant) {
  const StockMujoco stock(plant.model_xml(), plant.truth());
  const mjModel& model = *stock.model;
  std::fill_n(stock.data->qvel, model.nv, 0.0);
  mj_forward(&model, stock.data.get());
  const double weight = kGravity * mj_getTotalmass(&model);
  const Eigen::Vector4d forces = carrying_forces(plant.truth(), weight);
  VecX torque = Eigen::Map<const VecX>(stock.data->qfrc_bias, model.nv);
  for (const Leg leg : kLegs) {
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> jacobian(3, model.nv);
    const std::string foot = std::string(kLegNames[index(leg)]) + "_FOOT";
    mj_jac(&model, stock.data.get(), jacobian.data(), nullptr,
           plant.truth().p_SF[index(leg)].data(), stock.body(foot));
    torque -= jacobian.row(2).transpose() * forces[static_cast<Eigen::Index>(leg)];
  }
  return torque.tail<kNumLegJoints>();  // the URDF's order of ANYmal B is ours
}

/// A robot whose joints hold a posture by springs, with its weight fed forward.
struct HeldRobot {
  explicit HeldRobot(const simulation::PlantOptions& options,
                     const model::RobotDescription& robot = anymal_b())
      : plant(robot, options), q_hold(options.initial.q), feedforward(carrying_torques(plant)) {}

  void tick() {
    JointCommand command;
    command.torque = feedforward + stiffness * (q_hold - truth().q) - damping * truth().qd;
    plant.write(command);
  }
  void run(double duration) {
    const double end = plant.time() + duration - 1e-9;
    while (plant.time() < end) tick();
  }
  [[nodiscard]] const simulation::GroundTruth& truth() const { return plant.truth(); }
  /// Sum of the ground's forces on the feet, in S [N].
  [[nodiscard]] Vec3 ground_force() const {
    Vec3 sum = Vec3::Zero();
    for (const simulation::TrueContact& foot : truth().feet) sum += foot.force;
    return sum;
  }

  simulation::Plant plant;
  JointVector q_hold;
  JointVector feedforward;
  double stiffness = 400.0;  ///< [N·m/rad]
  double damping = 4.0;      ///< [N·m·s/rad]
};

/// The message of the Error that building a plant throws; empty if it throws none.
inline std::string error_of(const model::RobotDescription& robot,
                            const simulation::PlantOptions& options) {
  try {
    const simulation::Plant plant(robot, options);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace surefoot::test
