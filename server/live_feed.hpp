#pragma once

#include "server/event_finder.hpp"
#include "server/frame_history.hpp"
#include "server/live_operator.hpp"
#include "server/mailbox.hpp"
#include "server/tick_ring.hpp"
#include "server/view_robot.hpp"
#include "server/view_tick.hpp"
#include "server/web_server.hpp"
#include "surefoot/closed_loop/run_steering.hpp"

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::server {

/// A tick on its way from the run to the server.
struct ViewTick {
  std::uint32_t number = 0, lost = 0;
  std::uint64_t news = 0;  ///< news of the run before it
  TickRecord record;
  simulation::GroundTruth truth;
  TickTiming timing;
};

/// Content for the pages of a live run. The run's thread hands over ticks and other news without
/// locks and never waits. The server's thread packs and sends them in that order.
class LiveFeed final : public WebContent {
 public:
  LiveFeed(const config::Scenario& scenario, LiveOperator& wishes, std::string recording);

  // Called on the run's thread. The server may only begin after the first `begin`.
  void begin(const closed_loop::RunParts& parts, const control::StackOptions& stack,
             double friction);
  void put(std::uint32_t number, const TickRecord& tick, const simulation::GroundTruth& truth,
           const TickTiming& timing);
  void set_control(const control::StackOptions& stack, double friction, std::uint32_t tick);
  void set_pace(bool paused, double speed);
  void set_ended(const std::string& reason);
  /// Sets the log that is written from the next begin on.
  void set_recording(const std::string& path);
  void show(const logged::Change& change);
  /// Shows a line on every page.
  void notify(const std::string& notice);

  /// Whether there is room for the next tick.
  [[nodiscard]] bool has_room() { return ring_->next_to_write() != nullptr; }
  /// Whether a page has drawn the robot.
  [[nodiscard]] bool is_seen() const { return is_seen_; }

  /// The robot's meshes.
  [[nodiscard]] const std::vector<model::MeshFile>& meshes() const { return robot_.meshes(); }

  // Called on the server's thread.
  [[nodiscard]] std::string start() const override { return session_.start; }
  [[nodiscard]] WebAnswer get(std::string_view path, const Query& query) override;
  [[nodiscard]] bool is_live() const override { return true; }
  [[nodiscard]] std::vector<SharedBlock> welcome() override;
  [[nodiscard]] std::vector<SharedBlock> blocks() override;
  [[nodiscard]] std::vector<std::string> messages(std::size_t clients) override;
  [[nodiscard]] std::string status(std::size_t clients) override;
  void drawn() override { is_seen_ = true; }
  [[nodiscard]] std::string command(const ViewCommand& command) override;

 private:
  using Clock = std::chrono::steady_clock;

  /// News of the run, with what the server's thread must do about it.
  struct News {
    std::uint64_t number = 0;
    std::function<void()> take;
  };

  /// State at which the run's speed is measured; a change restarts the measurement.
  struct Pace {
    bool paused = false;
    double speed = 1.0;
    std::uint32_t begun = 0;
    bool operator==(const Pace&) const = default;
  };

  void hand_over(std::function<void()> take);
  void begin_again(ViewRun begun);
  void fetch_news();
  void take_news();
  void take_news_before(const ViewTick& tick);
  void take(const ViewTick& tick, std::string& bytes);
  void keep(const std::vector<SharedBlock>& blocks);
  void add_event(double time, const std::string& event);
  void measure();
  void see_calibration(const TickRecord& tick);

  LiveOperator& operator_;
  const ViewRobot robot_;
  std::optional<TickRing<ViewTick>> ring_;  // from the first begin on
  Mailbox<News> mailbox_;
  std::uint32_t lost_ = 0;    // run's thread: ticks dropped since the last that had room
  std::uint64_t handed_ = 0;  // run's thread: news so far
  std::atomic<bool> paused_{false}, is_news_{true}, is_seen_{false};
  std::atomic<double> speed_{1.0};

  // Members of the server's thread.
  ViewSession session_;
  std::deque<News> news_;      // arrived, not taken yet
  std::uint64_t taken_ = 0;    // number of the last taken
  logging::LevelNames names_;  // for packing ticks
  std::optional<EventFinder> finder_;
  int changes_ = 0;                            // changes from outside, of the present run
  std::vector<std::string> events_, notices_;  // not sent yet
  FrameHistory history_;                       // of the present run
  /// Events with their times, for pages that open later; kept as long as the frames.
  std::deque<std::pair<double, std::string>> past_;
  std::string ended_, recording_;
  ViewFrame frame_;
  std::optional<tasks::FrictionCone> cone_;  // of the run's stack
  evaluation::Aligner aligner_;
  const double calibration_;               // its duration [s]
  std::optional<double> calibrates_till_;  // none: the robot does not calibrate [s]
  std::uint32_t tick_ = 0;
  double time_ = 0.0;
  UserCommand user_;
  Clock::time_point next_status_{}, measured_{};
  std::optional<Pace> pace_;  // from the first measure on
  double measured_time_ = 0.0, real_factor_ = 0.0;
};

}  // namespace surefoot::server
