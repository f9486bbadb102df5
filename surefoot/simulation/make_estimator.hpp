#pragma once

#include "surefoot/estimation/estimation.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"
#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/simulation/plant.hpp"

#include <memory>

namespace surefoot::simulation {

/// Inputs for making an estimator.
struct EstimatorSetup {
  const model::RobotDescription& robot;
  double period;                                ///< of the control loop [s]
  const Plant& plant;                           ///< source of its readings; must outlive it
  estimation::LegInertialOptions options = {};  ///< for `sensors`
};

/// The state estimator of a scenario. The controller gets a StateEstimator and can't see whether it
/// knows the truth.
[[nodiscard]] std::unique_ptr<estimation::StateEstimator> make_estimator(
    estimation::Estimation estimation, const EstimatorSetup& setup);

}  // namespace surefoot::simulation
