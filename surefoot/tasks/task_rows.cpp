#include "surefoot/tasks/task_rows.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/numbers.hpp"

#include <cmath>
#include <string>

namespace surefoot::tasks {
namespace {

constexpr double kLargest = 1e100;  // products of two, and their sums, must stay finite

bool is_too_large(double bound) { return std::isfinite(bound) && std::abs(bound) > kLargest; }

bool has_wrong_bounds(const solver::Level& level, Eigen::Index row) {
  const double lower = level.lower()[row], upper = level.upper()[row];
  return !(lower <= upper) || lower == kInfinity || upper == -kInfinity;
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

std::string_view what_is_wrong(const Task& task, const solver::Level& level, Eigen::Index first) {
  if (level.num_rows() < first) return "cleared the level; append rows with level.add()";
  if (level.has_overflowed() || level.num_rows() - first > task.max_rows())
    return "wrote more rows than its max_rows()";
  for (Eigen::Index row = first; row < level.num_rows(); ++row) {
    const int id = level.id(row) - task.first_id();
    if (id < 0 || id >= task.num_ids())
      return "wrote a row whose id is not from first_id() to first_id() + num_ids() - 1";
    if (!level.A().row(row).allFinite()) return "wrote NaN or infinity into A";
    if (!(level.A().row(row).array().abs() <= kLargest).all() || is_too_large(level.lower()[row]) ||
        is_too_large(level.upper()[row]))
      return "wrote a number above 1e100, with which no solver can calculate";
    if (has_wrong_bounds(level, row))
      return "wrote a row whose bounds are NaN, or whose lower bound is above the upper";
  }
  return {};
}

}  // namespace surefoot::tasks
