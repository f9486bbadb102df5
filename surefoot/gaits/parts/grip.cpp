#include "surefoot/gaits/parts/grip.hpp"

namespace surefoot::gaits {

bool Grip::update(const RobotState& state, const PerLeg<Vec3>& normals_W) {
  began_.fill(false);
  bool changed = false;
  if (!options_.enabled) return false;
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    began_[k] = state.slips[k] && !slid_[k];
    changed = changed || state.slips[k] != slid_[k];
    slid_[k] = state.slips[k];
    if (slid_[k])
      adapt(friction_[k], state.foot_force[k], normals_W[k]);
    else
      friction_[k] = std::min(configured_, friction_[k] + options_.recovery * period_);
  }
  return changed;
}

void Grip::adapt(double& friction, const Vec3& force, const Vec3& normal_W) const {
  constexpr double kMinForce = 15.0;  // normal force that is enough to estimate friction [N]
  const double normal = normal_W.dot(force);
  if (!(normal > scale_.force() * kMinForce)) return;
  const double ratio = (force - normal * normal_W).norm() / normal;
  friction = std::min(friction, std::max(options_.friction_min, options_.share * ratio));
}

double Grip::mean_friction(const PerLeg<bool>& stands) const {
  double sum = 0.0;
  int standing = 0;
  for (const Leg k : friction_.legs()) {
    if (!stands[index(k)]) continue;
    sum += friction(k);
    ++standing;
  }
  return standing == 0 ? configured_ : sum / standing;
}

double Grip::caution() const {
  const double least = *std::ranges::min_element(friction_);
  const double enough = std::min(options_.enough, configured_);
  return std::clamp(enough / least, 1.0, options_.caution_max);
}

}  // namespace surefoot::gaits
