#include "surefoot/estimation/external_force.hpp"

#include "surefoot/base/fields.hpp"
#include "surefoot/model/angular_momentum.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kLongestGap = 0.05;  // between two updates; a longer one restarts the observer [s]

/// v (1 − (band / |v|)²) for |v| above `band`, else 0; at most `most` long.
template <int N>
Eigen::Matrix<double, N, 1> beyond(const Eigen::Matrix<double, N, 1>& v, double band, double most) {
  const double length = v.norm();
  if (!(length > band)) return Eigen::Matrix<double, N, 1>::Zero();
  return std::min(length - band * band / length, most) / length * v;
}

}  // namespace

// Mass that the model gains is no unknown load any more.
void ExternalForceEstimator::update_mass(const model::Dynamics& dynamics) {
  const double more = dynamics.mass - mass_;
  mass_ = dynamics.mass;
  if (!std::isfinite(more)) return;
  explained_ += more * dynamics.com.v;
  explained_.z() -= options_.load_time_constant * more * kGravity;
}

void ExternalForceEstimator::start(const Vec3& momentum, const Vec3& angular_momentum) {
  force_.setZero();
  moment_.setZero();
  explained_ = momentum;
  angular_explained_ = angular_momentum;
}

void ExternalForceEstimator::update(const model::Dynamics& dynamics, const PerLeg<bool>& stands,
                                    RobotState& state) noexcept {
  state.external_force.setZero();
  state.external_moment.setZero();
  if (!options_.enabled) return;
  const Vec3 momentum = dynamics.mass * dynamics.com.v;
  const Vec3 angular = model::angular_momentum(dynamics);
  Vec3 ground = -dynamics.mass * kGravity * Vec3::UnitZ(), turning = Vec3::Zero();
  for (const Leg leg : stands.legs()) {
    if (!stands[index(leg)]) continue;
    const Vec3& f = state.foot_force[index(leg)];
    ground += f;
    turning += (dynamics.contact[index(leg)].p - dynamics.com.p).cross(f);
  }
  update_mass(dynamics);
  const double dt = state.time - time_;
  time_ = state.time;
  const bool usable = ground.allFinite() && turning.allFinite() && explained_.allFinite() &&
                      angular_explained_.allFinite() && dt > 0.0 && dt < kLongestGap;
  if (!usable) {
    start(momentum, angular);
    return;
  }
  explained_ += dt * (ground + force_);
  angular_explained_ += dt * (turning + moment_);
  const Vec3 rest = momentum - explained_, angular_rest = angular - angular_explained_;
  force_ << rest.head<2>() / options_.time_constant, rest.z() / options_.load_time_constant;
  moment_ = angular_rest / options_.load_time_constant;

  const Vec2 push = beyond<2>(force_.head<2>(), options_.dead_band, options_.max_force);
  const Eigen::Matrix<double, 1, 1> vertical(force_.z());
  const double load = beyond<1>(vertical, options_.load_dead_band, options_.max_force)[0];
  state.external_force << push, load;
  state.external_moment = beyond<3>(moment_, options_.moment_dead_band, options_.max_moment);
}

Group fields(ExternalForceOptions& o) {
  return {{"enabled", &o.enabled, "whether forces from outside are estimated"},
          {"time_constant", &o.time_constant, kTimeConstant, "s", "of the horizontal force"},
          {"load_time_constant", &o.load_time_constant, kTimeConstant, "s",
           "of vertical force and moments"},
          {"dead_band", &o.dead_band, kNotNegative, "N", "of the horizontal force: model errors"},
          {"load_dead_band", &o.load_dead_band, kNotNegative, "N", "of the vertical force"},
          {"moment_dead_band", &o.moment_dead_band, kNotNegative, "N·m", "of the moments"},
          {"max_force", &o.max_force, kNotNegative, "N", "that is handed on"},
          {"max_moment", &o.max_moment, kNotNegative, "N·m", "that is handed on"}};
}

}  // namespace surefoot::estimation
