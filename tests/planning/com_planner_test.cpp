#include "surefoot/planning/com_planner.hpp"

#include "surefoot/signals/sensor_reading.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::RandomMatrices;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWeight = 300.0;  // [N]
constexpr double kHeight = 0.45;   // [m]
constexpr int kTrials = 40;

using Phases = std::vector<SupportPhase>;

PerLeg<Vec2> nominal_feet() {
  PerLeg<Vec2> feet;
  for (const Leg leg : kLegs) {
    feet[index(leg)] = {is_front(leg) ? 0.36 : -0.36, is_left(leg) ? 0.22 : -0.22};
  }
  return feet;
}

SupportPhase standing(double duration, const PerLeg<Vec2>& feet) {
  return {.duration = duration,
          .feet = feet,
          .down = {true, true, true, true},
          .loaded_for = {10.0, 10.0, 10.0, 10.0},
          .lifts_in = {kInfinity, kInfinity, kInfinity, kInfinity},
          .must_rest = false};
}

void elapse(SupportPhase& phase) {
  for (double& loaded : phase.loaded_for) loaded += phase.duration;
  for (double& lifts : phase.lifts_in) lifts -= phase.duration;
}

/// Support and swing in turn from `feet` on, each foot going `step`, in the order of a walk.
Phases walk(int steps, const PerLeg<Vec2>& feet, const Vec2& step) {
  constexpr std::array kOrder{Leg::LH, Leg::LF, Leg::RH, Leg::RF};
  Phases phases;
  SupportPhase phase = standing(0.8, feet);
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

Phases random_walk(RandomMatrices& random) {
  PerLeg<Vec2> feet = nominal_feet();
  for (Vec2& foot : feet) foot += Vec2(random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04));
  return walk(random.integer(1, 4), feet, {random.uniform(0.0, 0.15), random.uniform(-0.03, 0.03)});
}

/// At rest over the middle of the feet, but for a little.
Motion<Vec2> random_start(RandomMatrices& random) {
  return {Vec2(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)),
          Vec2(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05)),
          Vec2(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1))};
}

ComPlanner make_planner(const ComPlannerOptions& options = {}) {
  return ComPlanner(options, ForceOptions{}, kWeight);
}

void plan(ComPlanner& planner, const Phases& phases, double time, const Motion<Vec2>& begin,
          const Vec2& end_velocity = Vec2::Zero()) {
  planner.clear();
  for (const SupportPhase& phase : phases) planner.add(phase);
  planner.plan(time, begin, kHeight, end_velocity);
}

double total_duration(const Phases& phases) {
  double sum = 0.0;
  for (const SupportPhase& phase : phases) sum += phase.duration;
  return sum;
}

/// Calls check(phase, t in the phase, time) on a fine grid over all phases.
template <typename Check>
void over(const Phases& phases, double time, const Check& check) {
  constexpr int kSamples = 40;
  for (const SupportPhase& phase : phases) {
    for (int i = 1; i <= kSamples; ++i) {
      const double t = phase.duration * i / kSamples;
      check(phase, t, time + t);
    }
    time += phase.duration;
  }
}

SupportRegion region(const ComPlanner& planner, const SupportPhase& phase, double t) {
  PerLeg<double> shares{};
  for (std::size_t k = 0; k < kNumLegs; ++k) shares[k] = planner.share(phase, k, t);
  return {phase.feet, shares};
}

/// Calls check(planner, phases, begin time, start) on plans of random walks.
template <typename Check>
void on_random_walks(unsigned seed, const Check& check) {
  RandomMatrices random(seed);
  ComPlanner planner = make_planner();
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const Phases phases = random_walk(random);
    const Motion<Vec2> start = random_start(random);
    const double time = random.uniform(0.0, 100.0);
    plan(planner, phases, time, start, {random.uniform(0.0, 0.1), 0.0});
    check(planner, phases, time, start);
  }
}

TEST(ComPlanner, StartsFromTheGivenState) {
  on_random_walks(1, [](const ComPlanner& planner, const Phases&, double time, const auto& start) {
    const ComPlan at = planner.at(time);
    EXPECT_LT((at.p - start.p).norm(), 1e-12);
    EXPECT_LT((at.v - start.v).norm(), 1e-12);
    EXPECT_LT((at.a - start.a).norm(), 1e-12);
  });
}

