#include "surefoot/logging/logged_model.hpp"

namespace surefoot::logged {

Vec2 measured_zmp(const PerLeg<Vec3>& p_WF, const PerLeg<Vec3>& force, double least_load) {
  double load = 0.0, moment = 0.0;
  for (std::size_t k = 0; k < force.size(); ++k) {
    load += force[k].z();
    moment += p_WF[k].z() * force[k].z();
  }
  if (!(load > least_load)) return Vec2::Constant(kNaN);
  const double height = moment / load;
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < force.size(); ++k) {
    sum += p_WF[k].head<2>() * force[k].z() - (p_WF[k].z() - height) * force[k].head<2>();
  }
  return sum / load;
}

Model model_of(const TickRecord& tick, double least_load) {
  return {tick.model, measured_zmp(tick.model.p_WF, tick.state.foot_force, least_load)};
}

}  // namespace surefoot::logged
