#pragma once

#include <string>
#include <vector>

namespace surefoot {

/// One of the paper's experiments, or one that asks a question about it: a scenario run once as it
/// stands, with a report, and perhaps over some random seeds.
struct Experiment {
  std::string name;  ///< also of its folder
  std::string scenario;
  std::vector<std::string> assignments;  ///< as for --set
  bool seeds = false;  ///< run also over random seeds; the same ones in every experiment
  std::vector<std::string> shown;  ///< metrics of the single run that tell the result
  bool as_found = false;           ///< an open question: any result is one
};

/// What the demo runs.
[[nodiscard]] const std::vector<Experiment>& experiments();

}  // namespace surefoot
