#pragma once

#include "server/live_feed.hpp"
#include "server/live_operator.hpp"
#include "server/run_pace.hpp"
#include "surefoot/closed_loop/run_steering.hpp"

#include <functional>
#include <string>
#include <vector>

namespace surefoot::server {

/// Steers a run by its operator's wishes, keeps its speed, and feeds the pages.
class LiveView final : public closed_loop::RunSteering {
 public:
  /// It asks `interrupted` while it waits. With `waits_for_page` a run calibrates as fast as it
  /// can, then waits until a page has drawn the robot. The arguments must outlive it.
  LiveView(LiveOperator& wishes, LiveFeed& feed, std::function<bool()> interrupted,
           bool waits_for_page = false);

  void begin(const closed_loop::RunParts& parts) override;
  [[nodiscard]] closed_loop::RunOrder before_tick(double time) override;
  [[nodiscard]] UserCommand user(const UserCommand& planned) override;
  void after_tick(const TickRecord& tick, const simulation::GroundTruth& truth,
                  const TickTiming& timing) override;

  /// Shows the pages why the run has ended, and waits. True: begin it again; false: interrupted.
  [[nodiscard]] bool wait_for_reset(const std::string& reason);

 private:
  using Clock = std::chrono::steady_clock;

  /// Whether the next tick must wait, regardless of the pace.
  [[nodiscard]] bool is_held() const;
  void take(double time);
  void take_control(double time);
  void take_walk(double time);
  void book(const simulation::Push& push, double time);
  void begin_pushes();
  [[nodiscard]] bool change_stack(const std::string& text, double time);
  void keep(logged::Change change);

  LiveOperator& operator_;
  LiveFeed& feed_;
  std::function<bool()> interrupted_;
  const bool waits_for_page_;
  std::optional<closed_loop::RunParts> parts_;
  OperatorWishes wishes_;
  WantedControl present_;  // of the controller
  std::optional<UserCommand> walk_;
  RunPace pace_;
  int steps_ = 0;
  std::vector<simulation::Push> booked_;  // pushes that begin at the next tick
  std::vector<simulation::Push> pushes_;  // these and active ones
  bool hurries_ = false;                  // the robot calibrates at the beginning, without a pace
  bool reset_ = false, is_off_pace_ = false;
  bool is_pending_ = false;  // a wanted control is not in effect yet
  double speed_ = 1.0;
  std::uint32_t tick_ = 0;
};

}  // namespace surefoot::server
