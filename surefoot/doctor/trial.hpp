#pragma once

#include "surefoot/doctor/diagnosis.hpp"

#include <functional>
#include <string>
#include <vector>

namespace surefoot::doctor {

/// How a scenario went with the robot, in simulation.
struct Trial {
  std::string scenario;  ///< or "stand"
  bool succeeded = false;
  std::string why;     ///< how it ended, the criteria that were missed, and some figures
  std::string log{};   ///< of a run that did not succeed; empty: none was asked for
  std::string base{};  ///< the scenario, also of "stand"
};

struct TrialOptions {
  std::function<void(const std::string& scenario, double time, double duration)> progress{};
  std::function<bool()> interrupted{};
  std::string logs{};  ///< where a log goes: a path to which SCENARIO.mcap is added; empty: nowhere
};

/// Stands for 4 s, walks on flat ground for 20 s, and down a step, with guesses for what the URDF
/// lacks; two legs stand, squat and are pushed. The program must have read the robot. What the
/// program refuses is a trial that failed. Throws Error if it was interrupted.
[[nodiscard]] std::vector<Trial> try_walking(const Diagnosis& robot, const TrialOptions& options);

}  // namespace surefoot::doctor
