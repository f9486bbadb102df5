#include "surefoot/gaits/parts/com_planner.hpp"

#include "surefoot/gaits/parts/force_ramp.hpp"
#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace surefoot {
namespace {

constexpr double kLeastHeight = 0.1;     // of the COM over an edge [m]
constexpr double kRestWeight = 100.0;    // of an end at rest [1/s²]
constexpr double kLoadedWeight = 3.0;    // of the pull to the centre against a load [1/s²] …
constexpr double kFullLoad = 0.03;       // … that moves the ZMP by this or more [m]
constexpr double kShortestPhase = 1e-3;  // [s]
constexpr int kMinSamples = 3;           // of a phase: they hold a cubic acceleration
constexpr int kMaxSamples = 8;           // of a phase
constexpr int kFrictionRows = 4;         // of a sample
constexpr double kNearReach = 0.5;       // of a leg's reach: a hip that is nearer needs no row
constexpr double kFrictionShare = 0.9 / std::numbers::sqrt2;  // of μ: within the feet's pyramids
constexpr int kUnknownsPerKnot = 6;                           // p, v, a in x and y
constexpr int kGaussPoints = 4;                               // exact for the square of a cubic
constexpr std::array<double, kGaussPoints> kGaussNodes{0.0694318442029737, 0.3300094782075719,
                                                       0.6699905217924281, 0.9305681557970263};
constexpr std::array<double, kGaussPoints> kGaussWeights{0.1739274225687269, 0.3260725774312731,
                                                         0.3260725774312731, 0.1739274225687269};

int samples_of(const SupportPhase& phase, double interval) {
  const double samples = std::ceil(phase.duration / interval);
  return static_cast<int>(std::clamp(samples, 1.0 * kMinSamples, 1.0 * kMaxSamples));
}

}  // namespace

ComPlanner::ComPlanner(const ComPlannerOptions& options, const ForceOptions& force,
                       double robot_weight)
    : options_(options), force_(force), weight_(robot_weight) {
  knots_.fill({Vec2::Zero(), Vec2::Zero(), Vec2::Zero()});
  for (int phases = 1; phases <= kMaxPhases; ++phases) {
    problems_.push_back(std::make_shared<Problem>(make_hierarchy(phases)));
  }
}

Hierarchy ComPlanner::make_hierarchy(int phases) {
  Hierarchy hierarchy(kUnknownsPerKnot * phases);
  const int region_rows = phases * kMaxSamples * SupportRegion::kMaxEdges;
  const int friction_rows = phases * kMaxSamples * kFrictionRows;
  const int reach_rows = phases * kMaxSamples * static_cast<int>(kNumLegs);
  hierarchy.add_level("zmp in the support region", region_rows + friction_rows + reach_rows);
  hierarchy.add_level("capture point in the support region", region_rows);
  hierarchy.add_level("least acceleration", phases * kGaussPoints * 2 + kUnknownsPerKnot);
  return hierarchy;
}

void ComPlanner::add(const SupportPhase& phase) noexcept {
  if (num_phases_ == kMaxPhases || !(phase.duration >= kShortestPhase)) return;
  phases_[static_cast<std::size_t>(num_phases_++)] = phase;
}

void ComPlanner::plan(double time, const Motion<Vec2>& begin, double height,
                      const Vec2& end_velocity, bool comes_to_rest) noexcept {
  if (num_phases_ == 0) return;
  const std::tuple before(begin_time_, height_, planned_, knots_, durations_, load_.force,
                          load_.moment);
  guess_knots(time, begin);
  begin_time_ = time;
  height_ = height;
  load_ = next_load_;
  planned_ = num_phases_;
  Problem& problem = *problems_[static_cast<std::size_t>(planned_ - 1)];
  for (std::size_t l = 0; l < problem.hierarchy.num_levels(); ++l)
    problem.hierarchy.level(l).clear();
  for (int phase = 0; phase < planned_; ++phase) {
    durations_[static_cast<std::size_t>(phase)] = phases_[static_cast<std::size_t>(phase)].duration;
    write_region_rows(problem.hierarchy, phase);
    write_smoothness_rows(problem.hierarchy.level(2), phase);
  }
  write_terminal_rows(problem.hierarchy.level(2), end_velocity,
                      comes_to_rest ? kRestWeight : options_.terminal_weight);
  const Solution& solution = problem.solver.solve(problem.hierarchy);
  if (solution.status == SolveStatus::invalid_input) {  // then the guess may be NaN as well
    std::tie(begin_time_, height_, planned_, knots_, durations_, load_.force, load_.moment) =
        before;
    return;
  }
  for (int k = 1; k <= planned_; ++k) {
    const auto x = solution.x.segment<kUnknownsPerKnot>(kUnknownsPerKnot * (k - 1));
    Motion<Vec2>& knot = knots_[static_cast<std::size_t>(k)];
    knot = {knot.p + Vec2(x[0], x[3]), knot.v + Vec2(x[1], x[4]), knot.a + Vec2(x[2], x[5])};
  }
  measure_slack();
}

