#include "surefoot/gaits/parts/grip.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kLeastForce = 15.0;  // of a foot whose forces say something of friction [N]

}  // namespace

bool Grip::update(const RobotState& state, const PerLeg<Vec3>& normals_W) {
  began_.fill(false);
  bool changed = false;
  if (!options_.enabled) return false;
  for (const Leg leg : kLegs) {
    const std::size_t k = index(leg);
    began_[k] = state.slips[k] && !slid_[k];
    changed = changed || state.slips[k] != slid_[k];
    slid_[k] = state.slips[k];
    adapt(leg, state, normals_W[k]);
  }
  return changed;
}

void Grip::adapt(Leg leg, const RobotState& state, const Vec3& normal_W) {
  double& mu = friction_[index(leg)];
  if (!state.slips[index(leg)]) {
    mu = std::min(configured_, mu + options_.recovery * period_);
    return;
  }
  const Vec3& force = state.foot_force[index(leg)];
  const double normal = normal_W.dot(force);
  if (!(normal > kLeastForce)) return;
  const double ratio = (force - normal * normal_W).norm() / normal;
  mu = std::min(mu, std::max(options_.friction_min, options_.share * ratio));
}

double Grip::mean_friction(const PerLeg<bool>& stands) const {
  double sum = 0.0;
  int standing = 0;
  for (const Leg k : kLegs) {
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

}  // namespace surefoot
