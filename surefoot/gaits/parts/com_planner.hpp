#pragma once

#include "surefoot/gaits/parts/support_region.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace surefoot {

/// A stretch of the gait with one set of feet down.
struct SupportPhase {
  static constexpr double kAnyReach = std::numeric_limits<double>::infinity();
  double duration = 0.0;  ///< [s]
  PerLeg<Vec2> feet{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(),
                    Vec2::Zero()};  ///< footholds, x and y in W
  PerLeg<double> heights{};         ///< of the footholds over where `height` counts from [m]
  PerLeg<bool> down{};              ///< carries force for (part of) this phase
  PerLeg<double> loaded_for{};  ///< time since touchdown at the phase's begin; ramps f_max up [s]
  PerLeg<double> lifts_in{};  ///< time to lift-off at the phase's begin; ramps down; ∞ if none [s]
  PerLeg<Vec2> hips{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(),
                    Vec2::Zero()};  ///< from the COM, x and y in W [m]
  PerLeg<double> reach{kAnyReach, kAnyReach, kAnyReach,
                       kAnyReach};  ///< of a foot on its foothold from its hip, horizontally [m]
  double zmp_margin_max = std::numeric_limits<double>::infinity();  ///< takes the place of a
                                                                    ///< greater zmp_margin [m]
  bool must_rest = false;  ///< the capture point stays inside: the phase may have to wait
};

/// What acts on the robot beside its weight and the ground: it moves the ZMP by
/// h · force + moment.
struct ComLoad {
  Vec2 force{0.0, 0.0};   ///< horizontal, at the COM, as a share of the weight
  Vec2 moment{0.0, 0.0};  ///< (τ_y, −τ_x) over the weight [m]
};

/// The COM trajectory of the paper's ZMP walk: one quintic Hermite spline a phase, whose knots
/// (position, velocity, acceleration in x and y) come from one strict hierarchy:
///
///   1. the ZMP  p − (h/g) p̈ + d  inside the shrinking and switching support region, by a margin:
///      h is the height over the edge in question, for what tips the robot is the moment about that
///      line; d is what the load moves it by. Against a load also the force along the ground within
///      what friction gives, and the hips where the legs reach them
///   2. the capture point  p + √(h/g) ṗ + d  inside the triangle of a swing, by a margin; against a
///      load inside the region of every phase
///   3. ∫ ‖p̈‖² dt least (Gauss quadrature), end of the horizon drawn to the centre of its feet
///
/// Levels 1 and 2 are inequalities: when they can't be met they are violated as little as possible,
/// never infeasible. Winkler 2015 and Kalakrishnan 2011 have the QP, the hierarchy replaces their
/// weights. Allocates at construction only.
class ComPlanner {
 public:
  static constexpr int kMaxPhases = 10;
  /// Swings that fit: each with the support before it, and the support after the last.
  static constexpr int kMaxSteps = (kMaxPhases - 1) / 2;

  ComPlanner(const ComPlannerOptions& options, const ForceOptions& force, double robot_weight);

  /// What the robot weighs, in the plans that follow [N].
  void weigh(double weight) { weight_ = weight; }
  /// Borne by the plans that follow, from their begin to their end.
  void bear(const ComLoad& load) { next_load_ = load; }
  /// μ that the feet have together, in the plans that follow, along the sides of pyramids that look
  /// where the heading does.
  void stand_on(double friction, double heading) {
    friction_ = friction;
    friction_axes_ = {Vec2(std::cos(heading), std::sin(heading)),
                      Vec2(-std::sin(heading), std::cos(heading))};
  }
  void clear() { num_phases_ = 0; }
  /// Appends a phase; ignored beyond kMaxPhases or shorter than a millisecond.
  void add(const SupportPhase& phase) noexcept;

  /// Plans through the phases added, from `begin` at `time`. `height` is that of the COM over the
  /// support, `end_velocity` the one at the end of the horizon. To the end the COM is drawn softly,
  /// for a next plan comes before it, unless this is the last one and `comes_to_rest` there. With
  /// numbers that are not finite the plan before stays in force.
  void plan(double time, const Motion<Vec2>& begin, double height, const Vec2& end_velocity,
            bool comes_to_rest = false) noexcept;

