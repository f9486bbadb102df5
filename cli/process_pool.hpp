#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace surefoot {

/// How a piece of work in a process of its own came out.
struct JobOutcome {
  std::string output;   ///< what the work returned
  std::string failure;  ///< why it returned nothing; empty if it did
};

/// Makes text; what it throws becomes the outcome's failure.
using Job = std::function<std::string()>;

/// Runs every job in a process of its own, `at_once` at a time: one that crashes takes nobody
/// along. `finished` is called in this process as each ends. After an interrupt no more are
/// started, and those that run are told to end.
void run_in_processes(const std::vector<Job>& jobs, int at_once,
                      const std::function<void(std::size_t job, const JobOutcome&)>& finished);

}  // namespace surefoot
