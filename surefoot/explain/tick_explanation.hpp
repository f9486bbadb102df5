#pragma once

#include "surefoot/evaluation/start_alignment.hpp"
#include "surefoot/explain/commanded_force.hpp"
#include "surefoot/explain/lying_text.hpp"
#include "surefoot/logging/applied_force.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::explain {

/// An event of the planner, a change by the operator of a steered run, the begin or end of an
/// external force, a change of the command's mode (a safety stop), or the end of the run.
struct NearbyEvent {
  double time = 0.0;  ///< [s]
  std::string text;
  std::string leg;             ///< "RF"; empty: of no leg
  std::string by = "planner";  ///< "operator", "outside", "controller", "run"
};

/// A row of a higher level, and its cost for a level that gave way.
struct CostlyRow {
  std::string level, row;
  double cost = 0.0;  ///< in the unit of the level that gave way; 0: none alone; NaN: not known
  std::vector<CostlyRow> same;  ///< rows that ask for the same: `cost` is of all together
  bool is_limit = false;        ///< an inequality
};

/// Rows that held each level of a tick back, by the level's number in the header.
using ExactCosts = std::map<std::int16_t, std::vector<CostlyRow>>;

/// The tick before or after a blend.
struct NeighbourTick {
  TickRecord tick;
  std::vector<std::int16_t> order;  ///< as in TickExplanation
  std::optional<ExactCosts> exact;  ///< as in TickExplanation
};

/// Transition from one hierarchy to another, e.g. after a change of the order: the torques lie
/// between the optima of both.
struct HierarchyBlend {
  double until = kNaN;                         ///< first tick after it [s]; NaN: not in the log
  std::string change;                          ///< its cause, in words; empty: not known
  std::optional<NeighbourTick> before, after;  ///< last tick before it, first tick after it
};

/// One tick of a log, with what is needed to explain it.
struct TickExplanation {
  std::string log;            ///< its path
  logging::LogHeader header;  ///< without its attachments
  TickRecord tick;
  CommandedForces forces;            ///< of the tick
  std::optional<TickTiming> timing;  ///< if the log has it
  std::vector<std::int16_t> order;   ///< its levels' numbers in the header, highest first
  std::optional<simulation::GroundTruth> truth;  ///< if the log has it
  std::optional<GroundTouch> touch;              ///< up to the tick, from the truth
  std::vector<logging::AppliedForce> applied;    ///< external forces, from the truth
  std::vector<std::string> bodies;  ///< names by their row of the truth's `xfrc_applied`
  std::optional<evaluation::AlignedEstimate> estimate;  ///< if the log has the truth
  std::map<std::pair<std::int16_t, std::int32_t>, std::string> row_names;  ///< by level and id
  std::optional<HierarchyBlend> blend;  ///< if the tick is in one
  /// See `explain_tick`; if empty, the costs are the log's, which the control loop estimated.
  std::optional<ExactCosts> exact;
  std::string why_estimates;        ///< why there are no exact costs; empty: not asked for
  std::vector<NearbyEvent> events;  ///< around the tick, in order
  double asked = kNaN;              ///< time asked for [s]
  bool is_behind_end = false;       ///< the log ends before that time; the tick is its last
  std::string problem;              ///< why the log could not be read further; empty if it could

  /// "com_xy gave way by 0.31 m/s² to torque_limits LF_KFE (0.2) and friction_cone RH (0.1)." Says
  /// where a solve was cut off. In a blend of two hierarchies it says so, until when, and the same
  /// for the ticks before and after it.
  [[nodiscard]] std::string sentence() const;
  /// For people: the sentence, then state, command, feet, levels, rows at a bound and the events
  /// around the tick.
  [[nodiscard]] std::string text() const;
  /// The same, whole, for programs, as JSON: the tick's messages as they stand in the log, and what
  /// was made of them. SI units.
  [[nodiscard]] std::string json() const;
};

/// Events within this time of a tick are part of its explanation [s].
inline constexpr double kEventWindow = 1.0;

/// The tick nearest to a time, without exact costs. The log's duration ends one period after its
/// last tick; for that time it is the last tick. Throws FileError as LogReader does, and Error,
/// with the log's range, if the log has no tick at that time.
[[nodiscard]] TickExplanation read_tick(const std::string& path, double time);

/// All events of a log. Throws FileError as LogReader does.
[[nodiscard]] std::vector<NearbyEvent> read_events(const std::string& path);

/// Time of solving a level, by its number in the header [µs]; NaN: not measured.
[[nodiscard]] double level_time(const TickExplanation& explanation, std::size_t level);

/// Share of the true ground's friction cone that a foot's force uses; NaN for a foot without load.
/// `least_load`: see LogRobot.
[[nodiscard]] double true_friction_use(const simulation::TrueContact& contact, double least_load);

}  // namespace surefoot::explain
