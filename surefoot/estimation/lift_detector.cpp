#include "surefoot/estimation/lift_detector.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kMemory = 0.02;  // of forces and acceleration [s]
constexpr double kLittle = 0.5;   // of the weight, on the feet of a robot that is lifted, at most
constexpr double kHeld = 0.5;     // of the weight, on whatever holds it, at least
constexpr double kLiftedFor = 0.05;  // [s]
constexpr double kBears = 0.04;      // of the weight, on a foot that stands, at least …
constexpr double kBorne = 0.7;       // … and on all feet together
constexpr int kFeet = 3;             // that carry a robot
constexpr double kDownFor = 0.3;     // [s]

}  // namespace

void LiftDetector::update(double weight, const PerLeg<Vec3>& foot_force,
                          const Vec3& accelerometer) noexcept {
  const bool is_known =
      accelerometer.allFinite() &&
      std::ranges::all_of(foot_force, [](const Vec3& force) { return force.allFinite(); });
  if (!is_known) return;
  const double gain = begun_ ? period_ / (kMemory + period_) : 1.0;
  begun_ = true;
  felt_ += gain * (accelerometer / kGravity - felt_);
  for (const Leg leg : kLegs) {
    Vec3& share = share_[index(leg)];
    share += gain * (foot_force[index(leg)] / weight - share);
  }
  lifted_for_ = is_held() ? lifted_for_ + period_ : 0.0;
  down_for_ = feet_bear() ? down_for_ + period_ : 0.0;
}

bool LiftDetector::is_lifted() const { return lifted_for_ > kLiftedFor; }

bool LiftDetector::is_down() const { return down_for_ > kDownFor; }

bool LiftDetector::is_held() const {
  double borne = 0.0;
  for (const Vec3& share : share_) borne += share.norm();
  return borne < kLittle && felt_.norm() > borne + kHeld;
}

bool LiftDetector::bears(Leg leg) const { return share_[index(leg)].z() > kBears; }

bool LiftDetector::feet_bear() const {
  double borne = 0.0;
  for (const Vec3& share : share_) borne += share.z();
  const auto bearing = std::ranges::count_if(kLegs, [this](Leg leg) { return bears(leg); });
  return bearing >= kFeet && borne > kBorne;
}

}  // namespace surefoot
