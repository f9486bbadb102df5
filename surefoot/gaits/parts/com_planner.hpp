#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/gaits/parts/support_region.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"

#include <array>
#include <memory>
#include <vector>

namespace surefoot::gaits {

/// A phase of the gait with one set of feet down. Places are x and y in W [m], times are relative
/// to the phase's begin [s].
struct SupportPhase {
  SupportPhase() : SupportPhase(kNumLegs) {}
  explicit SupportPhase(int num_legs)
      : feet(num_legs, Vec2::Zero()),
        heights(num_legs, 0.0),
        down(num_legs, false),
        loaded_for(num_legs, 0.0),
        lifts_in(num_legs, kNever),
        hips(num_legs, Vec2::Zero()),
        reach(num_legs, kInfinity) {}

  double duration = 0.0;
  PerLeg<Vec2> feet;                  ///< footholds
  PerLeg<double> heights;             ///< of the footholds over the reference of `height` [m]
  PerLeg<bool> down;                  ///< carries force for (part of) this phase
  PerLeg<double> loaded_for;          ///< since touchdown; ramps f_max up
  PerLeg<double> lifts_in;            ///< to lift-off; ramps down
  PerLeg<Vec2> hips;                  ///< from the COM
  PerLeg<double> reach;               ///< of a foot from its hip, horizontally [m]
  double zmp_margin_max = kInfinity;  ///< upper limit of zmp_margin [m]
  bool must_rest = false;             ///< capture point stays inside, as the phase may last longer
};

/// External load on the robot besides weight and contact: moves the ZMP by h · force + moment.
struct ComLoad {
  Vec2 force{0.0, 0.0};   ///< horizontal, at the COM, as a share of the weight
  Vec2 moment{0.0, 0.0};  ///< (τ_y, −τ_x) over the weight [m]

  /// Shift d of the ZMP with the COM `height` over the feet [m].
  [[nodiscard]] Vec2 shift(double height) const { return height * force + moment; }
};

/// Input of a COM plan.
struct ComProblem {
  static constexpr std::size_t kMaxPhases = 10;

  double time = 0.0;  ///< of its begin [s]
  Motion<Vec2> begin{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  double height = 0.5;    ///< of the COM over the support [m]
  double weight = 300.0;  ///< [N]
  ComLoad load{};         ///< from the begin to the end
  double friction = 0.5;  ///< mean μ of the feet
  double heading = 0.0;   ///< of the friction pyramids' x axis [rad]
  Vec2 end_velocity{0.0, 0.0};
  /// Greater weight of the terminal state: this plan is not replaced before its end.
  bool comes_to_rest = false;
  std::array<SupportPhase, kMaxPhases> phases{};
  std::size_t num_phases = 0;

  /// Appends a phase; ignored beyond kMaxPhases or shorter than a millisecond.
  void add(const SupportPhase& phase);
};

/// The COM trajectory of the paper's ZMP walk: one quintic Hermite spline per phase, whose knots
/// (position, velocity, acceleration in x and y) solve one strict hierarchy:
///
///   1. the ZMP  p − (h/g) p̈ + d  inside the shrinking and switching support region, by a margin:
///      h is the height over each edge, as the robot tips about that line; d is the load's shift.
///      Under a load also horizontal forces within friction limits, and hips within the legs' reach
///   2. the capture point  p + √(h/g) ṗ + d  inside the triangle of a swing, by a margin; under a
///      load inside the region of every phase
///   3. minimal ∫ ‖p̈‖² dt (Gauss quadrature), terminal COM at the centre of the feet
///
/// Levels 1 and 2 are inequalities: if they can't be met, they are violated as little as possible.
/// The QP is that of Winkler 2015 and Kalakrishnan 2011, with priorities instead of their weights.
/// Allocates at construction only.
class ComPlanner {
 public:
  static constexpr std::size_t kMaxPhases = ComProblem::kMaxPhases;
  /// Most swings of a plan: each has a support before it, and the last one a support after it.
  static constexpr int kMaxSteps = (static_cast<int>(kMaxPhases) - 1) / 2;

