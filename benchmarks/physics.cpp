// What the plant costs: a control tick of the closed loop's physics, beside MuJoCo stepping the
// same model alone.

#include "surefoot/simulation/plant.hpp"
#include "tests/support/anymal_b.hpp"

#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

namespace {

using namespace surefoot;

enum Ground : std::int64_t { kPlane, kBoxes, kRandomBoxes, kHeightField };

std::vector<simulation::TerrainElement> terrain(std::int64_t ground) {
  simulation::TerrainBox upper, lower;
  upper.position = Vec3(0.0, 0.0, -0.1);
  upper.size = Vec3(4.0, 4.0, 0.2);
  lower.position = Vec3(4.0, 0.0, -0.24);
  lower.size = Vec3(4.0, 4.0, 0.2);
  simulation::TerrainRandomBoxes random;
  random.max_height = 0.02;
  simulation::TerrainHeightField field;
  field.size_x = field.size_y = 6.0;
  field.amplitude = 0.02;
  switch (ground) {
    case kBoxes:
      return {upper, lower};
    case kRandomBoxes:
      return {random};
    case kHeightField:
      return {field};
    default:
      return {};
  }
}

simulation::PlantOptions standing_on(std::int64_t ground) {
  simulation::PlantOptions options;
  options.initial.q = test::anymal_b().q_nominal;
  options.terrain.elements = terrain(ground);
  return options;
}

JointVector held(const simulation::GroundTruth& truth, const JointVector& q_nominal) {
  return 300.0 * (q_nominal - truth.q) - 4.0 * truth.qd;
}

void plant_tick(benchmark::State& state) {
  const model::RobotDescription robot = test::anymal_b();
  simulation::Plant plant(robot, standing_on(state.range(0)));
  JointCommand command;
  for (auto _ : state) {
    command.torque = held(plant.truth(), robot.q_nominal);
    plant.write(command);
  }
}

void mujoco_alone_tick(benchmark::State& state) {
  const model::RobotDescription robot = test::anymal_b();
  simulation::Plant plant(robot, standing_on(state.range(0)));
  const std::string xml = plant.model_xml();
  mjSpec* spec = mj_parseXMLString(xml.c_str(), nullptr, nullptr, 0);
  mjModel* model = mj_compile(spec, nullptr);
  mjData* data = mj_makeData(model);
  std::copy(plant.truth().qpos.begin(), plant.truth().qpos.end(), data->qpos);
  for (auto _ : state) {
    const Eigen::Map<const JointVector> q(data->qpos + 7, robot.num_joints()),
        qd(data->qvel + 6, robot.num_joints());
    const JointVector torque = 300.0 * (robot.q_nominal - q) - 4.0 * qd;
    std::copy(torque.begin(), torque.end(), data->ctrl);
    for (int step = 0; step < 5; ++step) mj_step(model, data);
  }
  mj_deleteData(data);
  mj_deleteModel(model);
  mj_deleteSpec(spec);
}

void construction(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        simulation::Plant(test::anymal_b(), standing_on(state.range(0))).time());
}

BENCHMARK(plant_tick)
    ->ArgName("ground")
    ->DenseRange(kPlane, kHeightField)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(mujoco_alone_tick)
    ->ArgName("ground")
    ->DenseRange(kPlane, kHeightField)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(construction)
    ->ArgName("ground")
    ->DenseRange(kPlane, kHeightField)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
