#pragma once

#include "surefoot/gaits/crawl/crawl_table.hpp"
#include "surefoot/gaits/crawl/steps.hpp"
#include "surefoot/gaits/gait.hpp"

namespace surefoot::gaits {

/// One leg after the other in the gait's order, the COM led through the support regions by a ZMP
/// plan. A foot that meets no ground goes on down while the gait waits.
class Crawl final : public Gait {
 public:
  /// Throws Error unless the gait's order has each leg once.
  explicit Crawl(const PlannerOptions& options) : steps_(options.gait, options.probe) {}

  void begin(Situation& now, Body& body, const std::optional<Action>& first) override;
  [[nodiscard]] bool waits(const Body& body) const override;
  [[nodiscard]] double cycle_duration(double pace) const { return steps_.cycle_duration(pace); }

 private:
  [[nodiscard]] GaitStatus status(const Body& body) const override;
  void follow(const Action& action, const Situation& now, Body& body) override;
  void plan_com(const Situation& now, Body& body) override;
  GaitOutcome go_on(Situation& now, Body& body) override;

  void go(CrawlCause cause);
  void change_state(const Action& action, const Situation& now, Body& body);
  void begin_support(const Situation& now, double duration);
  void expect_touchdown(const Situation& now, double duration);
  void react_to_push(Situation& now, Body& body);
  GaitOutcome go_on_shifting(const Situation& now, Body& body);
  GaitOutcome go_on_unloading(Situation& now, Body& body);
  GaitOutcome go_on_swinging(Situation& now, Body& body);
  void lift_off(const Situation& now, Body& body);
  /// A foot that should stand looks for ground.
  [[nodiscard]] bool has_lost(const Body& body) const;

  StepSequence steps_;
  CrawlState state_ = CrawlState::stand;
  double lift_time_ = 0.0;  // planned lift-off of the next leg [s]
  double deadline_ = 0.0;   // expected touchdown of the swinging leg; later the gait waits [s]
  double late_time_ = 0.0;  // when a missing touchdown is told [s]
  double tilt_shortfall_on_four_ = 0.0;  // before the next leg began to unload: more of it is the
                                         // torso let go, as the others can't carry it [rad/s²]
  bool recovers_ = false;  // after a push or a slip: the gait waits until it is balanced
};

}  // namespace surefoot::gaits
