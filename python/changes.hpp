#pragma once

#include "surefoot/logging/message_fields.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace surefoot::python {

/// What is changed from outside between the ticks of a plant or a controller, for a log. Without
/// one nothing is kept beyond the first tick.
class Changes {
 public:
  void set_recorded(bool recorded) { is_recorded_ = recorded; }
  [[nodiscard]] bool is_recorded() const { return is_recorded_; }

  /// A change after `tick` ticks. Without a time (NaN) it gets that of the next one.
  void add(logged::Change change, long tick) { waiting_.emplace_back(std::move(change), tick); }
  void end_tick() {
    if (!is_recorded_) waiting_.clear();
  }

  /// Calls with those that hold from a tick at `time` on, after so many ticks: they wait no more.
  template <typename Record>
  void take(double time, long ticks, const Record& record) {
    std::erase_if(waiting_, [&](auto& waiting) {
      logged::Change& change = waiting.first;
      if (waiting.second > ticks || change.time > time + kRounding) return false;
      if (std::isnan(change.time)) change.time = time;
      record(change);
      return true;
    });
  }

 private:
  static constexpr double kRounding = 1e-9;  // [s]
  bool is_recorded_ = false;
  std::vector<std::pair<logged::Change, long>> waiting_;
};

}  // namespace surefoot::python
