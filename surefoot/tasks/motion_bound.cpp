#include "surefoot/tasks/motion_bound.hpp"

#include "surefoot/base/error.hpp"

namespace surefoot::tasks {

MotionBound::MotionBound(double dt, BoundResponse response)
    : stiffness_(2.0 / (dt * dt)),
      damping_((response == BoundResponse::no_overshoot ? 3.0 : 2.0) / dt) {
  if (!(dt > 0.0)) throw Error("dt, the time in which a bound is reached, must be positive");
}

}  // namespace surefoot::tasks
