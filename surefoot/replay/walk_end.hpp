#pragma once

#include "surefoot/logging/mcap_reader.hpp"

#include <optional>
#include <string>

namespace surefoot {
struct TickRecord;
}  // namespace surefoot

namespace surefoot::replay {

/// From when on a run says nothing of its walk.
struct WalkEnd {
  double time = 0.0;  ///< [s]
  std::string why;    ///< "its torso came to the ground", "its controller stopped for safety: …"
};

/// Finds it while a log is read.
class WalkEndWatch {
 public:
  /// Any message; those of the truth count.
  void see(const logging::McapMessage& message);
  void see(const TickRecord& tick);

  /// After the last message: what came first; none where the walk went on to the log's end.
  [[nodiscard]] std::optional<WalkEnd> end() const;

 private:
  std::optional<double> torso_down_;  // first [s]
  std::optional<double> feet_up_;     // all of them, since then [s]
  bool was_torso_up_ = false;
  std::optional<WalkEnd> stop_;
};

}  // namespace surefoot::replay