TEST(ComPlanner, PositionVelocityAndAccelerationAreContinuousOverTheKnots) {
  on_random_walks(2, [](const ComPlanner& planner, const Phases& phases, double time, const auto&) {
    double knot = time;
    for (std::size_t k = 0; k + 1 < phases.size(); ++k) {
      knot += phases[k].duration;
      const ComPlan before = planner.at(knot - 1e-7);
      const ComPlan after = planner.at(knot + 1e-7);
      EXPECT_LT((after.p - before.p).norm(), 1e-6);
      EXPECT_LT((after.v - before.v).norm(), 1e-5);
      EXPECT_LT((after.a - before.a).norm(), 1e-4);
    }
  });
}

TEST(ComPlanner, VelocityAndAccelerationAreRatesAndTheZmpGoesWithThem) {
  on_random_walks(3, [](const ComPlanner& planner, const Phases& phases, double time, const auto&) {
    const double step = 1e-5;
    const double last = total_duration(phases) - 2.0 * step;
    for (double t = 2.0 * step; t < last; t += 0.0371) {
      const ComPlan before = planner.at(time + t - step);
      const ComPlan now = planner.at(time + t);
      const ComPlan after = planner.at(time + t + step);
      EXPECT_LT(((after.p - before.p) / (2.0 * step) - now.v).norm(), 1e-5);
      EXPECT_LT(((after.v - before.v) / (2.0 * step) - now.a).norm(), 1e-3);
      EXPECT_LT((now.p - kHeight / kGravity * now.a - now.zmp).norm(), 1e-12);
    }
  });
}

TEST(ComPlanner, TheZmpOfAWalkStaysInTheSupportRegion) {
  on_random_walks(4, [](const ComPlanner& planner, const Phases& phases, double time, const auto&) {
    EXPECT_EQ(planner.zmp_slack(), 0.0);
    // The margin holds at the planner's samples; between two of them a part of it may be used.
    const double margin = 0.5 * ComPlannerOptions{}.zmp_margin;
    over(phases, time + 0.0, [&](const SupportPhase& phase, double t, double at) {
      const bool settled = at - time > 0.2;  // the start is given, not planned
      const double least = settled ? margin : -0.01;
      EXPECT_GT(region(planner, phase, t).margin(planner.at(at).zmp), least) << at - time;
    });
  });
}

TEST(ComPlanner, TheCapturePointRestsInTheTriangleOfEverySwing) {
  on_random_walks(5, [](const ComPlanner& planner, const Phases& phases, double time, const auto&) {
    over(phases, time, [&](const SupportPhase& phase, double t, double at) {
      const ComPlan com = planner.at(at);
      const Vec2 capture_point = com.p + std::sqrt(kHeight / kGravity) * com.v;
      const double margin = region(planner, phase, t).margin(capture_point);
      EXPECT_GT(phase.must_rest ? margin : kInfinity, 0.5 * ComPlannerOptions{}.rest_margin);
    });
  });
}

TEST(ComPlanner, HoldsStillAtItsEnd) {
  on_random_walks(6, [](const ComPlanner& planner, const Phases& phases, double time, const auto&) {
    EXPECT_NEAR(planner.end_time(), time + total_duration(phases), 1e-9);
    const Vec2 end = planner.at(planner.end_time() - 1e-9).p;
    for (const double beyond : {1e-6, 0.1, 1000.0}) {
      const ComPlan rest = planner.at(planner.end_time() + beyond);
      EXPECT_LT((rest.p - end).norm(), 1e-8);
      EXPECT_EQ(rest.v, Vec2::Zero());
      EXPECT_EQ(rest.a, Vec2::Zero());
      EXPECT_EQ(rest.zmp, rest.p);
    }
  });
}

TEST(ComPlanner, EndsNearTheMiddleOfTheLastFeetWithTheGivenVelocity) {
  ComPlanner planner = make_planner({.terminal_weight = 100.0});
  const Vec2 velocity(0.05, -0.02);
  plan(planner, {standing(2.0, nominal_feet())}, 0.0, {Vec2(0.05, 0.02), {0, 0}, {0, 0}}, velocity);
  const ComPlan end = planner.at(planner.end_time() - 1e-9);
  EXPECT_LT(end.p.norm(), 1e-3);
  EXPECT_LT((end.v - velocity).norm(), 1e-3);
}

