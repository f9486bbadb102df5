#include "surefoot/estimation/lift_detector.hpp"

#include <algorithm>

namespace surefoot::estimation {
namespace {

constexpr double kFilterTime = 0.02;      // of forces and acceleration [s]
constexpr double kMaxLiftedLoad = 0.5;    // share of the weight on a lifted robot's feet
constexpr double kMinOtherSupport = 0.5;  // share of the weight on other support
constexpr double kLiftedTime = 0.05;      // [s]
constexpr double kMinFootLoad = 0.04;     // share of the weight on one stance foot
constexpr double kMinStandingLoad = 0.7;  // share of the weight on all feet
constexpr double kDownTime = 0.1;         // [s]

}  // namespace

void LiftDetector::update(double weight, const PerLeg<Vec3>& foot_force,
                          const Vec3& accelerometer) noexcept {
  const bool is_known =
      accelerometer.allFinite() &&
      std::ranges::all_of(foot_force, [](const Vec3& force) { return force.allFinite(); });
  if (!is_known) return;
  const double gain = begun_ ? period_ / (kFilterTime + period_) : 1.0;
  begun_ = true;
  specific_force_ += gain * (accelerometer / kGravity - specific_force_);
  share_.resize(static_cast<int>(foot_force.size()));
  for (const Leg leg : share_.legs()) {
    Vec3& share = share_[index(leg)];
    share += gain * (foot_force[index(leg)] / weight - share);
  }
  lifted_for_ = is_held() ? lifted_for_ + period_ : 0.0;
  down_for_ = feet_bear() ? down_for_ + period_ : 0.0;
}

bool LiftDetector::is_lifted() const { return lifted_for_ > scale_.time() * kLiftedTime; }

bool LiftDetector::is_down() const { return down_for_ > scale_.time() * kDownTime; }

bool LiftDetector::is_held() const {
  double load = 0.0;
  for (const Vec3& share : share_) load += share.norm();
  return load < kMaxLiftedLoad && specific_force_.norm() > load + kMinOtherSupport;
}

bool LiftDetector::bears(Leg leg) const { return share_[index(leg)].z() > kMinFootLoad; }

bool LiftDetector::feet_bear() const {
  double load = 0.0;
  for (const Vec3& share : share_) load += share.z();
  const auto bearing = std::ranges::count_if(share_.legs(), [this](Leg leg) { return bears(leg); });
  const bool are_on_both_sides = 2 * bearing > std::ssize(share_);  // whichever they are
  return are_on_both_sides && load > kMinStandingLoad;
}

}  // namespace surefoot::estimation
