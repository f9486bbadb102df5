#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <string>
#include <string_view>

namespace surefoot {

/// A hierarchy from one line of a .jsonl file:
///
///     {"levels": [{"A": [[…]], "b": […], "D": [[…]], "f": […]}, …]}      A x = b and D x ≤ f (Eq.
///     8)
///
/// An empty or missing block has no rows; other members are ignored. The number of unknowns is the
/// length of the rows. `place` ("file:line") starts the message of the FileError that is thrown for
/// anything else.
[[nodiscard]] Hierarchy parse_hierarchy(std::string_view line, const std::string& place);

/// The line for a hierarchy, without a line break. Numbers read back to the same doubles. A row
/// between two bounds becomes two rows of D, lower ≤ a x as −a x ≤ −lower. Beside the blocks each
/// level has its "name".
[[nodiscard]] std::string format_hierarchy(const Hierarchy& hierarchy);

}  // namespace surefoot
