#include "surefoot/control/stack_fade.hpp"

#include "surefoot/math/smoothstep.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <cmath>

namespace surefoot::control {

StackFade::StackFade(std::unique_ptr<SolvedStack> before, const solver::LevelSet& present,
                     const solver::Hierarchy& after, double duration)
    : before_(std::move(before)),
      at_rest_{.before = present, .after = present},
      soft_levels_(after),
      duration_(duration),
      begin_(kNaN) {
  before_->stack.set_present(present);
}

const solver::Solution& StackFade::between(const model::Dynamics& dynamics, const MotionPlan& plan,
                                           double time, const solver::Hierarchy& hierarchy,
                                           const solver::Solution& after) noexcept {
  if (!(begin_ <= time)) begin_ = time;  // also where the clock was set back
  share_ = duration_ > 0.0 ? smooth_ramp(time - begin_, duration_) : 1.0;
  if (share_ >= 1.0) return after;
  const solver::Hierarchy& rows = before_->stack.update(dynamics, plan);
  const solver::Substitution* physics =
      before_->solver.wants_substitution() ? before_->stack.substitution(dynamics) : nullptr;
  const solver::Solution& before = before_->solver.solve(rows, physics, at_rest_);
  return soft_levels_.between(hierarchy, before, after, share_);
}

}  // namespace surefoot::control
