#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surefoot {

inline constexpr std::size_t kMaxLevels = 16;
inline constexpr std::size_t kMaxReportedRows = 96;
inline constexpr std::size_t kMaxReportedBlockers = 48;
inline constexpr std::size_t kMaxReportedMisses = 48;

/// Below it a residual, or what a row costs a level, is the solver's rounding, in every unit.
inline constexpr double kResidualRounding = 1e-6;

/// How one level of the hierarchy came out at one tick.
struct LevelReport {
  double residual = 0.0;  ///< √Σ violation², in the rows' unit; NaN: not solved
  std::int32_t degrees_of_freedom_left = 0;
  std::int32_t iterations = 0;
  std::int32_t num_rows = 0;
  std::int32_t num_active = 0;  ///< inequality rows at or beyond a bound
};

/// An inequality row at or beyond a bound.
struct ActiveRow {
  std::int16_t level = 0;
  std::int16_t state = 0;  ///< RowState of the solver: ±1 at a bound, ±3 beyond it
  std::int32_t id = 0;     ///< identifies the row across ticks; names stand in the log's header
  /// How far beyond the bound, in the rows' unit: positive above the upper one, negative below the
  /// lower one, 0 at it; NaN: not known.
  double by = 0.0;
};

/// An equality row that its level could not reach.
struct MissedEquality {
  std::int16_t level = 0;
  std::int32_t id = 0;  ///< of the row in its level
  double by = 0.0;      ///< a x − b, in the rows' unit
};

/// A row of a higher level that kept a level from a smaller residual.
struct BlockingRow {
  std::int16_t level = 0;     ///< that was held back
  std::int16_t by_level = 0;  ///< of the row
  std::int32_t id = 0;        ///< of the row in its level
  double multiplier = 0.0;    ///< ∂ ½ residual² / ∂ bound of the row, its size
  double cost = 0.0;          ///< estimate of what the residual falls by without it (BlockerSearch)
};

/// What happens to a level from a tick on.
enum class LevelChange : std::int8_t { stays = 0, comes = 1, goes = -1 };

/// A switch of levels that was asked for between two ticks, beside those of the options.
struct LevelSwitchReport {
  bool begins = false;    ///< at this tick
  double duration = 0.0;  ///< [s]
  std::array<LevelChange, kMaxLevels> change{};
};

/// How the hierarchy came out at one tick: plain data for the log and the viewer.
struct HierarchyReport {
  std::int32_t status = 0;  ///< SolveStatus; invalid_input also where no state was believed
  /// Where it ended early; −1: nowhere. The number of no level: all are optimal, x not the
  /// shortest.
  std::int32_t failed_level = -1;
  bool borderline = false;  ///< which answer is the optimum depends on less than doubles can tell
  std::int32_t num_levels = 0;
  std::int32_t num_active = 0;    ///< entries of `active`
  std::int32_t num_missed = 0;    ///< entries of `missed`
  std::int32_t num_blocking = 0;  ///< entries of `blocking`
  /// Whether the solver was asked, and can say of each level what holds it back.
  bool blocking_is_known = false;
  std::array<LevelReport, kMaxLevels> levels{};
  std::array<ActiveRow, kMaxReportedRows> active{};
  std::array<MissedEquality, kMaxReportedMisses> missed{};   ///< by level, worst first
  std::array<BlockingRow, kMaxReportedBlockers> blocking{};  ///< by level, dearest first
  /// Of the levels that come or go, 0 … 1; 1 where none does. Before, no lexicographic optimum.
  double transition_share = 1.0;
  LevelSwitchReport level_switch;
};

}  // namespace surefoot
