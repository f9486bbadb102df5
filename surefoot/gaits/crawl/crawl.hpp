#pragma once

#include "surefoot/gaits/crawl/crawl_table.hpp"
#include "surefoot/gaits/crawl/steps.hpp"
#include "surefoot/gaits/gait.hpp"

namespace surefoot::gaits {

/// Statically stable walk: one leg after the other in the gait's order, with a ZMP plan of the COM.
/// The gait waits while a foot searches for ground.
class Crawl final : public Gait {
 public:
  /// Throws Error unless the gait's order has each leg once.
  explicit Crawl(const PlannerOptions& options) : steps_(options.gait, options.probe) {}

  void begin(Situation& now, Body& body, const std::optional<Action>& first) override;
  [[nodiscard]] bool waits(const Body& body) const override;
  [[nodiscard]] double stride_duration(double pace) const override {
    return steps_.cycle_duration(pace);
  }

 private:
  [[nodiscard]] GaitStatus status(const Body& body) const override;
  void follow(const Action& action, const Situation& now, Body& body) override;
  void plan_com(const Situation& now, Body& body) override;
  GaitOutcome go_on(Situation& now, Body& body) override;

  void transition(CrawlCause cause);
  void change_state(const Action& action, const Situation& now, Body& body);
  void begin_support(const Situation& now, double duration);
  void expect_touchdown(const Situation& now, double duration);
  void react_to_push(Situation& now, Body& body);
  GaitOutcome go_on_shifting(const Situation& now, Body& body);
  GaitOutcome go_on_unloading(Situation& now, Body& body);
  GaitOutcome go_on_swinging(Situation& now, Body& body);
  void lift_off(const Situation& now, Body& body);
  /// Does a foot that should stand search for ground?
  [[nodiscard]] bool has_lost_contact(const Body& body) const;

  StepSequence steps_;
  CrawlState state_ = CrawlState::stand;
  double lift_time_ = 0.0;               // planned lift-off of the next leg [s]
  double deadline_ = 0.0;                // expected touchdown of the swing leg [s]
  double late_time_ = 0.0;               // when a missing touchdown is reported [s]
  double initial_tilt_shortfall_ = 0.0;  // before the next leg began to unload [rad/s²]
  bool recovers_ = false;                // waits for balance after a push or a slip
};

}  // namespace surefoot::gaits
