#include "surefoot/logging/scenario_forces.hpp"

#include <algorithm>
#include <utility>

namespace surefoot::logging {
namespace {

constexpr double kSameTime = 1e-6;  // [s]
constexpr double kRounding = 1e-5;  // of forces, which live pages get in single precision

}  // namespace

ScenarioForces::ScenarioForces(std::vector<std::string> bodies) : bodies_(std::move(bodies)) {}

void ScenarioForces::acts(const logged::Change& change) {
  const auto body = std::ranges::find(bodies_, change.body);
  if (change.kind != "push" || body == bodies_.end() || !change.force.allFinite()) return;
  forces_.push_back({.body = static_cast<std::size_t>(body - bodies_.begin()),
                     .force = change.force,
                     .from = change.time,
                     .to = change.time + change.duration});
}

void ScenarioForces::leave(double time, std::vector<double>& xfrc) {
  std::vector<double> sizes(xfrc.size() / 6, 0.0);  // of the operator's forces [N]
  for (const Force& force : forces_) {
    const bool has_begun = force.from < time - kSameTime, has_ended = force.to < time - kSameTime;
    if (!has_begun || has_ended || force.body >= sizes.size()) continue;
    Eigen::Map<Vec3>(&xfrc[6 * force.body]) -= force.force;
    sizes[force.body] += force.force.norm();
  }
  for (std::size_t body = 0; body < sizes.size(); ++body) {
    Eigen::Map<Vec3> left(&xfrc[6 * body]);
    if (left.norm() <= kRounding * sizes[body]) left.setZero();
  }
  for (const Force& force : forces_) {
    const bool ends_within = force.to > before_ + kSameTime && force.to < time - kSameTime;
    if (!ends_within || force.body >= sizes.size()) continue;
    if (last_.size() == xfrc.size()) std::copy_n(&last_[6 * force.body], 3, &xfrc[6 * force.body]);
  }
  std::erase_if(forces_, [&](const Force& force) { return force.to < time - kSameTime; });
  last_ = xfrc;
  before_ = time;
}

}  // namespace surefoot::logging
