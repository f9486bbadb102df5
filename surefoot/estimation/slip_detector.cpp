#include "surefoot/estimation/slip_detector.hpp"

#include "surefoot/base/fields.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::estimation {
namespace {

/// Median over the other stance feet's contact points and 0, along each axis of the heading. One
/// other foot is no majority: then the estimate is right.
Vec3 velocity_of_others(const model::Dynamics& dynamics, const PerLeg<bool>& stands, Leg leg) {
  const Mat3 R = rotation_about_z(yaw(dynamics.base_rotation.R));
  Vec3 result = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, kMaxLegs> votes;
    votes.fill(std::numeric_limits<double>::infinity());
    votes[0] = 0.0;
    std::size_t count = 1;
    for (const Leg other : stands.legs()) {
      const double vote = R.col(axis).dot(dynamics.contact[index(other)].v);
      if (other == leg || !stands[index(other)] || !std::isfinite(vote)) continue;
      votes[count++] = vote;
    }
    if (count < 3) continue;
    std::ranges::sort(votes);
    result[axis] = 0.5 * (votes[(count - 1) / 2] + votes[count / 2]);
  }
  return R * result;
}

}  // namespace

SlipDetector::SlipDetector(const SlipOptions& options, double period)
    : options_(options),
      period_(period),
      gain_(1.0 - std::exp(-2.0 * kPi * options.cutoff_hz * period)) {}

void SlipDetector::update(const model::Dynamics& dynamics, const PerLeg<bool>& stands,
                          const Vec3& normal_W, RobotState& state) noexcept {
  feet_.resize(static_cast<int>(stands.size()));
  const PerLeg<bool> settled = settled_feet(stands);
  for (const Leg leg : stands.legs()) {
    const std::size_t k = index(leg);
    Foot& foot = feet_[k];
    if (!options_.enabled || !stands[k]) {
      foot = {.stands_for = 0.0};
    } else {
      const Vec3 v = dynamics.contact[k].v - velocity_of_others(dynamics, settled, leg);
      judge(foot, v - normal_W.dot(v) * normal_W, normal_W.dot(state.foot_force[k]));
    }
  }
  reject_without_rest(stands);
  for (const Leg leg : feet_.legs()) {
    state.slip_velocity[index(leg)] = feet_[index(leg)].velocity;
    state.slips[index(leg)] = feet_[index(leg)].slips;
  }
}

// A foot that has just come down may still move, and says nothing about the others.
PerLeg<bool> SlipDetector::settled_feet(const PerLeg<bool>& stands) const {
  PerLeg<bool> result = stands;
  for (std::size_t k = 0; k < stands.size(); ++k)
    result[k] = stands[k] && feet_[k].stands_for >= options_.settle;
  return result;
}

// If few feet seem to stand still, the base velocity is wrong instead: a median is right while half
// of the feet are. A filter without feet would never recover.
void SlipDetector::reject_without_rest(const PerLeg<bool>& stands) {
  const auto stays = [&](Leg leg) { return stands[index(leg)] && !feet_[index(leg)].slips; };
  const auto standing = std::ranges::count(stands, true);
  if (2 * std::ranges::count_if(stands.legs(), stays) >= standing) return;
  for (Foot& foot : feet_) {
    foot.slips = false;
    foot.fast_for = 0.0;
  }
}

void SlipDetector::judge(Foot& foot, const Vec3& velocity, double normal_force) const {
  if (velocity.allFinite()) foot.velocity += gain_ * (velocity - foot.velocity);
  foot.stands_for += period_;
  const double speed = foot.velocity.norm();
  const bool judged = normal_force >= options_.force && foot.stands_for >= options_.settle;
  const auto accumulate = [&](double& duration, bool goes_on) {
    duration = goes_on ? duration + period_ : 0.0;
  };
  accumulate(foot.fast_for, judged && speed > options_.begin_speed);
  accumulate(foot.slow_for, speed < options_.end_speed);
  if (foot.fast_for > options_.begin_duration - kTimeRounding) foot.slips = true;
  if (foot.slow_for > options_.end_duration - kTimeRounding) foot.slips = false;
}

Group fields(SlipOptions& o) {
  return Group{
      {"enabled", &o.enabled, "whether feet that slide are detected"},
      {"begin_speed", &o.begin_speed, kPositive, "m/s", "along the ground, against the others"},
      {"begin_duration", &o.begin_duration, kNotNegative, "s", "of that speed"},
      {"end_speed", &o.end_speed, kPositive, "m/s", "a slower foot stands again"},
      {"end_duration", &o.end_duration, kNotNegative, "s", "of that speed"},
      {"force", &o.force, kNotNegative, "N", "feet that carry less are not judged"},
      {"settle", &o.settle, kNotNegative, "s", "nor those that came down more recently"},
      {"cutoff_hz", &o.cutoff_hz, kPositive, "Hz", "of the velocity's low-pass"}}
      .with([&o](const Given& given) {
        if (o.end_speed <= o.begin_speed) return;
        given.fail("end_speed", formatted("is %g m/s; it must not be above begin_speed, %g m/s",
                                          o.end_speed, o.begin_speed));
      });
}

}  // namespace surefoot::estimation
