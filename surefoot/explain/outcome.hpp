#pragma once

#include <string>

namespace surefoot::explain {

/// How a run came out, by the summary of its log.
struct Outcome {
  bool known = false;        ///< there is a summary that can be read; else nothing is judged
  bool interrupted = false;  ///< from outside, or begun again; nothing is judged either
  bool succeeded = false;
  std::string reason;                      ///< why it ended
  std::size_t num_criteria = 0, held = 0;  ///< and how many of them hold
};

/// From JSON; a summary of another shape is none.
[[nodiscard]] Outcome read_outcome(const std::string& summary);

}  // namespace surefoot::explain