TEST(ComPlanner, ComesToRestOverItsFeetWhereItIsToldTo) {
  RandomMatrices random(12);
  ComPlanner planner = make_planner();
  for (int trial = 0; trial < kTrials; ++trial) {
    const Motion<Vec2> start = random_start(random);
    planner.clear();
    planner.add(standing(1.0, nominal_feet()));
    planner.plan(0.0, start, kHeight, Vec2::Zero(), true);
    const ComPlan end = planner.at(1.0 - 1e-9);
    EXPECT_LT(end.p.norm(), 1e-3);
    EXPECT_LT(end.v.norm(), 1e-3);
    EXPECT_LT(end.a.norm(), 1e-2);
    EXPECT_LT(planner.zmp_slack(), 1e-9);
  }
}

TEST(ComPlanner, IsTheLeastSquaresPlanWhereNothingLimitsIt) {
  RandomMatrices random(7);
  const ComPlannerOptions options{.terminal_weight = 0.8};
  ComPlanner planner = make_planner(options);
  PerLeg<Vec2> feet = nominal_feet();
  for (Vec2& foot : feet) foot *= 100.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double T = random.uniform(0.3, 2.0);
    const Motion<Vec2> begin = random_start(random);
    const Vec2 velocity(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
    plan(planner, {standing(T, feet)}, 3.0, begin, velocity);
    // min ∫ ‖p̈‖² dt + w² (‖p1‖² + ‖v1 − v‖² + ‖a1‖²) over the end (p1, v1, a1), by many rectangles.
    const double w2 = options.terminal_weight * options.terminal_weight;
    Mat3 A = w2 * Mat3::Identity();
    Eigen::Matrix<double, 3, 2> b = Eigen::Matrix<double, 3, 2>::Zero();
    b.row(1) = w2 * velocity.transpose();
    constexpr int kRectangles = 20000;
    for (int i = 0; i < kRectangles; ++i) {
      const HermiteWeights h = hermite_acceleration(T * (i + 0.5) / kRectangles, T);
      const Vec2 known = h[0] * begin.p + h[1] * begin.v + h[2] * begin.a;
      A += T / kRectangles * h.tail<3>().transpose() * h.tail<3>();
      b -= T / kRectangles * h.tail<3>().transpose() * known.transpose();
    }
    const Eigen::Matrix<double, 3, 2> end = A.ldlt().solve(b);
    const ComPlan planned = planner.at(3.0 + T - 1e-12);
    EXPECT_LT((planned.p - end.row(0).transpose()).norm(), 1e-6);
    EXPECT_LT((planned.v - end.row(1).transpose()).norm(), 1e-6);
    EXPECT_LT((planned.a - end.row(2).transpose()).norm(), 1e-6);
  }
}

TEST(ComPlanner, TurnsAndMovesWithTheWorld) {
  RandomMatrices random(8);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Phases phases = random_walk(random);
    const Motion<Vec2> start = random_start(random);
    const Vec2 velocity(0.05, 0.01);
    const Mat2 R = Eigen::Rotation2Dd(random.uniform(-3.0, 3.0)).toRotationMatrix();
    const Vec2 shift(random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0));
    Phases moved = phases;
    for (SupportPhase& phase : moved) {
      for (Vec2& foot : phase.feet) foot = R * foot + shift;
    }
    ComPlanner here = make_planner(), there = make_planner();
    plan(here, phases, 0.0, start, velocity);
    plan(there, moved, 50.0, {R * start.p + shift, R * start.v, R * start.a}, R * velocity);
    for (double t = 0.0; t < total_duration(phases); t += 0.0513) {
      const ComPlan a = here.at(t), b = there.at(50.0 + t);
      ASSERT_LT((R * a.p + shift - b.p).norm(), 1e-6);
      ASSERT_LT((R * a.v - b.v).norm(), 1e-6);
      ASSERT_LT((R * a.zmp + shift - b.zmp).norm(), 1e-6);
    }
  }
}

TEST(ComPlanner, DoesNotDependOnThePlanBefore) {
  RandomMatrices random(9);
  ComPlanner used = make_planner();
  for (int trial = 0; trial < kTrials; ++trial) {
    plan(used, random_walk(random), random.uniform(0.0, 2.0), random_start(random));
    const Phases phases = random_walk(random);
    const Motion<Vec2> start = random_start(random);
    ComPlanner fresh = make_planner();
    plan(fresh, phases, 1.0, start);
    plan(used, phases, 1.0, start);
    for (double t = 1.0; t < fresh.end_time(); t += 0.0513) {
      ASSERT_LT((fresh.at(t).p - used.at(t).p).norm(), 1e-7) << trial;
      ASSERT_LT((fresh.at(t).a - used.at(t).a).norm(), 1e-5) << trial;
    }
  }
}

