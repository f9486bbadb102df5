#pragma once

namespace surefoot {

/// Which force along the normal is believed of a foot: that of its sensor, as long as it fits what
/// the joints tell.
///
/// It may tell 20 N less or 40 N more, and 0.3 of the joints' force. What is less is not believed;
/// of what is more this much is, as it feels a touch before the joints do, for 50 ms. A sensor that
/// was off for so long is believed again when it has fitted for 0.5 s. What is no force of a foot
/// (NaN, beyond 10 kN) is never believed. Does not allocate.
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
