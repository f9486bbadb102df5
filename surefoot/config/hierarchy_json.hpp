#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::config {

/// A hierarchy with the names of its rows.
struct NamedHierarchy {
  solver::Hierarchy hierarchy;
  std::vector<std::vector<std::string>> row_names;  ///< of each level, of each row
  std::vector<std::string> units;                   ///< of each level's rows; empty: not given
  std::vector<std::vector<double>> weights = {};    ///< of each level, of each row
  bool has_reference = false;                       ///< the last level is the line's "x_ref"
};

/// A hierarchy from one line of a .jsonl file:
///
///     {"levels": [{"A": [[…]], "b": […], "D": [[…]], "f": […]}, …]}
///
/// for A x = b and D x ≤ f (Eq. 8). An empty or missing block has no rows. "lower", with or without
/// f, gives lower ≤ D x ≤ f, where null means no bound. The length of the rows is the number of
/// unknowns. Optional members of a level:
///
/// - "name", and the "unit" of its rows
/// - "A_names", "D_names": a text for each row; default "A 1", "D 3", …
/// - "A_ids", "D_ids": identify a row across lines, unique in a level (Level::id); default 0, 1, …
/// - "A_weights", "D_weights": factors on each row and its bounds; results are of weighted rows
/// - "damping": see `add_damping`; its rows are "damping 1", …
///
/// "x_ref", next to "levels", adds a last level of this name that pulls x to these values, with the
/// rows "x 1", … (`add_reference`); damping then pulls to x_ref instead of 0.
///
/// Numbers are from −1e100 to 1e100. A row is zero or has an element of magnitude at least 1e-100.
/// Throws FileError, beginning with `place` ("file:line"), for anything else.
[[nodiscard]] NamedHierarchy parse_hierarchy(std::string_view line, const std::string& place);

/// The name of a row, by the indices of level and row.
using RowName = std::function<std::string(std::size_t, Eigen::Index)>;

/// The line for a hierarchy, without a line break. Numbers, names and ids read back the same; each
/// level starts with its equalities. Rows without bounds are omitted, as is "lower" in a level
/// without lower bounds. `row_name` adds the rows' names, `units` a level's "unit" if not empty.
[[nodiscard]] std::string format_hierarchy(const solver::Hierarchy& hierarchy,
                                           const RowName& row_name = nullptr,
                                           const std::vector<std::string>& units = {});

}  // namespace surefoot::config
