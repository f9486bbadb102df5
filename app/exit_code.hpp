#pragma once

namespace surefoot {

/// What the program tells its caller.
enum ExitCode : int {
  kPassed = 0,      ///< the scenario's criteria hold
  kFailed = 1,      ///< they do not
  kWrongInput = 2,  ///< the input is wrong, or the run was interrupted
  kSafetyStop = 3,  ///< the controller stopped for safety
};

}  // namespace surefoot
