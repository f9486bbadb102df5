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

/// Something that the planner did, or the operator of a run that was steered; a force from outside
/// that began or ended; another mode of the command, as of a safety stop; the end of the run.
struct NearbyEvent {
  double time = 0.0;  ///< [s]
  std::string text;
  std::string leg;             ///< that it happened to: "RF"; empty: none
  std::string by = "planner";  ///< "operator", "outside", "controller", "run"
};

/// A row of a higher level, and what it cost a level that gave way by itself.
struct CostlyRow {
  std::string level, row;
  double cost = 0.0;  ///< in the unit of the level that gave way; 0: nothing alone; NaN: not known
  std::vector<CostlyRow> same;  ///< others that say the same: the cost is of all together
  bool is_limit = false;        ///< an inequality
};

/// What held each level of a tick back, by its number in the header.
using ExactCosts = std::map<std::int16_t, std::vector<CostlyRow>>;

/// A tick beside another.
struct NeighbourTick {
  TickRecord tick;
  std::vector<std::int16_t> order;  ///< as of a TickExplanation
  std::optional<ExactCosts> exact;  ///< the same
};

/// On the way from one hierarchy to another, as after a change of the order: the torques lie
/// between the optima of both.
struct HierarchyBlend {
  double until = kNaN;  ///< the first tick behind it [s]; NaN: the log does not have it
  std::string change;   ///< what it came from, in words; empty: not known
  std::optional<NeighbourTick> before, after;  ///< the last tick of the one, the first of the other
};

/// One tick of a log, with what is needed to say why it came out so.
struct TickExplanation {
  std::string log;            ///< that it is of
  logging::LogHeader header;  ///< without its attachments
  TickRecord tick;
  CommandedForces forces;            ///< of the tick
  std::optional<TickTiming> timing;  ///< of logs that have it
  std::vector<std::int16_t> order;   ///< numbers in the header of the tick's levels, highest first
  std::optional<simulation::GroundTruth> truth;  ///< of logs that have it
  std::optional<GroundTouch> touch;              ///< up to the tick, the same
  std::vector<logging::AppliedForce> applied;    ///< from outside, as the truth has it
  std::vector<std::string> bodies;  ///< names by their row of the truth's `xfrc_applied`
  std::optional<evaluation::AlignedEstimate> estimate;                     ///< the same
  std::map<std::pair<std::int16_t, std::int32_t>, std::string> row_names;  ///< by level and id
  std::optional<HierarchyBlend> blend;                                     ///< that the tick is in
  /// See `explain_tick`; without it the costs are those of the log, estimates of the loop.
  std::optional<ExactCosts> exact;
  std::string why_estimates;        ///< why there are no exact costs; empty: it was not tried
  std::vector<NearbyEvent> events;  ///< around the tick, in order
  double asked = kNaN;              ///< [s]
  bool is_behind_end = false;       ///< the log ends before that; the tick is its last
  std::string problem;              ///< why the log could not be read further; empty if it could

  /// "com_xy gave way by 0.31 m/s² to torque_limits LF_KFE (0.2) and friction_cone RH (0.1)." Of a
  /// solve that was cut off also where. Of a blend of two hierarchies that it is one, until when,
  /// and the same of the ticks before and behind it.
  [[nodiscard]] std::string sentence() const;
  /// For people: the sentence, then state, command, feet, levels, rows at a bound and the events
  /// around the tick.
  [[nodiscard]] std::string text() const;
  /// The same, whole, for programs, as JSON: the tick's messages as they stand in the log, and what
  /// was made of them. SI units.
  [[nodiscard]] std::string json() const;
};

/// How far around a tick events are told [s].
inline constexpr double kEventWindow = 1.0;

/// The tick next to a time; the last one for the time at which the log's duration ends, which is
/// one period behind it. Throws FileError as LogReader does, and Error, with the range, where
/// the log has no tick at that time.
[[nodiscard]] TickExplanation read_tick(const std::string& path, double time);

/// What happened in all of a log. Throws FileError as LogReader does.
[[nodiscard]] std::vector<NearbyEvent> read_events(const std::string& path);

/// That solving a level took, by its number in the header [µs]; NaN: not measured.
[[nodiscard]] double level_time(const TickExplanation& explanation, std::size_t level);

/// Share of the round friction cone of the true ground that its force uses; NaN of a foot without
/// load.
[[nodiscard]] double true_friction_use(const simulation::TrueContact& contact);

}  // namespace surefoot::explain
