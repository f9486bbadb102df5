#include "surefoot/simulation/make_estimator.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/simulation/truth_estimator.hpp"

namespace surefoot::simulation {

std::unique_ptr<estimation::StateEstimator> make_estimator(estimation::Estimation estimation,
                                                           const EstimatorSetup& setup) {
  switch (estimation) {
    case estimation::Estimation::truth:
      return std::make_unique<TruthEstimator>(setup.plant.truth());
    case estimation::Estimation::sensors:
      return std::make_unique<estimation::LegInertialEstimator>(setup.robot, setup.options,
                                                                setup.period);
  }
  throw Error("there is no such estimation");
}

}  // namespace surefoot::simulation