  /// The plan at a time; after its end it stays where it ended.
  [[nodiscard]] ComPlan at(double time) const noexcept;
  [[nodiscard]] double end_time() const;
  /// How far the ZMP of the plan had to leave the (unshrunk) region [m].
  [[nodiscard]] double zmp_slack() const { return zmp_slack_; }
  /// What the last plan was made from, and the answer: for those who check it.
  [[nodiscard]] const Hierarchy& hierarchy() const { return last_problem().hierarchy; }
  [[nodiscard]] const Solution& solution() const { return last_problem().solver.solution(); }
  /// Share of the weight that a foot can carry `t` after the begin of a phase.
  [[nodiscard]] double share(const SupportPhase& phase, std::size_t leg, double t) const;

 private:
  /// The hierarchy and its solver for one number of phases.
  struct Problem {
    Hierarchy hierarchy;
    LexicographicSolver solver;
    explicit Problem(Hierarchy h)
        : hierarchy(std::move(h)), solver(hierarchy, {.rank = kRank, .warm_start = false}) {}
  };
  static Hierarchy make_hierarchy(int phases);
  [[nodiscard]] const Problem& last_problem() const {
    return *problems_[static_cast<std::size_t>(std::max(planned_, 1) - 1)];
  }

  /// Coarse: what hardly moves a row of the plan isn't worth bending a spline for.
  static constexpr RankTolerance kRank{.solve = 1e-8, .keep = 1e-12};

  void guess_knots(double time, const Motion<Vec2>& begin) noexcept;
  /// h/g of the COM over an edge of the region [s²].
  [[nodiscard]] double pendulum(const HalfPlane& edge) const noexcept;
  /// d of a COM `height` over the feet [m].
  [[nodiscard]] Vec2 load_shift(double height) const noexcept;
  void write_region_rows(Hierarchy& hierarchy, int phase) const noexcept;
  enum class Point { zmp, capture_point };
  /// Rows  n·point ≤ offset − margin  for every edge of the region, at t in a phase.
  void write_inside_rows(Level& level, int phase, double t, const SupportRegion& region,
                         double margin, Point point) const noexcept;
  /// Rows  ±(h/g p̈ − h f) ≤ share μ h  on both axes: what the feet push along the ground.
  void write_friction_rows(Level& level, int phase, double t) const noexcept;
  /// Rows  e·(p + hip − foot) ≤ reach  for every foot that is down, with the direction e from foot
  /// to hip at the guess.
  void write_reach_rows(Level& level, int phase, double t) const noexcept;
  void write_smoothness_rows(Level& level, int phase) const noexcept;
  void write_terminal_rows(Level& level, const Vec2& end_velocity, double weight) const noexcept;
  /// Adds scale · (w · boundary values of a phase) on one axis to row i; returns their value at the
  /// guess.
  double add_terms(Rows& rows, Eigen::Index i, int phase, int axis, const HermiteWeights& w,
                   double scale) const noexcept;
  [[nodiscard]] SupportRegion region_at(const SupportPhase& phase, double t) const noexcept;
  [[nodiscard]] Motion<Vec2> evaluate(int phase, double t) const noexcept;
  void measure_slack() noexcept;

  ComPlannerOptions options_;
  ForceOptions force_;
  double weight_;
  std::array<SupportPhase, kMaxPhases> phases_{};
  int num_phases_ = 0;
  double begin_time_ = 0.0;
  double height_ = 0.5;
  double zmp_slack_ = 0.0;
  double friction_ = 0.5;
  std::array<Vec2, 2> friction_axes_{Vec2::UnitX(), Vec2::UnitY()};
  ComLoad load_, next_load_;
  // By number of phases. Copies of a planner share them, as they remember nothing; so of these one
  // plans at a time.
  std::vector<std::shared_ptr<Problem>> problems_;
  // The plan in force: kept apart from the phases being added.
  std::array<Motion<Vec2>, kMaxPhases + 1> knots_;
  std::array<double, kMaxPhases> durations_{};
  int planned_ = 0;
};

}  // namespace surefoot
