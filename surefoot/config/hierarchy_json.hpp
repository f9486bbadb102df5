#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::config {

/// A hierarchy and what people call its rows.
struct NamedHierarchy {
  solver::Hierarchy hierarchy;
  std::vector<std::vector<std::string>> row_names;  ///< of each level, of each row
  std::vector<std::string> units;                   ///< of each level's rows; empty: not given
  std::vector<std::vector<double>> weights = {};  ///< of each level, by which each row was weighed
  bool has_reference = false;  ///< the last level is "x_ref" of the line, and none of its levels
};

/// A hierarchy from one line of a .jsonl file:
///
///     {"levels": [{"A": [[…]], "b": […], "D": [[…]], "f": […]}, …]}      A x = b and D x ≤ f (Eq.
///     8)
///
/// An empty or missing block has no rows. With "lower" beside f or alone, lower ≤ D x ≤ f; null is
/// no bound there, and a row that has none at all asks for nothing. A level may have a "name", its
/// blocks "A_names" and "D_names", a text for each row; without them rows are called "A 1", "D 3";
/// "A_ids" and "D_ids", by which rows are known from line to line (Level::id) and none of which a
/// level has twice, else they are counted; and its rows a "unit"; "A_weights" and "D_weights", by
/// which each row and its bounds are multiplied (`Rows::weigh`: all that is told of a row is of the
/// weighted one); and a "damping" (`add_damping`, its rows are called "damping 1", …). Beside the
/// levels "x_ref" is what x is to be close to: a last level of this name, with the rows "x 1", …
/// (`add_reference`), and what damping pulls to instead of 0. The number of unknowns is the length
/// of the rows. `place`
/// ("file:line") starts the message of the FileError that is thrown for anything else, also for
/// other members. Numbers are finite and from −1e100 to 1e100, all of which are bounds: only null
/// is none. A row of A or D is zero or has an element of at least 1e-100, either way.
[[nodiscard]] NamedHierarchy parse_hierarchy(std::string_view line, const std::string& place);

/// What a row is called: level and row, as indices.
using RowName = std::function<std::string(std::size_t, Eigen::Index)>;

/// The line for a hierarchy, without a line break. Numbers, names and ids read back the same; in a
/// level equalities come first. With `row_name` rows have their names, and with `units` a level its
/// "unit" where that is not empty. "lower" is there where a row of the level has such a bound; rows
/// without any are left out.
[[nodiscard]] std::string format_hierarchy(const solver::Hierarchy& hierarchy,
                                           const RowName& row_name = nullptr,
                                           const std::vector<std::string>& units = {});

}  // namespace surefoot::config
