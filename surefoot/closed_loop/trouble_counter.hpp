#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <vector>

namespace surefoot::closed_loop {

/// How often something was wrong in a run that is of no foot: a sensor's samples, or the torques.
struct TroubleCount {
  std::string what;    ///< "IMU stopped", "command mode: sit"
  int count = 0;       ///< times that it began
  double first = 0.0;  ///< when it began first [s]
};

/// Collects what was wrong with sensors that had given a good sample before, bridged or not, and
/// the modes of the safety ladder that end a walk, tick by tick.
class TroubleCounter {
 public:
  void add(double time, const TickRecord& record);

  /// In the order in which they happened first.
  [[nodiscard]] const std::vector<TroubleCount>& counts() const { return counts_; }

 private:
  std::vector<std::string> before_;
  std::vector<TroubleCount> counts_;
};

}  // namespace surefoot::closed_loop
