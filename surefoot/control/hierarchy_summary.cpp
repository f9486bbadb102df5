#include "surefoot/control/hierarchy_summary.hpp"

#include "surefoot/solver/row_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot::control {
namespace {

constexpr std::size_t kMaxPerLevel = 3;  // blockers, or missed equalities
constexpr double kMinShare = 0.1;        // of the largest cost or error

static_assert(kMaxReportedMisses >= kMaxPerLevel * kMaxLevels);

double violation(const solver::Level& level, Eigen::Index row, const Eigen::VectorXd& x) {
  return solver::signed_violation(level.A().row(row).dot(x), level.lower()[row],
                                  level.upper()[row]);
}

bool is_beyond(solver::RowState state) {
  return state == solver::RowState::below_lower || state == solver::RowState::above_upper;
}

void add_active_rows(const solver::LevelResult& result, const solver::Level& level,
                     std::size_t index, const Eigen::VectorXd& x, HierarchyReport& report) {
  const Eigen::Index rows = std::min(result.num_rows, level.num_rows());
  for (Eigen::Index i = 0; i < rows; ++i) {
    const solver::RowState state = result.rows[static_cast<std::size_t>(i)];
    if (state == solver::RowState::inactive || state == solver::RowState::equality) continue;
    if (report.num_active == static_cast<std::int32_t>(kMaxReportedRows)) return;
    report.active[static_cast<std::size_t>(report.num_active++)] = {
        static_cast<std::int16_t>(index), static_cast<std::int16_t>(state), level.id(i),
        is_beyond(state) ? violation(level, i, x) : 0.0};
  }
}

/// The largest errors, in descending order.
struct WorstMisses {
  std::array<MissedEquality, kMaxPerLevel + 1> rows{};  // the last is discarded
  std::size_t count = 0;

  void add(const MissedEquality& row) {
    std::size_t at = count;
    for (; at > 0 && std::abs(rows[at - 1].by) < std::abs(row.by); --at) rows[at] = rows[at - 1];
    rows[at] = row;
    count = std::min(count + 1, kMaxPerLevel);
  }
};

void add_missed_rows(const solver::LevelResult& result, const solver::Level& level,
                     std::size_t index, const Eigen::VectorXd& x, HierarchyReport& report) {
  if (!(result.residual > kResidualRounding)) return;
  WorstMisses worst;
  const Eigen::Index rows = std::min(result.num_rows, level.num_rows());
  for (Eigen::Index i = 0; i < rows; ++i) {
    if (result.rows[static_cast<std::size_t>(i)] != solver::RowState::equality) continue;
    worst.add({static_cast<std::int16_t>(index), level.id(i), violation(level, i, x)});
  }
  const double least = std::max(kResidualRounding, kMinShare * std::abs(worst.rows.front().by));
  for (std::size_t i = 0; i < worst.count && std::abs(worst.rows[i].by) >= least; ++i)
    report.missed[static_cast<std::size_t>(report.num_missed++)] = worst.rows[i];
}

void add_blockers(const solver::LevelBlockers& blockers, const solver::Hierarchy& hierarchy,
                  std::size_t level, HierarchyReport& report) {
  for (std::size_t i = 0; i < std::min(blockers.count, kMaxPerLevel); ++i) {
    const solver::Blocker& blocker = blockers.dearest[i];
    if (i > 0 && blocker.cost < kMinShare * blockers.dearest[0].cost) return;
    if (report.num_blocking == static_cast<std::int32_t>(kMaxReportedBlockers)) return;
    report.blocking[static_cast<std::size_t>(report.num_blocking++)] = {
        static_cast<std::int16_t>(level), static_cast<std::int16_t>(blocker.at.level),
        hierarchy.level(blocker.at.level).id(blocker.at.row), blocker.multiplier, blocker.cost};
  }
}

}  // namespace

void summarise(const solver::Solution& solution, const solver::Hierarchy& hierarchy,
               HierarchyReport& report) noexcept {
  report = HierarchyReport{};
  report.status = static_cast<std::int32_t>(solution.status);
  report.failed_level = solution.failed_level;
  report.borderline = solution.borderline;
  const std::size_t count = std::min({solution.levels.size(), hierarchy.num_levels(), kMaxLevels});
  report.num_levels = static_cast<std::int32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const solver::LevelResult& result = solution.levels[i];
    report.levels[i] = {result.residual, static_cast<std::int32_t>(result.degrees_of_freedom_left),
                        result.iterations, static_cast<std::int32_t>(result.num_rows),
                        result.num_active()};
    add_active_rows(result, hierarchy.level(i), i, solution.x, report);
    add_missed_rows(result, hierarchy.level(i), i, solution.x, report);
  }
}

void summarise_blockers(std::span<const solver::LevelBlockers> blockers,
                        const solver::Hierarchy& hierarchy, HierarchyReport& report) noexcept {
  const auto count = static_cast<std::size_t>(report.num_levels);
  report.num_blocking = 0;
  report.blocking_is_known = blockers.size() >= count;
  for (std::size_t k = 0; k < std::min(count, blockers.size()); ++k) {
    report.blocking_is_known = report.blocking_is_known && blockers[k].is_known;
    add_blockers(blockers[k], hierarchy, k, report);
  }
}

}  // namespace surefoot::control
