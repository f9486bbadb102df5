#include "surefoot/control/hierarchy_summary.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr std::size_t kMostBlockers = 3;  // of a level
constexpr double kSmallestShare = 0.1;    // of the cost of the dearest

void add_active_rows(const LevelResult& result, const Level& level, std::size_t index,
                     HierarchyReport& report) {
  const Eigen::Index rows = std::min(result.num_rows, level.num_rows());
  for (Eigen::Index i = 0; i < rows; ++i) {
    const RowState state = result.rows[static_cast<std::size_t>(i)];
    if (state == RowState::inactive || state == RowState::equality) continue;
    if (report.num_active == static_cast<std::int32_t>(kMaxReportedRows)) return;
    report.active[static_cast<std::size_t>(report.num_active++)] = {
        static_cast<std::int16_t>(index), static_cast<std::int16_t>(state), level.id(i)};
  }
}

void add_blockers(const LevelBlockers& blockers, const Hierarchy& hierarchy, std::size_t level,
                  HierarchyReport& report) {
  for (std::size_t i = 0; i < std::min(blockers.count, kMostBlockers); ++i) {
    const Blocker& blocker = blockers.dearest[i];
    if (i > 0 && blocker.cost < kSmallestShare * blockers.dearest[0].cost) return;
    if (report.num_blocking == static_cast<std::int32_t>(kMaxReportedBlockers)) return;
    report.blocking[static_cast<std::size_t>(report.num_blocking++)] = {
        static_cast<std::int16_t>(level), static_cast<std::int16_t>(blocker.at.level),
        hierarchy.level(blocker.at.level).id(blocker.at.row), blocker.multiplier, blocker.cost};
  }
}

}  // namespace

void summarise(const Solution& solution, const Hierarchy& hierarchy,
               HierarchyReport& report) noexcept {
  report = HierarchyReport{};
  report.status = static_cast<std::int32_t>(solution.status);
  report.failed_level = solution.failed_level;
  const std::size_t count = std::min({solution.levels.size(), hierarchy.num_levels(), kMaxLevels});
  report.num_levels = static_cast<std::int32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const LevelResult& result = solution.levels[i];
    report.levels[i] = {result.residual, static_cast<std::int32_t>(result.degrees_of_freedom_left),
                        result.iterations, static_cast<std::int32_t>(result.num_rows),
                        result.num_active()};
    add_active_rows(result, hierarchy.level(i), i, report);
  }
}

void summarise_blockers(std::span<const LevelBlockers> blockers, const Hierarchy& hierarchy,
                        HierarchyReport& report) noexcept {
  const auto count = static_cast<std::size_t>(report.num_levels);
  report.num_blocking = 0;
  report.blocking_is_known = blockers.size() >= count;
  for (std::size_t k = 0; k < std::min(count, blockers.size()); ++k) {
    report.blocking_is_known = report.blocking_is_known && blockers[k].is_known;
    add_blockers(blockers[k], hierarchy, k, report);
  }
}

}  // namespace surefoot
