#pragma once

#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <vector>

namespace surefoot {

/// Holds the slips that the controller notices against those that happen. A foot slides truly while
/// the plan lets it stand, it carries more than 20 N and its contact point moves along the ground
/// faster than 0.05 m/s; from 10 ms on that is a slip, until the foot has rested for 50 ms. A slip
/// is detected if it is believed until then, and missed otherwise; its latency runs from the
/// beginning. What is noticed while no foot has slid, be it more slowly or for a shorter time,
/// within 50 ms before is false.
class SlipJudge {
 public:
  explicit SlipJudge(double period) : period_(period) {}

  void add(const GroundTruth& truth, const TickRecord& tick);
  void write(Metrics& metrics) const;

 private:
  struct Foot {
    double slides_for = 0.0;  // without a break [s]
    double began_at = kNaN;   // of this slip, short ones included [s]
    double last_at = kNaN;    // when it was last seen to slide [s]
    double crept_at = kNaN;   // when it last moved at all [s]
    bool is_slip = false;     // long enough
    bool is_noticed = false;  // believed since it began
    bool was_believed = false;
  };
  void follow(Foot& foot, double time, double speed, bool loaded) const;
  void notice(Foot& foot, double time, bool believed);
  void close(Foot& foot);

  double period_;
  PerLeg<Foot> feet_{};
  std::vector<double> latencies_;  // [s]
  int detected_ = 0, missed_ = 0, false_ = 0;
};

}  // namespace surefoot