TEST(ComPlanner, ReportsHowFarTheZmpHadToLeaveTheRegion) {
  ComPlanner planner = make_planner({.sample_interval = 0.0625});
  const Motion<Vec2> far_away{Vec2(2.0, 0.0), Vec2(0.0, 0.0), Vec2(0.0, 0.0)};
  SupportPhase triangle = standing(0.5, nominal_feet());
  triangle.down[index(Leg::RF)] = false;
  plan(planner, {triangle}, 0.0, far_away);
  EXPECT_GT(planner.zmp_slack(), 0.01);
  double furthest = 0.0;
  for (int i = 1; i <= 8; ++i) {
    const double t = 0.0625 * i;
    furthest = std::max(furthest, -region(planner, triangle, t).margin(planner.at(t - 1e-12).zmp));
  }
  EXPECT_NEAR(planner.zmp_slack(), furthest, 1e-6);
}

TEST(ComPlanner, LeavesTheRegionByNoMoreThanItMust) {
  // One foot carries the weight: what the ZMP can't do is to follow it, yet it comes near.
  ComPlanner planner = make_planner();
  SupportPhase one_foot = standing(0.6, nominal_feet());
  one_foot.down = {true, false, false, false};
  const Motion<Vec2> over_it{nominal_feet()[0], {0, 0}, {0, 0}};
  plan(planner, {one_foot}, 0.0, over_it);
  EXPECT_LT(planner.zmp_slack(), 1e-6);
  plan(planner, {one_foot}, 0.0, {over_it.p, {0.2, 0.0}, {0, 0}});
  EXPECT_GT(planner.zmp_slack(), 1e-4);
  EXPECT_LT(planner.zmp_slack(), 0.2);
}

TEST(ComPlanner, IsFiniteWhateverFeetAreDown) {
  RandomMatrices random(10);
  ComPlanner planner = make_planner();
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Phases phases;
    const int count = random.integer(1, ComPlanner::kMaxPhases);
    for (int i = 0; i < count; ++i) {
      SupportPhase phase = standing(random.uniform(0.0, 1.0), nominal_feet());
      for (std::size_t k = 0; k < kNumLegs; ++k) {
        phase.feet[k] = random.chance(0.2) ? phase.feet[0] : Vec2(random.vector(2));
        phase.down[k] = random.chance(0.6);
        phase.loaded_for[k] = random.uniform(-0.1, 0.2);
        phase.lifts_in[k] = random.chance(0.5) ? kInfinity : random.uniform(-0.5, 0.5);
      }
      phase.must_rest = random.chance(0.5);
      phases.push_back(phase);
    }
    plan(planner, phases, 1.0, {random.vector(2), random.vector(2), random.vector(2)},
         random.vector(2));
    EXPECT_TRUE(std::isfinite(planner.zmp_slack()));
    EXPECT_GE(planner.zmp_slack(), 0.0);
    for (double t = 0.9; t < planner.end_time() + 0.1; t += 0.05) {
      const ComPlan at = planner.at(t);
      ASSERT_TRUE(at.p.allFinite() && at.v.allFinite() && at.a.allFinite() && at.zmp.allFinite());
    }
  }
}

TEST(ComPlanner, WithoutAnyPhaseKeepsTheLastPlan) {
  ComPlanner planner = make_planner();
  EXPECT_EQ(planner.at(3.0).p, Vec2::Zero());
  plan(planner, walk(1, nominal_feet(), {0.1, 0.0}), 0.0, {{0.01, 0.02}, {0, 0}, {0, 0}});
  const Vec2 before = planner.at(1.0).p;
  plan(planner, {}, 0.5, {{9.0, 9.0}, {0, 0}, {0, 0}});
  EXPECT_EQ(planner.at(1.0).p, before);
}

TEST(ComPlanner, KeepsTheLastPlanWhereTheNewOneWouldBeNoNumber) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    ComPlanner planner = make_planner();
    const Phases phases = walk(1, nominal_feet(), {0.1, 0.0});
    plan(planner, phases, 0.0, {{0.01, 0.02}, {0, 0}, {0, 0}});
    const ComPlanner& now = planner;
    const ComPlan before = now.at(1.0);
    const double end = now.end_time();
    plan(planner, phases, 0.5, {{bad, 0.0}, {0, 0}, {0, 0}});
    plan(planner, phases, 0.5, {{0, 0}, {0.0, bad}, {0, 0}});
    plan(planner, phases, 0.5, {{0, 0}, {0, 0}, {0, 0}}, {bad, 0.0});
    EXPECT_EQ(now.at(1.0).p, before.p);
    EXPECT_EQ(now.at(1.0).zmp, before.zmp);
    EXPECT_EQ(now.end_time(), end);
  }
}

