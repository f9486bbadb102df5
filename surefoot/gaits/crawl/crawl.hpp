#pragma once

#include "surefoot/gaits/crawl/crawl_table.hpp"
#include "surefoot/gaits/crawl/step_sequence.hpp"
#include "surefoot/gaits/gait.hpp"
#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot {

/// One leg after the other in the gait's order, the COM led through the support regions by a ZMP
/// plan. A foot that meets no ground goes on down while the gait waits.
class Crawl final : public Gait {
 public:
  /// Throws Error unless the gait's order has each leg once.
  explicit Crawl(const PlannerOptions& options);

  void begin(const GaitTick& tick, Body& body,
             const std::optional<Action>& first) noexcept override;
  void observe(const GaitTick& tick, Body& body) noexcept override;
  GaitOutcome advance(const GaitTick& tick, Body& body) noexcept override;
  [[nodiscard]] bool waits(const Body& body) const override;

  [[nodiscard]] CrawlState state() const { return state_; }
  [[nodiscard]] double cycle_duration(double pace) const { return steps_.cycle_duration(pace); }

 private:
  void go(CrawlCause cause);
  void act(const std::optional<Action>& action, const GaitTick& tick, Body& body);
  void change_state(const Action& action, const GaitTick& tick, Body& body);
  [[nodiscard]] Situation see(const GaitTick& tick, const Body& body) const;
  void begin_support(const GaitTick& tick, double duration);
  void expect_touchdown(double time, double duration);
  void react_to_push(const GaitTick& tick, Body& body);
  GaitOutcome advance_shift(const GaitTick& tick, Body& body);
  GaitOutcome advance_unload(const GaitTick& tick, Body& body);
  GaitOutcome advance_swing(const GaitTick& tick, Body& body);
  void lift_off(const GaitTick& tick, Body& body);
  void abort_lift_off(const GaitTick& tick, Body& body);
  void plan_com(const GaitTick& tick, Body& body);
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

}  // namespace surefoot
