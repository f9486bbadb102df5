#include "surefoot/gaits/parts/push_balance.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {

void PushBalance::update(const RobotState& state, const model::Dynamics& dynamics, double height) {
  constexpr double kMinCarried = 0.5;  // share of the weight that the ground carries at least
  height_ = height;
  weight_ = kGravity * dynamics.mass;
  force_.setZero();
  load_ = ComLoad{};
  if (options_.enabled && state.external_force.allFinite() && state.external_moment.allFinite()) {
    const double carried = std::max(kMinCarried * weight_, weight_ - state.external_force.z());
    force_ = state.external_force.head<2>();
    load_.force = force_ / carried;
    load_.moment = Vec2(state.external_moment.y(), -state.external_moment.x()) / carried;
  }
  settled_force_ += std::min(1.0, period_ / options_.settling_time) * (force_ - settled_force_);
  shift_ = load_.shift(height_);
  capture_point_ =
      dynamics.com.p.head<2>() + std::sqrt(height_ / kGravity) * dynamics.com.v.head<2>() + shift_;
}

Vec2 PushBalance::excess(const SupportRegion& region) const {
  Vec2 result = Vec2::Zero();
  for (int i = 0; i < region.num_edges(); ++i) {
    const HalfPlane& edge = region.edge(i);
    const double out = edge.normal.dot(capture_point_) - edge.offset;
    if (out > result.norm()) result = out * edge.normal;
  }
  return result;
}

}  // namespace surefoot::gaits
