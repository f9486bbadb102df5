#pragma once

namespace surefoot {

/// When the controller gives up its optimum for good.
struct SafetyOptions {
  int damp_after_failures = 80;  ///< ticks of joint hold before damping, latched (200 ms at 400 Hz)
  double max_tilt = 1.05;        ///< damping beyond this tilt of the torso, latched [rad]
};

}  // namespace surefoot
