#include "surefoot/control/hierarchy_summary.hpp"

#include <algorithm>

namespace surefoot {
namespace {

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

}  // namespace

void summarise(const Solution& solution, const Hierarchy& hierarchy,
               HierarchyReport& report) noexcept {
  report = HierarchyReport{};
  report.status = static_cast<std::int32_t>(solution.status);
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

}  // namespace surefoot
