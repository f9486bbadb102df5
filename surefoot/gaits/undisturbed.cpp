#include "surefoot/gaits/undisturbed.hpp"

#include <algorithm>
#include <functional>

namespace surefoot::gaits {

bool is_undisturbed(const MotionPlan& plan, const RobotState& state) {
  return plan.num_contacts() == static_cast<int>(plan.feet.size()) &&
         std::ranges::none_of(state.slips, std::identity{}) &&
         state.external_force.head<2>().isZero();
}

}  // namespace surefoot::gaits
