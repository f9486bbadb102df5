#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <vector>

namespace surefoot::closed_loop {

/// How long the user's own parts take: the stages of the tick that they are in.
class OwnPartTimes {
 public:
  /// `own_parts`: as Controller::own_parts() has them; `period` of the tick [s].
  OwnPartTimes(const std::vector<std::string>& own_parts, double period);

  void add(const TickTiming& timing);
  /// A line for each stage that takes longer than the tick in the median.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  struct Stage {
    double TickTiming::* time;
    std::string parts;
    std::vector<double> times;  // [µs]
  };

  double period_;
  std::vector<Stage> stages_;  // those with own parts
};

}  // namespace surefoot::closed_loop
