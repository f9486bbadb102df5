#pragma once

#include <string>

namespace surefoot::explain {

/// Result of a run, from the summary of its log.
struct Outcome {
  bool known = false;        ///< the summary could be read; else all else is unset
  bool interrupted = false;  ///< from outside, or restarted; not judged
  bool judged = false;       ///< it succeeded or did not; else it was too short
  bool succeeded = false;
  std::string reason;                      ///< why it ended
  std::size_t num_criteria = 0, held = 0;  ///< criteria, and how many hold
};

/// `summary`: JSON; not known if it has another shape.
[[nodiscard]] Outcome read_outcome(const std::string& summary);

}  // namespace surefoot::explain