  /// `scale` of the robot.
  ComPlanner(const ComPlannerOptions& options, const ForceOptions& force, const Scale& scale = {});

  void use(const ForceOptions& force) { force_ = force; }
  /// Input with non-finite numbers or without a phase leaves the plan as it is.
  void plan(const ComProblem& problem) noexcept;

  /// The plan at a time; after its end the COM stays there.
  [[nodiscard]] ComPlan at(double time) const noexcept;
  [[nodiscard]] double end_time() const;
  /// How far the ZMP of the plan had to leave the (unshrunk) region [m].
  [[nodiscard]] double zmp_slack() const { return zmp_slack_; }
  /// Problem and solution of the last plan, for checks.
  [[nodiscard]] const solver::Hierarchy& hierarchy() const { return last_problem().hierarchy; }
  [[nodiscard]] const solver::Solution& solution() const {
    return last_problem().solver.solution();
  }
  /// Share of `weight` [N] that a foot can carry `t` after the begin of a phase.
  [[nodiscard]] double share(const SupportPhase& phase, std::size_t leg, double t,
                             double weight) const;

 private:
  /// The hierarchy and its solver for one number of phases.
  struct Problem {
    solver::Hierarchy hierarchy;
    solver::LexicographicSolver solver;
    explicit Problem(std::size_t phases);
  };
  [[nodiscard]] const Problem& last_problem() const;

  enum class Point { zmp, capture_point };

  void guess_knots(const ComProblem& problem) noexcept;
  void write_region_rows(solver::Hierarchy& hierarchy, std::size_t phase) const noexcept;
  /// Rows  n·point ≤ offset − margin  for every edge of the region, at t in a phase.
  void write_inside_rows(solver::Level& level, std::size_t phase, double t,
                         const SupportRegion& region, double margin, Point point) const noexcept;
  /// Rows  ±(h/g p̈ − h f) ≤ share μ h  on both axes, for the horizontal contact force.
  void write_friction_rows(solver::Level& level, std::size_t phase, double t) const noexcept;
  /// Rows  e·(p + hip − foot) ≤ reach  for every foot that is down, with the direction e from foot
  /// to hip at the guess.
  void write_reach_rows(solver::Level& level, std::size_t phase, double t) const noexcept;
  void write_smoothness_rows(solver::Level& level, std::size_t phase) const noexcept;
  void write_terminal_rows(solver::Level& level) const noexcept;
  /// Adds the row  known + direction · (w · boundary values of a phase) ≤ most; returns its limit.
  double& add_row(solver::Level& level, std::size_t phase, const HermiteWeights& w,
                  const Vec2& direction, double known, double most) const noexcept;
  /// Adds scale · (w · boundary values of a phase) on one axis to row i; returns their value at the
  /// guess.
  double add_terms(solver::Rows& rows, Eigen::Index i, std::size_t phase, int axis,
                   const HermiteWeights& w, double scale) const noexcept;
  /// h/g of the COM over an edge of the region [s²].
  [[nodiscard]] double pendulum(const HalfPlane& edge) const noexcept;
  [[nodiscard]] SupportRegion region_at(const SupportPhase& phase, double t) const noexcept;
  [[nodiscard]] Motion<Vec2> evaluate(std::size_t phase, double t) const noexcept;
  void measure_slack() noexcept;

  ComPlannerOptions options_;
  ForceOptions force_;
  double length_, time_;  // scales of lengths and times
  // By number of phases. Stateless between plans, so copies of a planner share them; only one copy
  // may plan at a time.
  std::vector<std::shared_ptr<Problem>> problems_;
  ComProblem problem_;  // of the present plan; num_phases 0: none
  std::array<Motion<Vec2>, kMaxPhases + 1> knots_;
  double zmp_slack_ = 0.0;
};

}  // namespace surefoot::gaits
