#pragma once

#include "app/live_operator.hpp"
#include "app/operator_forces.hpp"
#include "app/run_steering.hpp"
#include "app/view_robot.hpp"
#include "app/view_tick.hpp"
#include "surefoot/view/tick_ring.hpp"
#include "surefoot/view/web_server.hpp"

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace surefoot {

/// A tick on its way from the run to the server.
struct ViewTick {
  std::uint32_t number = 0, generation = 0, lost = 0;
  TickRecord record;
  GroundTruth truth;
  TickTiming timing;
  OutsideForces forces;
};

/// What the pages of a live run are told. The run's thread puts ticks into a queue without locks;
/// the server's thread packs and sends them.
class LiveFeed final : public WebContent {
 public:
  LiveFeed(const Scenario& scenario, LiveOperator& wishes, std::string recording);

  // Of the run's thread. The server may only begin after the first `begin`.
  void begin(const RunParts& parts, const StackOptions& stack, double friction);
  void put(std::uint32_t number, const TickRecord& tick, const GroundTruth& truth,
           const TickTiming& timing, const OutsideForces& forces);
  void set_control(const StackOptions& stack, double friction, std::uint32_t tick);
  void set_pace(bool paused, double speed);
  void set_ended(const std::string& reason);
  void show(const logged::Change& change);
  /// A line that every page shows.
  void tell(const std::string& notice);

  // Of the server's thread.
  [[nodiscard]] WebAnswer get(std::string_view path, const Query& query) override;
  [[nodiscard]] bool is_live() const override { return true; }
  [[nodiscard]] std::vector<SharedBlock> welcome() override;
  [[nodiscard]] std::vector<SharedBlock> blocks() override;
  [[nodiscard]] std::vector<std::string> messages(std::size_t clients) override;
  [[nodiscard]] std::string status(std::size_t clients) override;
  [[nodiscard]] std::string command(const ViewCommand& command) override;

 private:
  using Clock = std::chrono::steady_clock;

  /// Of a generation: what its ticks are packed with.
  struct Packing {
    std::shared_ptr<const ViewChannels> channels;
    LevelNames names;
  };

  [[nodiscard]] std::string session();
  [[nodiscard]] std::shared_ptr<const Packing> packing(std::uint32_t generation);
  void measure();

  LiveOperator& operator_;
  const ViewRobot robot_;
  const std::string recording_;
  std::optional<TickRing<ViewTick>> ring_;  // from the first begin on
  std::uint32_t lost_ = 0;  // of the run's thread: ticks that found no room since the last that did

  std::mutex mutex_;  // of what follows, up to the next blank line; held for short
  ViewSession session_;
  std::map<std::uint32_t, std::shared_ptr<const Packing>> packings_;
  std::vector<std::string> outbox_;
  std::string ended_;

  std::atomic<bool> paused_{false}, is_news_{true};
  std::atomic<double> speed_{1.0};
  std::atomic<std::uint32_t> generation_{0};

  // Of the server's thread.
  std::deque<SharedBlock> recent_;  // the last second or two, for pages that come
  ViewFrame frame_;
  std::optional<StartAlignment> start_;
  std::uint32_t tick_ = 0;
  double time_ = 0.0;
  UserCommand user_;
  OutsideForces forces_;
  Clock::time_point next_status_{}, measured_{};
  double measured_time_ = 0.0, real_factor_ = 0.0;
};

}  // namespace surefoot
