#include "surefoot/control/controller.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"
#include "tests/scenarios/loop.hpp"
#include "tests/support/nees.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <utility>

namespace surefoot {
namespace {

constexpr int kDegreesOfFreedom = 5;

/// Mean of the normalised estimation error squared over one walk, twice a second. The filter's
/// state is of the time at which the IMU was sampled, so it is held against the truth of then.
double mean_nees(const config::Scenario& scenario, double begin, double end) {
  simulation::Plant plant(scenario.robot, scenario.plant);
  auto made = std::make_unique<estimation::LegInertialEstimator>(scenario.robot, scenario.estimator,
                                                                 scenario.controller.period);
  const estimation::InvariantFilter& filter = made->filter();
  control::Controller controller(scenario.robot, scenario.controller, std::move(made));
  std::deque<simulation::GroundTruth> recent;
  double sum = 0.0;
  int samples = 0;
  for (int tick = 0; plant.time() < end; ++tick) {
    const SensorReading& reading = plant.read();
    recent.push_back(plant.truth());
    if (recent.size() > 1 && recent[1].time < reading.imu_time + 1e-6) recent.pop_front();
    const JointCommand& command = controller.step(reading, scenario.user(reading.time));
    if (plant.time() >= begin && tick % 200 == 0) {
      const simulation::GroundTruth& truth = recent.front();
      EXPECT_NEAR(truth.time, reading.imu_time, 1e-6);
      sum += test::nees(filter, truth.q_SB.toRotationMatrix(), truth.v_SB);
      ++samples;
    }
    plant.write(command);
  }
  return sum / samples;
}

struct Case {
  const char* scenario;
  double too_careful, too_sure;  // by which factor the standard deviations may be off
};

class EstimatorConsistency : public testing::TestWithParam<Case> {};

/// Errors of one walk belong together (a bias, a leg that is longer), so a walk counts little more
/// than a sample does: six of a filter that is right are χ² of 30 degrees of freedom, whose mean
/// stays below 1.57 of the expected in 97.5 %, standard deviations 1.25 times too small. Of a robot
/// as modelled the filter must not be too sure at all, as it is told to expect worse ones.
TEST_P(EstimatorConsistency, InAWalkItKnowsHowWrongItIs) {
  constexpr int kWalks = 6;
  double mean = 0.0;
  for (int seed = 1; seed <= kWalks; ++seed) {
    const config::Scenario scenario =
        test::scenario(GetParam().scenario, {}, static_cast<std::uint64_t>(seed));
    mean += mean_nees(scenario, 12.0, 22.0) / kWalks;
  }
  EXPECT_GT(mean, kDegreesOfFreedom / (GetParam().too_careful * GetParam().too_careful));
  EXPECT_LT(mean, kDegreesOfFreedom * (GetParam().too_sure * GetParam().too_sure));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EstimatorConsistency,
                         testing::Values(Case{"walk_flat", 4.0, 1.0},
                                         Case{"walk_flat_mismatch", 4.0, 1.25}),
                         [](const auto& test) { return std::string(test.param.scenario); });

}  // namespace
}  // namespace surefoot
