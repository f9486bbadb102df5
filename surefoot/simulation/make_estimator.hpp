#pragma once

#include "surefoot/estimation/estimation.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"
#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/simulation/plant.hpp"

#include <memory>

namespace surefoot {

/// What an estimator may be made from.
struct EstimatorSetup {
  const RobotDescription& robot;
  double period;                    ///< of the control loop [s]
  const Plant& plant;               ///< whose readings it gets; must outlive it
  LegInertialOptions options = {};  ///< of `sensors`
};

/// The state estimator that a scenario asks for. Truth stays on this side: the controller gets a
/// StateEstimator and can't tell where the state comes from.
[[nodiscard]] std::unique_ptr<StateEstimator> make_estimator(Estimation estimation,
                                                             const EstimatorSetup& setup);

}  // namespace surefoot