// The unknowns are the deviations from a guess, so that the solver starts where the last plan was.
void ComPlanner::guess_knots(double time, const Motion<Vec2>& begin) noexcept {
  const double old_end = end_time();
  std::array<Motion<Vec2>, kMaxPhases + 1> guess;
  guess[0] = begin;
  double t = time;
  for (std::size_t k = 0; k < static_cast<std::size_t>(num_phases_); ++k) {
    t += phases_[k].duration;
    if (planned_ > 0 && t <= old_end) {
      const ComPlan old = at(t);
      guess[k + 1] = {old.p, old.v, old.a};
    } else {
      Vec2 center = Vec2::Zero();
      for (const Vec2& foot : phases_[k].feet) center += 0.25 * foot;
      guess[k + 1] = {center, Vec2::Zero(), Vec2::Zero()};
    }
  }
  knots_ = guess;
}

double ComPlanner::pendulum(const HalfPlane& edge) const noexcept {
  return std::max(kLeastHeight, height_ - edge.height) / kGravity;
}

Vec2 ComPlanner::load_shift(double height) const noexcept {
  return height * load_.force + load_.moment;
}

void ComPlanner::write_region_rows(Hierarchy& hierarchy, int phase) const noexcept {
  const SupportPhase& support = phases_[static_cast<std::size_t>(phase)];
  const int samples = samples_of(support, options_.sample_interval);
  const double zmp_margin = std::min(options_.zmp_margin, support.zmp_margin_max);
  const bool loaded = load_.force.norm() > 0.0;
  for (int i = 1; i <= samples; ++i) {
    const double t = support.duration * i / samples;
    const SupportRegion region = region_at(support, t);
    write_inside_rows(hierarchy.level(0), phase, t, region, zmp_margin, Point::zmp);
    if (loaded) {
      write_friction_rows(hierarchy.level(0), phase, t);
      write_reach_rows(hierarchy.level(0), phase, t);
    }
    if (support.must_rest || loaded) {  // a plan that stops later puts it off at each new plan
      write_inside_rows(hierarchy.level(1), phase, t, region, options_.rest_margin,
                        Point::capture_point);
    }
  }
}

void ComPlanner::write_inside_rows(Level& level, int phase, double t, const SupportRegion& region,
                                   double margin, Point point) const noexcept {
  const double T = phases_[static_cast<std::size_t>(phase)].duration;
  for (int e = 0; e < region.num_edges(); ++e) {
    Rows rows = level.add(1, 0);
    const HalfPlane& edge = region.edge(e);
    const double h = pendulum(edge);
    const HermiteWeights w =
        point == Point::zmp
            ? HermiteWeights(hermite_position(t, T) - h * hermite_acceleration(t, T))
            : HermiteWeights(hermite_position(t, T) + std::sqrt(h) * hermite_velocity(t, T));
    double known = edge.normal.dot(load_shift(kGravity * h));
    for (int axis = 0; axis < 2; ++axis)
      known += add_terms(rows, 0, phase, axis, w, edge.normal[axis]);
    rows.lower[0] = -kInfinity;
    rows.upper[0] = edge.offset - margin - known;
  }
}

void ComPlanner::write_friction_rows(Level& level, int phase, double t) const noexcept {
  const double T = phases_[static_cast<std::size_t>(phase)].duration;
  const HermiteWeights w = height_ / kGravity * hermite_acceleration(t, T);
  const double most = kFrictionShare * friction_ * height_;
  for (const Vec2& side : friction_axes_) {
    for (const double sign : {1.0, -1.0}) {
      Rows rows = level.add(1, 0);
      double known = 0.0;
      for (int axis = 0; axis < 2; ++axis)
        known += add_terms(rows, 0, phase, axis, w, sign * side[axis]);
      rows.lower[0] = -kInfinity;
      rows.upper[0] = most - known + sign * height_ * side.dot(load_.force);
    }
  }
}

void ComPlanner::write_reach_rows(Level& level, int phase, double t) const noexcept {
  const SupportPhase& support = phases_[static_cast<std::size_t>(phase)];
  const HermiteWeights w = hermite_position(t, support.duration);
  const Vec2 com = evaluate(phase, t).p;
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    const Vec2 from_foot = com + support.hips[leg] - support.feet[leg];
    if (!support.down[leg] || from_foot.norm() < kNearReach * support.reach[leg]) continue;
    const Vec2 direction = from_foot.normalized();
    Rows rows = level.add(1, 0);
    double known = direction.dot(support.hips[leg] - support.feet[leg]);
    for (int axis = 0; axis < 2; ++axis)
      known += add_terms(rows, 0, phase, axis, w, direction[axis]);
    rows.lower[0] = -kInfinity;
    rows.upper[0] = support.reach[leg] - known;
  }
}

