#pragma once

#include "surefoot/logging/message_fields.hpp"

#include <string>
#include <vector>

namespace surefoot::logging {

/// Subtracts the operator's pushes from the truth's external forces, so that the scenario's remain.
class ScenarioForces {
 public:
  /// `bodies`: names by row of the truth's `xfrc_applied`.
  explicit ScenarioForces(std::vector<std::string> bodies);

  /// Adds a push of the operator, before the first tick with its force; ignores other changes.
  void acts(const logged::Change& change);
  /// Removes the pushes from a tick's forces; torques stay. A tick has the force of the physics
  /// step before it. If a push ended since the tick before, its share of that force is unknown: its
  /// body keeps the remaining force of the tick before.
  void leave(double time, std::vector<double>& xfrc);

 private:
  struct Force {
    std::size_t body = 0;
    Vec3 force = Vec3::Zero();
    double from = 0.0, to = 0.0;  ///< [s]
  };

  std::vector<std::string> bodies_;
  std::vector<Force> forces_;  // of the operator, present and future
  std::vector<double> last_;   // remaining forces of the tick before
  double before_ = kNaN;       // time of the tick before [s]
};

}  // namespace surefoot::logging
