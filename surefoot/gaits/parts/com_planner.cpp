#include "surefoot/gaits/parts/com_planner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace surefoot::gaits {
namespace {

constexpr double kMinHeight = 0.1;     // of the COM over an edge [m]
constexpr double kRestWeight = 100.0;  // terminal weight of a plan that ends at rest [1/s²]
constexpr double kLoadedWeight = 3.0;  // terminal weight under a full load [1/s²]
constexpr double kFullLoad = 0.03;     // shift of the ZMP by a full load, or more [m]
constexpr double kMinDuration = 1e-3;  // of a phase [s]
constexpr int kMinSamples = 3;         // of a phase: they constrain a cubic acceleration
constexpr int kMaxSamples = 8;         // of a phase
constexpr int kFrictionRows = 4;       // per sample
constexpr double kReachShare = 0.5;    // of a leg's reach: nearer hips need no row
constexpr double kFrictionShare = 0.9 / std::numbers::sqrt2;  // of μ: within the feet's pyramids
constexpr int kMaxExchanges = 12;                             // few of the many rows are active
constexpr int kUnknownsPerKnot = 6;                           // p, v, a in x and y
constexpr int kGaussPoints = 4;                               // exact for the square of a cubic
constexpr std::array<double, kGaussPoints> kGaussNodes{0.0694318442029737, 0.3300094782075719,
                                                       0.6699905217924281, 0.9305681557970263};
constexpr std::array<double, kGaussPoints> kGaussWeights{0.1739274225687269, 0.3260725774312731,
                                                         0.3260725774312731, 0.1739274225687269};

/// Coarse, so that nearly dependent rows do not bend the splines.
constexpr solver::RankTolerance kRank{.solve = 1e-8, .keep = 1e-12};

int samples_of(const SupportPhase& phase, double interval) {
  const double samples = std::ceil(phase.duration / interval);
  return static_cast<int>(std::clamp(samples, 1.0 * kMinSamples, 1.0 * kMaxSamples));
}

Vec2 center_of(const PerLeg<Vec2>& feet) {
  Vec2 center = Vec2::Zero();
  for (const Vec2& foot : feet) center += foot / static_cast<double>(feet.size());
  return center;
}

solver::Hierarchy make_hierarchy(std::size_t num_phases) {
  const int phases = static_cast<int>(num_phases), samples = phases * kMaxSamples;
  solver::Hierarchy hierarchy(kUnknownsPerKnot * phases);
  const int region_rows = samples * SupportRegion::kMaxEdges;
  hierarchy.add_level("zmp in the support region",
                      region_rows + samples * (kFrictionRows + kMaxLegs));
  hierarchy.add_level("capture point in the support region", region_rows);
  hierarchy.add_level("least acceleration", phases * kGaussPoints * 2 + kUnknownsPerKnot);
  return hierarchy;
}

}  // namespace

void ComProblem::add(const SupportPhase& phase) {
  if (num_phases == kMaxPhases || !(phase.duration >= kMinDuration)) return;
  phases[num_phases++] = phase;
}

ComPlanner::Problem::Problem(std::size_t phases)
    : hierarchy(make_hierarchy(phases)),
      solver(hierarchy, {.rank = kRank, .warm_start = false, .max_exchanges = kMaxExchanges}) {}

ComPlanner::ComPlanner(const ComPlannerOptions& options, const ForceOptions& force,
                       const Scale& scale)
    : options_(options), force_(force), length_(scale.length), time_(scale.time()) {
  knots_.fill({Vec2::Zero(), Vec2::Zero(), Vec2::Zero()});
  for (std::size_t phases = 1; phases <= kMaxPhases; ++phases)
    problems_.push_back(std::make_shared<Problem>(phases));
}

const ComPlanner::Problem& ComPlanner::last_problem() const {
  return *problems_[std::max<std::size_t>(problem_.num_phases, 1) - 1];
}

void ComPlanner::plan(const ComProblem& problem) noexcept {
  if (problem.num_phases == 0) return;
  const auto before = std::pair(problem_, knots_);
  guess_knots(problem);
  problem_ = problem;
  auto& [hierarchy, solver] = *problems_[problem.num_phases - 1];
  for (std::size_t l = 0; l < hierarchy.num_levels(); ++l) hierarchy.level(l).clear();
  for (std::size_t phase = 0; phase < problem.num_phases; ++phase) {
    write_region_rows(hierarchy, phase);
    write_smoothness_rows(hierarchy.level(2), phase);
  }
  write_terminal_rows(hierarchy.level(2));
  const solver::Solution& solution = solver.solve(hierarchy);
  if (solution.status == solver::SolveStatus::invalid_input) {  // then the guess may be NaN as well
    std::tie(problem_, knots_) = before;
    return;
  }
  for (std::size_t k = 1; k <= problem.num_phases; ++k) {
    const auto first = static_cast<Eigen::Index>(kUnknownsPerKnot * (k - 1));
    const auto x = solution.x.segment<kUnknownsPerKnot>(first);
    Motion<Vec2>& knot = knots_[k];
    knot = {knot.p + Vec2(x[0], x[3]), knot.v + Vec2(x[1], x[4]), knot.a + Vec2(x[2], x[5])};
  }
  measure_slack();
}

