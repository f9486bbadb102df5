#pragma once

#include "surefoot/logging/mcap_reader.hpp"

#include <optional>
#include <string>
#include <vector>

namespace surefoot {
struct TickRecord;
}  // namespace surefoot

namespace surefoot::replay {

/// End of a run's walk: what comes later says nothing about it.
struct WalkEnd {
  double time = 0.0;  ///< [s]
  std::string why;    ///< "its torso came to the ground", "its controller stopped for safety: …"
};

/// Finds the end of the walk while a log is read.
class WalkEndWatch {
 public:
  /// Any message; only /truth is used.
  void see(const logging::McapMessage& message);
  /// `joints`: names of all joints of the robot.
  void see(const TickRecord& tick, const std::vector<std::string>& joints);

  /// After the last message: the first end; empty if the walk went on to the log's end.
  [[nodiscard]] std::optional<WalkEnd> end() const;

 private:
  std::optional<double> torso_down_;  // first [s]
  std::optional<double> feet_up_;     // since when no foot touches the ground [s]
  bool was_torso_up_ = false;
  std::optional<WalkEnd> stop_;
};

}  // namespace surefoot::replay
