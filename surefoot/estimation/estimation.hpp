#pragma once

#include <array>
#include <string_view>

namespace surefoot::estimation {

/// Source of the controller's state, chosen by a scenario's `estimation:`.
enum class Estimation : int {
  truth = 0,  ///< base state and joint velocities from the simulator's truth, the rest from sensors
  sensors = 1,  ///< base state from IMU, encoders and contacts
};

inline constexpr std::array kEstimations{Estimation::truth, Estimation::sensors};

/// The name in scenarios, logs and results.
[[nodiscard]] constexpr std::string_view name(Estimation estimation) {
  switch (estimation) {
    case Estimation::truth:
      return "truth";
    case Estimation::sensors:
      return "sensors";
  }
  return "unknown";
}

}  // namespace surefoot::estimation