void ComPlanner::write_smoothness_rows(Level& level, int phase) const noexcept {
  const double T = phases_[static_cast<std::size_t>(phase)].duration;
  for (std::size_t i = 0; i < kGaussPoints; ++i) {
    const HermiteWeights w =
        std::sqrt(kGaussWeights[i] * T) * hermite_acceleration(kGaussNodes[i] * T, T);
    Rows rows = level.add(2, 0);
    for (int axis = 0; axis < 2; ++axis)
      rows.set_equal(axis, -add_terms(rows, axis, phase, axis, w, 1.0));
  }
}

void ComPlanner::write_terminal_rows(Level& level, const Vec2& end_velocity,
                                     double least_weight) const noexcept {
  const double loaded = std::min(1.0, load_shift(height_).norm() / kFullLoad);
  const double weight = std::max(least_weight, loaded * kLoadedWeight);
  const SupportPhase& last = phases_[static_cast<std::size_t>(planned_ - 1)];
  Vec2 center = Vec2::Zero();
  for (const Vec2& foot : last.feet) center += 0.25 * foot;
  center -= load_shift(height_);
  const Motion<Vec2>& guess = knots_[static_cast<std::size_t>(planned_)];
  Rows rows = level.add(kUnknownsPerKnot, 0);
  const Eigen::Index first = kUnknownsPerKnot * (planned_ - 1);
  for (int axis = 0; axis < 2; ++axis) {
    for (Eigen::Index i = 3 * axis; i < 3 * axis + 3; ++i) rows.A(i, first + i) = weight;
    rows.set_equal(3 * axis, weight * (center[axis] - guess.p[axis]));
    rows.set_equal(3 * axis + 1, weight * (end_velocity[axis] - guess.v[axis]));
    rows.set_equal(3 * axis + 2, -weight * guess.a[axis]);
  }
}

double ComPlanner::add_terms(Rows& rows, Eigen::Index i, int phase, int axis,
                             const HermiteWeights& w, double scale) const noexcept {
  const Eigen::Index end = kUnknownsPerKnot * phase + 3 * axis;
  rows.A.row(i).segment<3>(end) += scale * w.tail<3>();
  if (phase > 0) rows.A.row(i).segment<3>(end - kUnknownsPerKnot) += scale * w.head<3>();
  const Motion<Vec2>& from = knots_[static_cast<std::size_t>(phase)];
  const Motion<Vec2>& to = knots_[static_cast<std::size_t>(phase) + 1];
  return scale * (w[0] * from.p[axis] + w[1] * from.v[axis] + w[2] * from.a[axis] +
                  w[3] * to.p[axis] + w[4] * to.v[axis] + w[5] * to.a[axis]);
}

double ComPlanner::share(const SupportPhase& phase, std::size_t leg, double t) const {
  if (!phase.down[leg]) return 0.0;
  const double most = ramped_force_max(force_, phase.loaded_for[leg] + t, phase.lifts_in[leg] - t);
  return std::min(options_.leg_share, most / weight_);
}

SupportRegion ComPlanner::region_at(const SupportPhase& phase, double t) const noexcept {
  PerLeg<double> shares{};
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) shares[leg] = share(phase, leg, t);
  return SupportRegion(phase.feet, shares, phase.heights);
}

Motion<Vec2> ComPlanner::evaluate(int phase, double t) const noexcept {
  const auto k = static_cast<std::size_t>(phase);
  return hermite(knots_[k], knots_[k + 1], t, durations_[k]);
}

ComPlan ComPlanner::at(double time) const noexcept {
  double t = time - begin_time_;
  int phase = 0;
  while (phase < planned_ - 1 && t > durations_[static_cast<std::size_t>(phase)]) {
    t -= durations_[static_cast<std::size_t>(phase++)];
  }
  if (planned_ == 0 || t > durations_[static_cast<std::size_t>(phase)]) {
    const Vec2& rest = knots_[static_cast<std::size_t>(planned_)].p;
    return {rest, Vec2::Zero(), Vec2::Zero(), rest + load_shift(height_)};
  }
  const Motion<Vec2> m = evaluate(phase, t);
  return {m.p, m.v, m.a, m.p - height_ / kGravity * m.a + load_shift(height_)};
}

double ComPlanner::end_time() const {
  double t = begin_time_;
  for (int k = 0; k < planned_; ++k) t += durations_[static_cast<std::size_t>(k)];
  return t;
}

void ComPlanner::measure_slack() noexcept {
  zmp_slack_ = 0.0;
  for (int phase = 0; phase < planned_; ++phase) {
    const SupportPhase& support = phases_[static_cast<std::size_t>(phase)];
    const int samples = samples_of(support, options_.sample_interval);
    for (int i = 1; i <= samples; ++i) {
      const double t = support.duration * i / samples;
      const Motion<Vec2> m = evaluate(phase, t);
      const SupportRegion region = region_at(support, t);
      for (int e = 0; e < region.num_edges(); ++e) {
        const HalfPlane& edge = region.edge(e);
        const double h = pendulum(edge);
        const Vec2 zmp = m.p - h * m.a + load_shift(kGravity * h);
        zmp_slack_ = std::max(zmp_slack_, edge.normal.dot(zmp) - edge.offset);
      }
    }
  }
}

}  // namespace surefoot
