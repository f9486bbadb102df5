#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <array>
#include <vector>

namespace surefoot::evaluation {

/// Compares the slips that the controller detects with the true ones. A foot truly slides while it
/// is in planned stance, carries more than 20 N and its contact point moves along the ground faster
/// than 0.05 m/s; for at least 10 ms this is a slip, until the foot has rested for 50 ms. A slip is
/// detected if the estimate shows it until then, otherwise missed; its latency runs from its start.
/// A detection is false if no foot slid within 50 ms before, not even more slowly or shortly.
/// Force, speeds and times are the reference robot's: `Scale`.
class SlipJudge {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  explicit SlipJudge(double period, Scale scale = {}) : period_(period), scale_(scale) {}

  void add(const simulation::GroundTruth& truth, const TickRecord& tick);
  void write(Metrics& metrics) const;

 private:
  struct Foot {
    double slides_for = 0.0;  // without a break [s]
    double began_at = kNaN;   // start of this slip, short ones included [s]
    double last_at = kNaN;    // last sliding [s]
    double crept_at = kNaN;   // last motion at all [s]
    bool is_slip = false;     // long enough
    bool is_noticed = false;  // detected since it began
    bool was_believed = false;
  };
  void follow(Foot& foot, double time, double speed, bool loaded) const;
  void notice(Foot& foot, double time, bool believed);
  void close(Foot& foot);

  double period_;
  Scale scale_;
  std::array<Foot, kMaxLegs> feet_{};
  std::vector<double> latencies_;  // [s]
  int detected_ = 0, missed_ = 0, false_ = 0;
};

}  // namespace surefoot::evaluation
