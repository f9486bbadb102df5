#pragma once

#include "surefoot/logging/message_fields.hpp"

#include <string>
#include <vector>

namespace surefoot::logging {

/// Takes what the operator did out of the forces from outside, of which the truth has the sum: what
/// is left is the scenario's.
class ScenarioForces {
 public:
  /// `bodies`: their names by the rows of the truth's `xfrc_applied`.
  explicit ScenarioForces(std::vector<std::string> bodies);

  /// A push of the operator; before the ticks that have its force.
  void acts(const logged::Change& change);
  /// Of the forces at a tick leaves the scenario's; torques stay as they are. A tick has the force
  /// of the physics step before it. Which share of that a push had that ended meanwhile is not
  /// known: then what was left on its body stays what it was at the tick before.
  void leave(double time, std::vector<double>& xfrc);

 private:
  struct Force {
    std::size_t body = 0;
    Vec3 force = Vec3::Zero();
    double from = 0.0, to = 0.0;  ///< [s]
  };

  std::vector<std::string> bodies_;
  std::vector<Force> forces_;  // of the operator, that act or will
  std::vector<double> last_;   // what was left at the tick before
  double before_ = kNaN;       // its time [s]
};

}  // namespace surefoot::logging
