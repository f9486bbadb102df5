#include "surefoot/simulation/make_estimator.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/simulation/truth_estimator.hpp"

namespace surefoot {

std::unique_ptr<StateEstimator> make_estimator(Estimation estimation, const EstimatorSetup& setup) {
  switch (estimation) {
    case Estimation::truth:
      return std::make_unique<TruthEstimator>(setup.plant.truth());
    case Estimation::sensors:
      return std::make_unique<LegInertialEstimator>(setup.robot, setup.options, setup.period);
  }
  throw Error("there is no such estimation");
}

}  // namespace surefoot
