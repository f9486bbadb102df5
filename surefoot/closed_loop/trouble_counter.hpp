#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <string>
#include <utility>
#include <vector>

namespace surefoot::closed_loop {

/// Count of a fault of a sensor, of a safe command mode or of a vain command, in a run.
struct TroubleCount {
  std::string what;    ///< "IMU stopped", "command mode: sit", "arm 0: can't get to its target"
  int count = 0;       ///< number of times that it began
  double first = 0.0;  ///< time of its first begin [s]
};

/// Counts, tick by tick, faults of sensors that had given a good sample before, and the modes of
/// the safety ladder that end a walk; also commands that an arm can't follow: it is not there, or
/// its reference has come to the target and after 1 s its tip is still 3 cm off, at scale 1.
class TroubleCounter {
 public:
  /// `joints`: names of all joints of the robot; `scale` of it.
  explicit TroubleCounter(std::vector<std::string> joints, const Scale& scale = {})
      : joints_(std::move(joints)), scale_(scale) {}

  void add(double time, const TickRecord& record, const simulation::GroundTruth& truth);

  /// In the order of their first times.
  [[nodiscard]] const std::vector<TroubleCount>& counts() const { return counts_; }

 private:
  [[nodiscard]] std::string vain_reach(const TickRecord& record,
                                       const simulation::GroundTruth& truth);

  std::vector<std::string> joints_;
  Scale scale_;
  std::vector<std::string> before_;
  double tip_since_ = kNaN;  // how long the tip has been off a target that the plan came to [s]
  std::vector<TroubleCount> counts_;
};

}  // namespace surefoot::closed_loop
