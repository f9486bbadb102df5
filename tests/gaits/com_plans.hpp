#pragma once

#include "surefoot/gaits/parts/com_planner.hpp"
#include "surefoot/math/numbers.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace surefoot::test {

inline constexpr double kWeight = 300.0;  // [N]
inline constexpr double kHeight = 0.45;   // [m]
inline constexpr int kTrials = 40;

using Phases = std::vector<gaits::SupportPhase>;

inline PerLeg<Vec2> nominal_feet() {
  PerLeg<Vec2> feet;
  for (const Leg leg : kLegs) {
    feet[index(leg)] = {is_front(leg) ? 0.36 : -0.36, is_left(leg) ? 0.22 : -0.22};
  }
  return feet;
}

inline gaits::SupportPhase standing(double duration, const PerLeg<Vec2>& feet) {
  gaits::SupportPhase phase;
  phase.duration = duration;
  phase.feet = feet;
  phase.down.fill(true);
  phase.loaded_for.fill(10.0);
  phase.lifts_in.fill(kInfinity);
  return phase;
}

inline void elapse(gaits::SupportPhase& phase) {
  for (double& loaded : phase.loaded_for) loaded += phase.duration;
  for (double& lifts : phase.lifts_in) lifts -= phase.duration;
}

/// Support and swing in turn from `feet` on, each foot going `step`, in the order of a walk.
inline Phases walk(int steps, const PerLeg<Vec2>& feet, const Vec2& step) {
  constexpr std::array kOrder{Leg::LH, Leg::LF, Leg::RH, Leg::RF};
  Phases phases;
  gaits::SupportPhase phase = standing(0.8, feet);
  for (int i = 0; i < steps; ++i) {
    const std::size_t k = index(kOrder[static_cast<std::size_t>(i) % kOrder.size()]);
    phase.lifts_in[k] = phase.duration = 0.8;
    phase.must_rest = false;
    phases.push_back(phase);
    elapse(phase);
    phase.down[k] = false;
    phase.duration = 0.5;
    phase.must_rest = true;
    phases.push_back(phase);
    elapse(phase);
    phase.down[k] = true;
    phase.feet[k] += step;
    phase.loaded_for[k] = 0.0;
    phase.lifts_in[k] = kInfinity;
  }
  phase.duration = 0.8;
  phase.must_rest = false;
  phases.push_back(phase);
  return phases;
}

inline Phases random_walk(RandomMatrices& random) {
  PerLeg<Vec2> feet = nominal_feet();
  for (Vec2& foot : feet) foot += Vec2(random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04));
  return walk(random.integer(1, 4), feet, {random.uniform(0.0, 0.15), random.uniform(-0.03, 0.03)});
}

/// At rest over the middle of the feet, but for a little.
inline Motion<Vec2> random_start(RandomMatrices& random) {
  return {Vec2(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)),
          Vec2(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05)),
          Vec2(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1))};
}

inline gaits::ComPlanner make_planner(const gaits::ComPlannerOptions& options = {}) {
  return gaits::ComPlanner(options, gaits::ForceOptions{});
}

/// `problem`: what else is asked, as its load.
inline void plan(gaits::ComPlanner& planner, const Phases& phases, double time,
                 const Motion<Vec2>& begin, const Vec2& end_velocity = Vec2::Zero(),
                 gaits::ComProblem problem = {}) {
  problem.time = time;
  problem.begin = begin;
  problem.height = kHeight;
  problem.weight = kWeight;
  problem.end_velocity = end_velocity;
  for (const gaits::SupportPhase& phase : phases) problem.add(phase);
  planner.plan(problem);
}

inline double total_duration(const Phases& phases) {
  double sum = 0.0;
  for (const gaits::SupportPhase& phase : phases) sum += phase.duration;
  return sum;
}

/// Calls check(phase, t in the phase, time) on a fine grid over all phases.
template <typename Check>
void over(const Phases& phases, double time, const Check& check) {
  constexpr int kSamples = 40;
  for (const gaits::SupportPhase& phase : phases) {
    for (int i = 1; i <= kSamples; ++i) {
      const double t = phase.duration * i / kSamples;
      check(phase, t, time + t);
    }
    time += phase.duration;
  }
}

inline gaits::SupportRegion region(const gaits::ComPlanner& planner,
                                   const gaits::SupportPhase& phase, double t) {
  PerLeg<double> shares{};
  for (std::size_t k = 0; k < kNumLegs; ++k) shares[k] = planner.share(phase, k, t, kWeight);
  return {phase.feet, shares};
}

/// Calls check(planner, phases, begin time, start) on plans of random walks.
template <typename Check>
void on_random_walks(unsigned seed, const Check& check) {
  RandomMatrices random(seed);
  gaits::ComPlanner planner = make_planner();
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const Phases phases = random_walk(random);
    const Motion<Vec2> start = random_start(random);
    const double time = random.uniform(0.0, 100.0);
    plan(planner, phases, time, start, {random.uniform(0.0, 0.1), 0.0});
    check(planner, phases, time, start);
  }
}

}  // namespace surefoot::test
