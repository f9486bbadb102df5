#pragma once

#include "surefoot/config/hierarchy_json.hpp"

#include <string>
#include <vector>

namespace surefoot::config {

/// The hierarchy with its levels from `first` on, counted from 1, merged into one, each with its
/// weight (default 1). The reference of x stays the last level. Throws FileError, beginning with
/// `place`, for a level that does not exist and for more weights than levels.
[[nodiscard]] NamedHierarchy weighted_question(const NamedHierarchy& strict, int first,
                                               const std::vector<double>& weights,
                                               const std::string& place);

/// √Σ violation² of each level at x.
[[nodiscard]] std::vector<double> residuals_at(const solver::Hierarchy& hierarchy,
                                               const Eigen::VectorXd& x);

}  // namespace surefoot::config
