#pragma once

#include "surefoot/model/urdf.hpp"

#include <string>
#include <vector>

namespace surefoot::model {

/// Names of the joints that move but have no <axis>, so that they turn about x. The file is read
/// again; throws FileError if it can't be.
[[nodiscard]] std::vector<std::string> joints_without_axis(const Urdf& urdf);

/// What stands in an attribute of a joint's <limit>, a number or not; empty: nothing. Reads the
/// file again, too.
[[nodiscard]] std::string written_limit(const Urdf& urdf, const std::string& joint,
                                        const char* attribute);

}  // namespace surefoot::model
