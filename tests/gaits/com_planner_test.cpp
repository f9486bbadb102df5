// What a plan of the centre of mass is.
#include "surefoot/solver/certificate.hpp"
#include "tests/gaits/com_plans.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

TEST(ComPlanner, IsASmoothMotionFromTheGivenStateThatHoldsStillAtItsEnd) {
  test::on_random_walks(
      1, [](const ComPlanner& planner, const test::Phases& phases, double time, const auto& start) {
        const auto expect_close = [](const ComPlan& at, const auto& other, double p, double v,
                                     double a) {
          EXPECT_LT((at.p - other.p).norm(), p);
          EXPECT_LT((at.v - other.v).norm(), v);
          EXPECT_LT((at.a - other.a).norm(), a);
        };
        expect_close(planner.at(time), start, 1e-12, 1e-12, 1e-12);
        double knot = time;
        for (std::size_t k = 0; k + 1 < phases.size(); ++k) {
          knot += phases[k].duration;
          expect_close(planner.at(knot - 1e-7), planner.at(knot + 1e-7), 1e-6, 1e-5, 1e-4);
        }
        EXPECT_NEAR(planner.end_time(), time + test::total_duration(phases), 1e-9);
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

TEST(ComPlanner, VelocityAndAccelerationAreRatesAndTheZmpGoesWithThem) {
  test::on_random_walks(
      3, [](const ComPlanner& planner, const test::Phases& phases, double time, const auto&) {
        const double step = 1e-5;
        const double last = test::total_duration(phases) - 2.0 * step;
        for (double t = 2.0 * step; t < last; t += 0.0371) {
          const ComPlan before = planner.at(time + t - step);
          const ComPlan now = planner.at(time + t);
          const ComPlan after = planner.at(time + t + step);
          EXPECT_LT(((after.p - before.p) / (2.0 * step) - now.v).norm(), 1e-5);
          EXPECT_LT(((after.v - before.v) / (2.0 * step) - now.a).norm(), 1e-3);
          EXPECT_LT((now.p - test::kHeight / kGravity * now.a - now.zmp).norm(), 1e-12);
        }
      });
}

TEST(ComPlanner, OfAWalkTheZmpStaysInTheSupportRegionAndTheCapturePointInTheTriangleOfASwing) {
  test::on_random_walks(
      4, [](const ComPlanner& planner, const test::Phases& phases, double time, const auto&) {
        EXPECT_EQ(planner.zmp_slack(), 0.0);
        // Margins hold at the planner's samples; between two of them a part of them may be used.
        const ComPlannerOptions options;
        test::over(phases, time, [&](const SupportPhase& phase, double t, double at) {
          const ComPlan com = planner.at(at);
          const SupportRegion region = test::region(planner, phase, t);
          const bool settled = at - time > 0.2;  // the start is given, not planned
          const double least = settled ? 0.5 * options.zmp_margin : -0.01;
          EXPECT_GT(region.margin(com.zmp), least) << at - time;
          const Vec2 capture_point = com.p + std::sqrt(test::kHeight / kGravity) * com.v;
          EXPECT_GT(phase.must_rest ? region.margin(capture_point) : kInfinity,
                    0.5 * options.rest_margin);
        });
      });
}

/// The first two swings of a walk, from a stance and in the times that one began with.
test::Phases first_swings() {
  SupportPhase phase = test::standing(1.6966556840573368, test::nominal_feet());
  phase.feet = {Vec2(0.34392903031212496, 0.22248471347493165),
                Vec2(0.3432923728855794, -0.21560000511786873),
                Vec2(-0.32056328666397005, 0.22315737558626841),
                Vec2(-0.33399491779732515, -0.21576909048892395)};
  phase.heights = {0.0016297014027423715, 0.0018094502902183882, -0.00081923523898253664,
                   9.2132675750741799e-06};
  phase.loaded_for.fill(1009.5);
  test::Phases phases;
  const auto add = [&](double duration, bool must_rest) {
    phase.duration = duration;
    phase.must_rest = must_rest;
    phases.push_back(phase);
    test::elapse(phase);
  };
  const auto land = [&](Leg leg, const Vec2& foot, double height) {
    phase.down[index(leg)] = true;
    phase.feet[index(leg)] = foot;
    phase.heights[index(leg)] = height;
    phase.loaded_for[index(leg)] = 0.0;
    phase.lifts_in[index(leg)] = kInfinity;
  };
  phase.lifts_in[index(Leg::LH)] = phase.duration;
  add(phase.duration, false);
  phase.down[index(Leg::LH)] = false;
  add(0.35, true);
  land(Leg::LH, {-0.034334200315897678, 0.22356824836360184}, 0.0059382558286768458);
  phase.lifts_in[index(Leg::LF)] = 0.15;
  add(0.15, false);
  phase.down[index(Leg::LF)] = false;
  add(0.35, true);
  land(Leg::LF, {0.69722307127112049, 0.2236709665579352}, 0.0092484478317083271);
  add(0.3, false);
  return phases;
}

// Rows of neighbouring samples nearly say the same: a solver that stops where two pieces of its
// objective meet leads the COM of the first of these plans 80 m away.
TEST(ComPlanner, EveryPlanIsOptimal) {
  test::RandomMatrices random(7);
  ComPlanner planner(ComPlannerOptions{.zmp_margin = 0.055},
                     ForceOptions{.ramp_up = 0.06, .ramp_down = 0.07});
  constexpr int kPlans = 200;
  for (int trial = 0; trial < kPlans; ++trial) {
    test::Phases phases = first_swings();
    const double size = trial == 0 ? 0.0 : 0.02;
    const double later = trial == 0 ? 0.0 : random.uniform(-1.2, 0.3);
    phases.front().duration += later;
    phases.front().lifts_in[index(Leg::LH)] += later;
    for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
      const Vec2 shift(random.uniform(-size, size), random.uniform(-size, size));
      for (SupportPhase& phase : phases) phase.feet[leg] += shift;
    }
    ComProblem problem{
        .time = 9.5,
        .begin = {Vec2(0.014549859590972594, 0.00060189375878823368),
                  Vec2(-0.00022765192236675642, -0.00034386842946236318), Vec2::Zero()},
        .height = 0.44354665222145256,
        .weight = 298.96363929222008,
        .end_velocity = {0.2, 0.0}};
    for (const SupportPhase& phase : phases) problem.add(phase);
    planner.plan(problem);
    const double worst =
        solver::worst_stationarity(solver::certify(planner.hierarchy(), planner.solution().x));
    EXPECT_LT(worst, 1e-8) << "trial " << trial;
    EXPECT_LT(planner.at(planner.end_time()).p.norm(), 0.5) << "trial " << trial;
  }
}

TEST(ComPlanner, OfAWalkCostsAFractionOfADescent) {
  double planned = 0.0, descending = 0.0;
  test::on_random_walks(
      5, [&](const ComPlanner& planner, const test::Phases&, double, const auto&) {
        solver::LexicographicSolver cold(planner.hierarchy(), {.warm_start = false});
        descending += cold.solve(planner.hierarchy()).flops;
        planned += planner.solution().flops;
      });
  EXPECT_LT(planned, 0.3 * descending);
}

TEST(ComPlanner, EndsNearTheMiddleOfTheLastFeetWithTheGivenVelocity) {
  ComPlanner planner = test::make_planner({.terminal_weight = 100.0});
  const Vec2 velocity(0.05, -0.02);
  test::plan(planner, {test::standing(2.0, test::nominal_feet())}, 0.0,
             {Vec2(0.05, 0.02), {0, 0}, {0, 0}}, velocity);
  const ComPlan end = planner.at(planner.end_time() - 1e-9);
  EXPECT_LT(end.p.norm(), 1e-3);
  EXPECT_LT((end.v - velocity).norm(), 1e-3);
}

TEST(ComPlanner, ComesToRestOverItsFeetWhereItIsToldTo) {
  test::RandomMatrices random(12);
  ComPlanner planner = test::make_planner();
  for (int trial = 0; trial < test::kTrials; ++trial) {
    const Motion<Vec2> start = test::random_start(random);
    test::plan(planner, {test::standing(1.0, test::nominal_feet())}, 0.0, start, Vec2::Zero(),
               {.comes_to_rest = true});
    const ComPlan end = planner.at(1.0 - 1e-9);
    EXPECT_LT(end.p.norm(), 1e-3);
    EXPECT_LT(end.v.norm(), 1e-3);
    EXPECT_LT(end.a.norm(), 1e-2);
    EXPECT_LT(planner.zmp_slack(), 1e-9);
  }
}

TEST(ComPlanner, IsTheLeastSquaresPlanWhereNothingLimitsIt) {
  test::RandomMatrices random(7);
  const ComPlannerOptions options{.terminal_weight = 0.8};
  ComPlanner planner = test::make_planner(options);
  PerLeg<Vec2> feet = test::nominal_feet();
  for (Vec2& foot : feet) foot *= 100.0;
  for (int trial = 0; trial < test::kTrials; ++trial) {
    const double T = random.uniform(0.3, 2.0);
    const Motion<Vec2> begin = test::random_start(random);
    const Vec2 velocity(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
    test::plan(planner, {test::standing(T, feet)}, 3.0, begin, velocity);
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
  test::RandomMatrices random(8);
  for (int trial = 0; trial < test::kTrials; ++trial) {
    const test::Phases phases = test::random_walk(random);
    const Motion<Vec2> start = test::random_start(random);
    const Vec2 velocity(0.05, 0.01);
    const Mat2 R = Eigen::Rotation2Dd(random.uniform(-3.0, 3.0)).toRotationMatrix();
    const Vec2 shift(random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0));
    test::Phases moved = phases;
    for (SupportPhase& phase : moved) {
      for (Vec2& foot : phase.feet) foot = R * foot + shift;
    }
    ComPlanner here = test::make_planner(), there = test::make_planner();
    test::plan(here, phases, 0.0, start, velocity);
    test::plan(there, moved, 50.0, {R * start.p + shift, R * start.v, R * start.a}, R * velocity);
    for (double t = 0.0; t < test::total_duration(phases); t += 0.0513) {
      const ComPlan a = here.at(t), b = there.at(50.0 + t);
      ASSERT_LT((R * a.p + shift - b.p).norm(), 1e-6);
      ASSERT_LT((R * a.v - b.v).norm(), 1e-6);
      ASSERT_LT((R * a.zmp + shift - b.zmp).norm(), 1e-6);
    }
  }
}

TEST(ComPlanner, DoesNotDependOnThePlanBefore) {
  test::RandomMatrices random(9);
  ComPlanner used = test::make_planner();
  for (int trial = 0; trial < test::kTrials; ++trial) {
    test::plan(used, test::random_walk(random), random.uniform(0.0, 2.0),
               test::random_start(random));
    const test::Phases phases = test::random_walk(random);
    const Motion<Vec2> start = test::random_start(random);
    ComPlanner fresh = test::make_planner();
    test::plan(fresh, phases, 1.0, start);
    test::plan(used, phases, 1.0, start);
    for (double t = 1.0; t < fresh.end_time(); t += 0.0513) {
      ASSERT_LT((fresh.at(t).p - used.at(t).p).norm(), 1e-7) << trial;
      ASSERT_LT((fresh.at(t).a - used.at(t).a).norm(), 1e-5) << trial;
    }
  }
}

TEST(ComPlanner, ReportsHowFarTheZmpHadToLeaveTheRegion) {
  ComPlanner planner = test::make_planner({.sample_interval = 0.0625});
  const Motion<Vec2> far_away{Vec2(2.0, 0.0), Vec2(0.0, 0.0), Vec2(0.0, 0.0)};
  SupportPhase triangle = test::standing(0.5, test::nominal_feet());
  triangle.down[index(Leg::RF)] = false;
  test::plan(planner, {triangle}, 0.0, far_away);
  EXPECT_GT(planner.zmp_slack(), 0.01);
  double furthest = 0.0;
  for (int i = 1; i <= 8; ++i) {
    const double t = 0.0625 * i;
    furthest =
        std::max(furthest, -test::region(planner, triangle, t).margin(planner.at(t - 1e-12).zmp));
  }
  EXPECT_NEAR(planner.zmp_slack(), furthest, 1e-6);
}

TEST(ComPlanner, LeavesTheRegionByNoMoreThanItMust) {
  // One foot carries the weight: what the ZMP can't do is to follow it, yet it comes near.
  ComPlanner planner = test::make_planner();
  SupportPhase one_foot = test::standing(0.6, test::nominal_feet());
  one_foot.down = {true, false, false, false};
  const Motion<Vec2> over_it{test::nominal_feet()[0], {0, 0}, {0, 0}};
  test::plan(planner, {one_foot}, 0.0, over_it);
  EXPECT_LT(planner.zmp_slack(), 1e-6);
  test::plan(planner, {one_foot}, 0.0, {over_it.p, {0.2, 0.0}, {0, 0}});
  EXPECT_GT(planner.zmp_slack(), 1e-4);
  EXPECT_LT(planner.zmp_slack(), 0.2);
}

}  // namespace
}  // namespace surefoot::gaits
