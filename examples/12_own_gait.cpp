// A gait of your own within the library's planner, beside its gaits: the robot trots, sways over
// its feet, and trots on. The planner keeps the torso, the terrain, the grip and the calibration.
#include "surefoot/closed_loop.hpp"
#include "surefoot/controller.hpp"
#include "surefoot/scenario.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

namespace gaits = surefoot::gaits;

/// All feet stay, and the centre of mass goes to the left and back.
class Sway final : public gaits::Gait {
 public:
  void begin(gaits::Situation& now, gaits::Body&, const std::optional<gaits::Action>&) override {
    begin_ = now.time;
    centre_ = now.before.com.p;
  }
  bool waits(const gaits::Body&) const override { return true; }  // so that the heading does, too
  surefoot::ComPlan com(const gaits::Situation& now, const gaits::Body&) const override {
    constexpr double kWay = 0.02, kRate = 2.0;  // [m], [rad/s]
    const double phase = kRate * (now.time - begin_);
    const surefoot::Vec2 left(-std::sin(now.yaw), std::cos(now.yaw));
    surefoot::ComPlan plan;
    plan.p = centre_ + kWay * (1.0 - std::cos(phase)) * left;
    plan.v = kWay * kRate * std::sin(phase) * left;
    plan.a = kWay * kRate * kRate * std::cos(phase) * left;
    return plan;
  }

 private:
  void plan_com(const gaits::Situation&, gaits::Body&) override {}  // com() needs no plan ahead
  gaits::GaitOutcome go_on(gaits::Situation& now, gaits::Body&) override {
    return {.hands_over = !now.user.walk || now.yields};
  }

  double begin_ = 0.0;
  surefoot::Vec2 centre_{0.0, 0.0};
};

int main() {
  gaits::OwnGaits own;
  own.add("sway", [](const gaits::PlannerOptions&, double, const surefoot::Scale&) {
    return std::make_unique<Sway>();
  });
  const char* user =
      "user=[{time: 0.5, walk: true, velocity: [0.4, 0], gait: trot}, {time: 16, walk: true, gait: "
      "sway}, {time: 20, walk: true, velocity: [0.4, 0], gait: trot}]";
  const auto scenario =
      surefoot::config::load_scenario({"trot", 0, {"duration=24", "criteria=none", user}, {}, own});
  const auto result = surefoot::closed_loop::run_closed_loop(scenario, {});
  std::printf("%s; it walked %.2f m\n", result.metrics.reason.c_str(), result.metrics.distance_m);
  return !result.safety_stop && result.metrics.distance_m > 1.5 ? 0 : 1;
}
