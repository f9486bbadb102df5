#include "surefoot/tasks/task_rows.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/math/numbers.hpp"

#include <cmath>
#include <string>

namespace surefoot::tasks {
namespace {

constexpr double kLargest = 1e100;  // products of two, and their sums, must stay finite

bool is_too_large(double bound) { return std::isfinite(bound) && std::abs(bound) > kLargest; }

bool has_wrong_bounds(double lower, double upper) {
  return !(lower <= upper) || lower == kInfinity || upper == -kInfinity;
}

/// " (LF normal force)"; empty where the task has no name for the row.
std::string named(const Task& task, int id) noexcept {
  try {
    return " (" + task.row_name(id) + ")";
  } catch (...) {
    return {};
  }
}

std::string what_is_wrong_in(const Task& task, const solver::Level& level, Eigen::Index row) {
  const int id = level.id(row) - task.first_id();
  const double lower = level.lower()[row], upper = level.upper()[row];
  if (id < 0 || id >= task.num_ids())
    return " with an id that is not from first_id() to first_id() + num_ids() - 1";
  if (!level.A().row(row).allFinite()) return named(task, id) + " with NaN or infinity in A";
  if (!(level.A().row(row).array().abs() <= kLargest).all() || is_too_large(lower) ||
      is_too_large(upper))
    return named(task, id) + " with a number above 1e100, with which no solver can calculate";
  if (has_wrong_bounds(lower, upper))
    return named(task, id) + formatted(" with the bounds %g and %g", lower, upper) +
           "; two numbers, the lower first, would be valid";
  return {};
}

}  // namespace

void check_sizes(const Task& task, std::string_view name) {
  const std::string who = "task \"" + std::string(name) + "\" ";
  if (task.name() != name) {
    throw Error(who + "has the name() \"" + std::string(task.name()) +
                "\"; give the name of its definition");
  }
  if (task.max_rows() < 0 || task.max_rows() > Task::kMostRows) {
    throw Error(who + "has max_rows() " + std::to_string(task.max_rows()) +
                "; give the largest number of rows in a tick, from 0 to " +
                std::to_string(Task::kMostRows));
  }
  if (task.num_ids() < task.max_rows()) {
    throw Error(who + "has num_ids() " + std::to_string(task.num_ids()) + " and max_rows() " +
                std::to_string(task.max_rows()) + "; each row of a tick needs an id of its own");
  }
}

std::string what_is_wrong(const Task& task, const solver::Level& level, Eigen::Index first) {
  if (level.num_rows() < first) return "cleared the level; append rows with level.add()";
  if (level.has_overflowed() || level.num_rows() - first > task.max_rows())
    return "wrote more rows than its max_rows()";
  for (Eigen::Index row = first; row < level.num_rows(); ++row) {
    const std::string wrong = what_is_wrong_in(task, level, row);
    if (!wrong.empty()) return "wrote row " + std::to_string(row - first) + wrong;
  }
  return {};
}

}  // namespace surefoot::tasks
