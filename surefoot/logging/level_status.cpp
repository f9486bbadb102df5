#include "surefoot/logging/level_status.hpp"

#include "surefoot/logging/hierarchy_status.hpp"

namespace surefoot::logging {

LevelStatus level_status(const LevelReport& level) {
  if (level.num_rows == 0) return LevelStatus::no_rows;
  return level.residual > kResidualRounding ? LevelStatus::missed : LevelStatus::met;
}

LevelStatus level_status(const HierarchyReport& report, std::size_t place) {
  if (report.status == kInvalidInput) return LevelStatus::not_solved;
  if (report.status == kIterationCap && report.failed_level >= 0) {
    const auto failed = static_cast<std::size_t>(report.failed_level);
    if (place == failed) return LevelStatus::cut_off;
    if (place > failed) return LevelStatus::not_reached;
  }
  return level_status(report.levels[place]);
}

}  // namespace surefoot::logging
