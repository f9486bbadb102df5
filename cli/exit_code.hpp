#pragma once

namespace surefoot::cli {

/// Exit code of the program.
enum ExitCode : int {
  kPassed = 0,      ///< enough runs meet the scenario's criteria, by its success_rate
  kFailed = 1,      ///< too few do
  kWrongInput = 2,  ///< the input is wrong, or the run was interrupted
  kSafetyStop = 3,  ///< too few do, and the controller stopped for safety
  kNotWhole = 4,    ///< a log, or a run for its criteria, is not whole; what there is holds
};

}  // namespace surefoot::cli
