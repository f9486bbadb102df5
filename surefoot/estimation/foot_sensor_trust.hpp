#pragma once

#include "surefoot/base/scale.hpp"

namespace surefoot::estimation {

/// Chooses the normal force of a foot: the foot sensor's while the joints measure up to 10 N, as it
/// feels a touchdown earlier; the joints' from 30 N on; a mixture between.
///
/// The sensor may read 20 N less or 40 N more than the joints (10 N more in the air), plus 0.3 of
/// their force. Too low a value is ignored; too high a value is limited to that, for 50 ms. A
/// sensor off for longer is used again after fitting for 0.5 s. Impossible values (NaN, beyond
/// 10 kN) are never used. Forces are the reference robot's: `Scale`. Does not allocate.
class FootSensorTrust {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  explicit FootSensorTrust(double period, const Scale& scale = {})
      : period_(period), scale_(scale) {}

  /// One tick: the chosen normal force [N], from both measurements.
  [[nodiscard]] double force(double sensed, double by_joints) noexcept;

 private:
  double period_;
  Scale scale_;
  double off_for_ = 0.0, fits_for_ = 0.0;  // [s]
  bool is_trusted_ = true;
};

}  // namespace surefoot::estimation
