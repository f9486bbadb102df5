#pragma once

#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/hierarchy.hpp"

#include <string>
#include <vector>

namespace surefoot {

/// Why an answer is not proven, or not judged: of the first level that isn't, because what is said
/// of those below hangs on it. Some level isn't proven.
[[nodiscard]] std::string verdict_text(const Hierarchy& hierarchy, const Eigen::VectorXd& x,
                                       const std::vector<LevelCertificate>& levels);

}  // namespace surefoot