// The unknowns are deviations from the last plan, so that the solver starts there.
void ComPlanner::guess_knots(const ComProblem& problem) noexcept {
  const double old_end = end_time();
  std::array<Motion<Vec2>, kMaxPhases + 1> guess;
  guess[0] = problem.begin;
  double t = problem.time;
  for (std::size_t k = 0; k < problem.num_phases; ++k) {
    t += problem.phases[k].duration;
    if (problem_.num_phases > 0 && t <= old_end) {
      const ComPlan old = at(t);
      guess[k + 1] = {old.p, old.v, old.a};
    } else {
      guess[k + 1] = {center_of(problem.phases[k].feet), Vec2::Zero(), Vec2::Zero()};
    }
  }
  knots_ = guess;
}

double ComPlanner::pendulum(const HalfPlane& edge) const noexcept {
  return std::max(length_ * kMinHeight, problem_.height - edge.height) / kGravity;
}

void ComPlanner::write_region_rows(solver::Hierarchy& hierarchy, std::size_t phase) const noexcept {
  const SupportPhase& support = problem_.phases[phase];
  const int samples = samples_of(support, options_.sample_interval);
  const double zmp_margin = std::min(options_.zmp_margin, support.zmp_margin_max);
  const bool loaded = problem_.load.force.norm() > 0.0;
  for (int i = 1; i <= samples; ++i) {
    const double t = support.duration * i / samples;
    const SupportRegion region = region_at(support, t);
    write_inside_rows(hierarchy.level(0), phase, t, region, zmp_margin, Point::zmp);
    if (loaded) {
      write_friction_rows(hierarchy.level(0), phase, t);
      write_reach_rows(hierarchy.level(0), phase, t);
    }
    if (support.must_rest || loaded) {  // else each new plan would postpone the stop
      write_inside_rows(hierarchy.level(1), phase, t, region, options_.rest_margin,
                        Point::capture_point);
    }
  }
}

void ComPlanner::write_inside_rows(solver::Level& level, std::size_t phase, double t,
                                   const SupportRegion& region, double margin,
                                   Point point) const noexcept {
  const double T = problem_.phases[phase].duration;
  for (int e = 0; e < region.num_edges(); ++e) {
    const HalfPlane& edge = region.edge(e);
    const double h = pendulum(edge);
    const HermiteWeights w =
        point == Point::zmp
            ? HermiteWeights(hermite_position(t, T) - h * hermite_acceleration(t, T))
            : HermiteWeights(hermite_position(t, T) + std::sqrt(h) * hermite_velocity(t, T));
    const double known = edge.normal.dot(problem_.load.shift(kGravity * h));
    add_row(level, phase, w, edge.normal, known, edge.offset - margin);
  }
}

void ComPlanner::write_friction_rows(solver::Level& level, std::size_t phase,
                                     double t) const noexcept {
  const double T = problem_.phases[phase].duration, height = problem_.height;
  const HermiteWeights w = height / kGravity * hermite_acceleration(t, T);
  const double most = kFrictionShare * problem_.friction * height;
  const Vec2 along(std::cos(problem_.heading), std::sin(problem_.heading));
  for (const Vec2& side : {along, Vec2(-along.y(), along.x())}) {
    for (const double sign : {1.0, -1.0}) {
      add_row(level, phase, w, sign * side, 0.0, most) +=
          sign * height * side.dot(problem_.load.force);
    }
  }
}

void ComPlanner::write_reach_rows(solver::Level& level, std::size_t phase,
                                  double t) const noexcept {
  const SupportPhase& support = problem_.phases[phase];
  const HermiteWeights w = hermite_position(t, support.duration);
  const Vec2 com = evaluate(phase, t).p;
  for (std::size_t leg = 0; leg < support.feet.size(); ++leg) {
    const Vec2 from_foot = com + support.hips[leg] - support.feet[leg];
    if (!support.down[leg] || from_foot.norm() < kReachShare * support.reach[leg]) continue;
    const Vec2 direction = from_foot.normalized();
    const double known = direction.dot(support.hips[leg] - support.feet[leg]);
    add_row(level, phase, w, direction, known, support.reach[leg]);
  }
}

void ComPlanner::write_smoothness_rows(solver::Level& level, std::size_t phase) const noexcept {
  const double T = problem_.phases[phase].duration;
  for (std::size_t i = 0; i < kGaussPoints; ++i) {
    const HermiteWeights w =
        std::sqrt(kGaussWeights[i] * T / time_) * hermite_acceleration(kGaussNodes[i] * T, T);
    solver::Rows rows = level.add(2, 0);
    for (int axis = 0; axis < 2; ++axis)
      rows.set_equal(axis, -add_terms(rows, axis, phase, axis, w, 1.0));
  }
}