TEST(ComPlanner, HoldsTheZmpInsideToTheEndOfAPhaseWhoseRegionHasManyEdges) {
  RandomMatrices random(13);
  ComPlanner planner = make_planner({.terminal_weight = 100.0});
  const SupportPhase stand = standing(1.0, nominal_feet());
  ASSERT_GT(region(planner, stand, 1.0).num_edges(), 6) << "all four corners are cut off";
  for (int trial = 0; trial < kTrials; ++trial) {
    const double angle = random.uniform(-3.0, 3.0);  // which asks for much at the end
    plan(planner, {stand}, 0.0, {{0, 0}, {0, 0}, {0, 0}},
         1.5 * Vec2(std::cos(angle), std::sin(angle)));
    EXPECT_LT(planner.zmp_slack(), 1e-6);
  }
}

TEST(ComPlanner, LeavesOutPhasesThatAreTooShortOrTooMany) {
  ComPlanner planner = make_planner();
  const SupportPhase stand = standing(0.5, nominal_feet());
  Phases phases{stand};
  for (const double duration : {0.0, 1e-4, -1.0, kNaN}) {
    phases.push_back(standing(duration, nominal_feet()));
  }
  plan(planner, phases, 0.0, {{0, 0}, {0, 0}, {0, 0}});
  EXPECT_NEAR(planner.end_time(), 0.5, 1e-12);
  plan(planner, Phases(ComPlanner::kMaxPhases + 5, stand), 0.0, {{0, 0}, {0, 0}, {0, 0}});
  EXPECT_NEAR(planner.end_time(), 0.5 * ComPlanner::kMaxPhases, 1e-12);
}

TEST(ComPlanner, AFootsShareRampsUpFromTouchdownAndDownToLiftOff) {
  const ForceOptions force{.max = 240.0, .ramp_up = 0.1, .ramp_down = 0.2};
  const ComPlanner planner(ComPlannerOptions{}, force, kWeight);
  SupportPhase phase = standing(1.0, nominal_feet());
  phase.loaded_for[0] = 0.0;
  phase.lifts_in[0] = 0.8;
  EXPECT_NEAR(planner.share(phase, 0, 0.0), 0.0, 1e-12);
  EXPECT_NEAR(planner.share(phase, 0, 0.05), 0.4, 1e-12);
  EXPECT_NEAR(planner.share(phase, 0, 0.3), 0.8, 1e-12);
  EXPECT_NEAR(planner.share(phase, 0, 0.7), 0.4, 1e-12);
  EXPECT_NEAR(planner.share(phase, 0, 0.8), 0.0, 1e-12);
  EXPECT_NEAR(planner.share(phase, 0, 0.9), 0.0, 1e-12);
  EXPECT_NEAR(planner.share(phase, 1, 0.5), 0.8, 1e-12);
  phase.down[1] = false;
  EXPECT_EQ(planner.share(phase, 1, 0.5), 0.0);
}

TEST(ComPlanner, WithoutRampsOrWithRampsOfNoLengthAFootCarriesAllAtOnce) {
  for (const ForceOptions& force : {ForceOptions{.max = 240.0, .ramps = false},
                                    ForceOptions{.max = 240.0, .ramp_up = 0.0, .ramp_down = 0.0}}) {
    const ComPlanner planner(ComPlannerOptions{}, force, kWeight);
    SupportPhase phase = standing(0.5, nominal_feet());
    phase.loaded_for[0] = 0.0;
    phase.lifts_in[0] = 0.5;
    for (const double t : {0.001, 0.1, 0.499}) EXPECT_NEAR(planner.share(phase, 0, t), 0.8, 1e-12);
    EXPECT_TRUE(std::isfinite(planner.share(phase, 0, 0.5)));
    EXPECT_TRUE(std::isfinite(planner.share(phase, 0, 0.0)));
  }
}

TEST(ComPlanner, AllocatesNothingWhilePlanning) {
  RandomMatrices random(11);
  ComPlanner planner = make_planner();
  std::vector<Phases> walks;
  for (int i = 0; i < 10; ++i) walks.push_back(random_walk(random));
  const test::MallocCounter counter;
  for (const Phases& phases : walks) {
    plan(planner, phases, 0.0, {{0, 0}, {0, 0}, {0, 0}});
    (void)planner.at(0.7);
  }
  EXPECT_EQ(counter.count(), 0u);
}

}  // namespace
}  // namespace surefoot
