#pragma once

#include <array>
#include <string_view>

namespace surefoot {

/// Where the controller's state comes from: what a scenario's `estimation:` chooses.
enum class Estimation : int {
  truth = 0,  ///< base state and joint velocities from the simulator's truth, the rest from sensors
  sensors = 1,  ///< base state from IMU, encoders and contacts
};

inline constexpr std::array kEstimations{Estimation::truth, Estimation::sensors};

/// As scenarios, logs and results have it.
[[nodiscard]] constexpr std::string_view name(Estimation estimation) {
  switch (estimation) {
    case Estimation::truth:
      return "truth";
    case Estimation::sensors:
      return "sensors";
  }
  return "unknown";
}

}  // namespace surefoot