void ComPlanner::write_terminal_rows(solver::Level& level) const noexcept {
  const Vec2 shift = problem_.load.shift(problem_.height);
  const double least = problem_.comes_to_rest ? kRestWeight / length_ : options_.terminal_weight;
  const double load = std::min(1.0, shift.norm() / (length_ * kFullLoad));
  const double weight = std::max(least, load * (kLoadedWeight / length_));
  const std::size_t last = problem_.num_phases - 1;
  const Vec2 center = center_of(problem_.phases[last].feet) - shift;
  const Motion<Vec2>& guess = knots_[last + 1];
  solver::Rows rows = level.add(kUnknownsPerKnot, 0);
  const auto first = static_cast<Eigen::Index>(kUnknownsPerKnot * last);
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3 error(center[axis] - guess.p[axis], problem_.end_velocity[axis] - guess.v[axis],
                     -guess.a[axis]);
    const Vec3 weights = weight * Vec3(1.0, time_, time_ * time_);  // [1/s²], [1/s], 1
    for (Eigen::Index i = 0; i < 3; ++i) {
      rows.A(3 * axis + i, first + 3 * axis + i) = weights[i];
      rows.set_equal(3 * axis + i, weights[i] * error[i]);
    }
  }
}

double& ComPlanner::add_row(solver::Level& level, std::size_t phase, const HermiteWeights& w,
                            const Vec2& direction, double known, double most) const noexcept {
  solver::Rows rows = level.add(1, 0);
  for (int axis = 0; axis < 2; ++axis) known += add_terms(rows, 0, phase, axis, w, direction[axis]);
  rows.lower[0] = -kInfinity;
  return rows.upper[0] = most - known;
}

double ComPlanner::add_terms(solver::Rows& rows, Eigen::Index i, std::size_t phase, int axis,
                             const HermiteWeights& w, double scale) const noexcept {
  const Eigen::Index end = kUnknownsPerKnot * static_cast<Eigen::Index>(phase) + 3 * axis;
  rows.A.row(i).segment<3>(end) += scale * w.tail<3>();
  if (phase > 0) rows.A.row(i).segment<3>(end - kUnknownsPerKnot) += scale * w.head<3>();
  const Motion<Vec2>&from = knots_[phase], &to = knots_[phase + 1];
  return scale * (w[0] * from.p[axis] + w[1] * from.v[axis] + w[2] * from.a[axis] +
                  w[3] * to.p[axis] + w[4] * to.v[axis] + w[5] * to.a[axis]);
}

double ComPlanner::share(const SupportPhase& phase, std::size_t leg, double t,
                         double weight) const {
  if (!phase.down[leg]) return 0.0;
  const double most = ramped_force_max(force_, phase.loaded_for[leg] + t, phase.lifts_in[leg] - t);
  return std::min(options_.leg_share, most / weight);
}

SupportRegion ComPlanner::region_at(const SupportPhase& phase, double t) const noexcept {
  PerLeg<double> shares = phase.heights;
  for (std::size_t leg = 0; leg < shares.size(); ++leg)
    shares[leg] = share(phase, leg, t, problem_.weight);
  return SupportRegion(phase.feet, shares, phase.heights);
}

Motion<Vec2> ComPlanner::evaluate(std::size_t phase, double t) const noexcept {
  return hermite(knots_[phase], knots_[phase + 1], t, problem_.phases[phase].duration);
}

ComPlan ComPlanner::at(double time) const noexcept {
  const auto& phases = problem_.phases;
  const std::size_t planned = problem_.num_phases;
  const Vec2 shift = problem_.load.shift(problem_.height);
  double t = time - problem_.time;
  std::size_t phase = 0;
  while (phase + 1 < planned && t > phases[phase].duration) t -= phases[phase++].duration;
  if (planned == 0 || t > phases[phase].duration) {
    const Vec2& rest = knots_[planned].p;
    return {rest, Vec2::Zero(), Vec2::Zero(), rest + shift};
  }
  const Motion<Vec2> m = evaluate(phase, t);
  return {m.p, m.v, m.a, m.p - problem_.height / kGravity * m.a + shift};
}

double ComPlanner::end_time() const {
  double t = problem_.time;
  for (std::size_t k = 0; k < problem_.num_phases; ++k) t += problem_.phases[k].duration;
  return t;
}

void ComPlanner::measure_slack() noexcept {
  zmp_slack_ = 0.0;
  for (std::size_t phase = 0; phase < problem_.num_phases; ++phase) {
    const SupportPhase& support = problem_.phases[phase];
    const int samples = samples_of(support, options_.sample_interval);
    for (int i = 1; i <= samples; ++i) {
      const double t = support.duration * i / samples;
      const Motion<Vec2> m = evaluate(phase, t);
      const SupportRegion region = region_at(support, t);
      for (int e = 0; e < region.num_edges(); ++e) {
        const HalfPlane& edge = region.edge(e);
        const double h = pendulum(edge);
        const Vec2 zmp = m.p - h * m.a + problem_.load.shift(kGravity * h);
        zmp_slack_ = std::max(zmp_slack_, edge.normal.dot(zmp) - edge.offset);
      }
    }
  }
}

}  // namespace surefoot::gaits
