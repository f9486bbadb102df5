#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/model/robot_model.hpp"

#include <functional>

namespace surefoot::model {

/// The lengths and the mass of a robot that its walk goes with.
struct Proportions {
  int num_legs = kNumLegs;
  double leg = 0.0;   ///< HFE axis to sphere centre, across the axis, the knee as straight as its
                      ///< limits allow [m]
  double mass = 0.0;  ///< [kg]
  double half_length = 0.0;   ///< |x| of the HFE axes in B, mean of the front and hind legs [m]
  double half_width = 0.0;    ///< |y| of the feet in B at q = 0, mean of the legs [m]
  double hip_height = 0.0;    ///< z of the HFE axes in B, mean of the legs [m]
  double stroke = kInfinity;  ///< of a foot ahead and back of its hip, until a joint meets its stop
  double knee_torque = kInfinity;  ///< of the weakest knee [N·m]
};

/// The longest that a length of a leg gets while its knee turns from one angle to another [m], to
/// 1e-6 of it.
[[nodiscard]] double longest(double from, double to,
                             const std::function<double(double q_knee)>& length);

[[nodiscard]] Proportions proportions_of(RobotModel& model);

/// Against ANYmal B, for which all is 1. A length or mass that differs by rounding alone counts as
/// the same.
[[nodiscard]] Scale scale_of(const Proportions& robot);

}  // namespace surefoot::model
