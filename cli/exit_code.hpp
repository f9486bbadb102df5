#pragma once

namespace surefoot::cli {

/// What the program tells its caller.
enum ExitCode : int {
  kPassed = 0,      ///< enough runs meet the scenario's criteria, by its success_rate
  kFailed = 1,      ///< they do not
  kWrongInput = 2,  ///< the input is wrong, or the run was interrupted
  kSafetyStop = 3,  ///< they do not, and the controller stopped for safety
  kNotWhole = 4,    ///< a log is not whole; all that could be verified is the same
};

}  // namespace surefoot::cli
