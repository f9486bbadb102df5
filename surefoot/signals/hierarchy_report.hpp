#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surefoot {

inline constexpr std::size_t kMaxLevels = 16;
inline constexpr std::size_t kMaxReportedRows = 128;
inline constexpr std::size_t kMaxReportedBlockers = 48;
inline constexpr std::size_t kMaxReportedMisses = 48;

/// Smaller residuals and row costs are the solver's rounding, in every unit.
inline constexpr double kResidualRounding = 1e-6;

/// Result of one level of the hierarchy at one tick.
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
  std::int32_t id = 0;     ///< identifies the row across ticks; the log's header names it
  /// Distance beyond the bound, in the rows' unit: positive above the upper one, negative below the
  double by = 0.0;
};

/// An equality row that its level could not reach.
struct MissedEquality {
  std::int16_t level = 0;
  std::int32_t id = 0;  ///< of the row in its level
  double by = 0.0;      ///< a x − b, in the rows' unit
};

/// A row of a higher level that keeps a level from a smaller residual.
struct BlockingRow {
  std::int16_t level = 0;     ///< the level held back
  std::int16_t by_level = 0;  ///< level of the row
  std::int32_t id = 0;        ///< of the row in its level
  double multiplier = 0.0;    ///< |∂ ½ residual² / ∂ bound| of the row
  double cost = 0.0;          ///< estimated drop of the residual without it (BlockerSearch)
};

/// Does a level appear (`comes`) or disappear (`goes`) from a tick on?
enum class LevelChange : std::int8_t { stays = 0, comes = 1, goes = -1 };

/// A switch of levels requested between two ticks, besides those of the options.
struct LevelSwitchReport {
  bool begins = false;    ///< at this tick
  double duration = 0.0;  ///< [s]
  std::array<LevelChange, kMaxLevels> change{};
};

/// Result of the hierarchy at one tick: plain data for the log and the viewer.
struct HierarchyReport {
  std::int32_t status = 0;  ///< SolveStatus; invalid_input also without a valid state
  /// Level at which the solver stopped early; −1: none; num_levels: all levels are optimal, but x
  /// is not the shortest solution.
  std::int32_t failed_level = -1;
  bool borderline = false;  ///< rounding decides which answer is the optimum
  std::int32_t num_levels = 0;
  std::int32_t num_active = 0;    ///< entries of `active`
  std::int32_t num_missed = 0;    ///< entries of `missed`
  std::int32_t num_blocking = 0;  ///< entries of `blocking`
  /// Was the solver asked, and able, to say what holds each level back?
  bool blocking_is_known = false;
  std::array<LevelReport, kMaxLevels> levels{};
  std::array<ActiveRow, kMaxReportedRows> active{};
  std::array<MissedEquality, kMaxReportedMisses> missed{};   ///< by level, worst first
  std::array<BlockingRow, kMaxReportedBlockers> blocking{};  ///< by level, largest cost first
  /// Progress 0 … 1 of levels that come or go; 1 if none does. Below 1 there is no lexicographic
  /// optimum.
  double transition_share = 1.0;
  LevelSwitchReport level_switch;
};

}  // namespace surefoot
