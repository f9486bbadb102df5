#pragma once

namespace surefoot {

/// Which force along the normal is believed of a foot: in the air, and where it bears up to 10 N by
/// what the joints tell, that of its sensor, which feels a touch before they do; from 30 N on that
/// of the joints; a mixture between.
///
/// The sensor may tell 20 N less or 40 N more than the joints, where they tell nothing only 10 N,
/// and 0.3 of their force. What is less is not believed; of what is more 40 N and that share are,
/// for 50 ms. One that was off for so long is believed again when it has fitted for 0.5 s. What is
/// no force of a foot (NaN, beyond 10 kN) is never believed. Does not allocate.
class FootSensorTrust {
 public:
  /// `period` of the control loop [s].
  explicit FootSensorTrust(double period) : period_(period) {}

  /// One tick: the force to believe, of both along the normal [N].
  [[nodiscard]] double force(double sensed, double by_joints) noexcept;

 private:
  double period_;
  double off_for_ = 0.0, fits_for_ = 0.0;  // [s]
  bool is_trusted_ = true;
};

}  // namespace surefoot
