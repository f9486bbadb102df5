#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <vector>

namespace surefoot::closed_loop {

/// Count of a fault of a sensor, or of a safe command mode, in a run.
struct TroubleCount {
  std::string what;    ///< "IMU stopped", "command mode: sit"
  int count = 0;       ///< number of times that it began
  double first = 0.0;  ///< time of its first begin [s]
};

/// Counts, tick by tick, faults of sensors that had given a good sample before, and the modes of
/// the safety ladder that end a walk.
class TroubleCounter {
 public:
  void add(double time, const TickRecord& record);

  /// In the order of their first times.
  [[nodiscard]] const std::vector<TroubleCount>& counts() const { return counts_; }

 private:
  std::vector<std::string> before_;
  std::vector<TroubleCount> counts_;
};

}  // namespace surefoot::closed_loop
