#pragma once

#include "surefoot/config/hierarchy_json.hpp"

#include <string>
#include <vector>

namespace surefoot::config {

/// The question with its levels from `first` on, counted from 1, as one level, in which each
/// counts with its weight (1 where there is none). What x is to be close to stays a last level
/// below it. Throws FileError, which begins with `place`, for a level that there isn't and for more
/// weights than levels.
[[nodiscard]] NamedHierarchy weighted_question(const NamedHierarchy& strict, int first,
                                               const std::vector<double>& weights,
                                               const std::string& place);

/// √Σ violation² of each level at x.
[[nodiscard]] std::vector<double> residuals_at(const solver::Hierarchy& hierarchy,
                                               const Eigen::VectorXd& x);

}  // namespace surefoot::config
