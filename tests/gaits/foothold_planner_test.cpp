#include "tests/gaits/foothold_walker.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot::gaits {
namespace {

using test::command;
using test::kCycle;
using test::kOrder;
using test::Random;
using test::turned;
using test::Walker;

const FootholdOptions kWithoutPrints{.hind_use_front_prints = false};

TEST(FootholdPlanner, TheNominalStanceIsARectangle) {
  const StanceOptions stance{.half_length = 0.3, .half_width = 0.2};
  EXPECT_EQ(nominal_offset(stance, Leg::LF, kNumLegs), Vec2(0.3, 0.2));
  EXPECT_EQ(nominal_offset(stance, Leg::RF, kNumLegs), Vec2(0.3, -0.2));
  EXPECT_EQ(nominal_offset(stance, Leg::LH, kNumLegs), Vec2(-0.3, 0.2));
  EXPECT_EQ(nominal_offset(stance, Leg::RH, kNumLegs), Vec2(-0.3, -0.2));
}

TEST(FootholdPlanner, SteppingOnTheSpotStaysOnTheSpot) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    Walker walker(kWithoutPrints);
    walker.stand(random.vector(10.0).head<2>(), random.uniform(-3.0, 3.0));
    for (const Leg leg : kLegs) {
      EXPECT_LT((walker.next(leg, command(0.0)) - walker.feet[index(leg)]).norm(), 1e-12);
    }
  }
}

TEST(FootholdPlanner, ASteadyWalkKeepsItsFeetAnEighthAndThreeEighthsOfAStrideFromTheirPlaces) {
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Walker walker(kWithoutPrints);
    walker.stand(random.vector(10.0).head<2>(), random.uniform(-3.0, 3.0));
    const UserCommand user = command(random.uniform(-0.06, 0.06), random.uniform(-0.03, 0.03));
    const Vec2 stride = turned(walker.yaw, kCycle * user.velocity);
    walker.walk(60, user);
    for (int i = 0; i < 8; ++i) {
      walker.step(user);
      EXPECT_LT((walker.last_step.head<2>() - stride).norm(), 1e-6);
      for (int ago = 0; ago < kNumLegs; ++ago) {
        const Leg leg = kOrder[static_cast<std::size_t>(walker.steps - 1 - ago) % kOrder.size()];
        const double place = 3.0 / 8.0 - 2.0 / 8.0 * ago;
        EXPECT_LT((walker.center_by(leg) - walker.center() - place * stride).norm(), 1e-6);
      }
    }
  }
}

TEST(FootholdPlanner, ADistortedStanceBecomesNominalWithinFewSteps) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Walker walker(kWithoutPrints);
    walker.stand(Vec2::Zero(), random.uniform(-3.0, 3.0));
    for (Vec3& foot : walker.feet) foot.head<2>() += random.vector(0.05).head<2>();
    walker.walk(8, command(0.0));
    EXPECT_LT(walker.distortion(), 0.01) << trial;
    walker.walk(40, command(0.0));
    EXPECT_LT(walker.distortion(), 1e-6) << trial;
  }
}

TEST(FootholdPlanner, TheStanceTurnsWithTheHeadingAndKeepsItsShape) {
  for (const double yaw_rate : {-0.1, -0.03, 0.05, 0.1}) {
    Walker walker(kWithoutPrints);
    walker.stand(Vec2(3.0, -1.0), 0.4);
    const UserCommand user = command(0.0, 0.0, yaw_rate);
    double largest = 0.0;
    for (int i = 0; i < 80; ++i) {
      walker.step(user);
      largest = std::max(largest, walker.distortion());
    }
    const double turned_in_a_cycle = std::abs(yaw_rate) * kCycle * std::hypot(0.36, 0.22);
    EXPECT_LT(largest, 0.8 * turned_in_a_cycle) << yaw_rate;
    EXPECT_LT((walker.center() - Vec2(3.0, -1.0)).norm(), 0.1) << yaw_rate;
  }
}

TEST(FootholdPlanner, NoStepIsLongerThanTheLongest) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    Walker walker({.hind_use_front_prints = true, .max_step = 0.25});
    walker.stand(Vec2::Zero(), random.uniform(-3.0, 3.0));
    const UserCommand user =
        command(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-0.5, 0.5));
    for (int i = 0; i < 20; ++i) {
      walker.step(user);
      ASSERT_LE(walker.last_step.head<2>().norm(), 0.25 + 1e-9);
    }
  }
}

TEST(FootholdPlanner, FootholdsLieOnTheTerrainPlane) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    Walker walker(kWithoutPrints);
    walker.stand(random.vector(1.0).head<2>(), random.uniform(-3.0, 3.0));
    const estimation::TerrainPlane slope{random.small_rotation(0.2) * Vec3::UnitZ(),
                                         random.vector(1.0)};
    for (const Leg leg : kLegs) {
      const Vec3 p =
          walker.planner.foothold(leg, walker.feet, slope, walker.yaw, command(0.05), kCycle);
      EXPECT_NEAR(slope.normal.dot(p - slope.point), 0.0, 1e-12);
    }
  }
}

TEST(FootholdPlanner, TurnsAndMovesWithTheWorld) {
  Random random(6);
  for (int trial = 0; trial < 30; ++trial) {
    Walker here{FootholdOptions{}}, there{FootholdOptions{}};
    const double angle = random.uniform(-3.0, 3.0);
    const Vec2 shift = random.vector(10.0).head<2>();
    here.stand(Vec2::Zero(), 0.0);
    there.stand(shift, angle);
    const UserCommand user = command(random.uniform(-0.07, 0.07), random.uniform(-0.03, 0.03),
                                     random.uniform(-0.05, 0.05));
    for (int i = 0; i < 30; ++i) {
      here.step(user);
      there.step(user);
      for (std::size_t k = 0; k < kNumLegs; ++k) {
        const Vec2 expected = turned(angle, here.feet[k].head<2>()) + shift;
        ASSERT_LT((there.feet[k].head<2>() - expected).norm(), 1e-9);
      }
    }
  }
}

TEST(FootholdPlanner, HindFeetStepIntoTheFrontFeetsPrints) {
  Walker walker{FootholdOptions{}};
  walker.stand(Vec2::Zero(), 0.0);
  std::vector<Vec3> prints(walker.feet.begin(), walker.feet.end());
  walker.planner.remember(Leg::LF, walker.feet[0]);
  walker.planner.remember(Leg::RF, walker.feet[1]);
  const UserCommand user = command(0.06);
  int in_a_print = 0, hind_steps = 0;
  for (int i = 0; i < 80; ++i) {
    const Leg leg = kOrder[static_cast<std::size_t>(i) % kOrder.size()];
    walker.step(user);
    const Vec3 p = walker.feet[index(leg)];
    const bool hit = std::ranges::any_of(prints, [&](const Vec3& x) { return x == p; });
    hind_steps += is_front(leg) ? 0 : 1;
    in_a_print += !is_front(leg) && hit ? 1 : 0;
    if (is_front(leg)) prints.push_back(p);
    ASSERT_LT(walker.distortion(), 0.375 * 0.06 * kCycle + FootholdOptions{}.print_radius) << i;
  }
  EXPECT_GT(in_a_print, hind_steps / 2);
  EXPECT_NEAR(walker.center().x(), 0.06 * kCycle * 20, 0.1 * 0.06 * kCycle * 20);
}

/// A left hind foot at the origin of a walker that heads along x, and what its front foot found.
struct Hind {
  explicit Hind(const std::vector<Vec3>& prints, const FootholdOptions& options = {})
      : walker(options) {
    walker.ground = 0.0;
    walker.stand(-nominal_offset(walker.stance, Leg::LH, kNumLegs), 0.0);
    for (const Vec3& print : prints) walker.planner.remember(Leg::LF, print);
  }
  /// Nominally at x = 0.15.
  [[nodiscard]] Vec3 goes() const { return walker.next(Leg::LH, command(0.06)); }
  Walker walker;
};

TEST(FootholdPlanner, AHindFootTakesTheNearestPrintWithinItsRadius) {
  EXPECT_LT((Hind({}).goes() - Vec3(0.15, 0.0, 0.0)).norm(), 1e-12);
  const Vec3 near(0.20, 0.01, 0.002), far(0.26, 0.0, 0.0), behind(0.11, 0.0, 0.001);
  EXPECT_EQ(Hind({near}).goes(), near);
  EXPECT_EQ(Hind({far, near}).goes(), near);
  EXPECT_EQ(Hind({far, near, behind}).goes(), behind);
}

TEST(FootholdPlanner, PrintsOfAnotherWayAreNoneOfThisOne) {
  const double aside = StanceOptions{}.half_width + 0.01;
  for (const double side : {aside, -aside, 0.5})
    EXPECT_LT((Hind({Vec3(0.12, side, 0.0), Vec3(0.26, side, 0.14)}).goes() - Vec3(0.15, 0.0, 0.0))
                  .norm(),
              1e-12)
        << side;
}

TEST(FootholdPlanner, BetweenPrintsFarOffTheHindFootGoesWhereItWouldAtTheirHeight) {
  const Vec3 goal = Hind({Vec3(-0.02, 0.0, 0.01), Vec3(0.26, 0.0, 0.02)}).goes();
  EXPECT_LT((goal - Vec3(0.15, 0.0, 0.02)).norm(), 1e-12);
}

TEST(FootholdPlanner, AnEdgeBetweenTwoPrintsIsSteppedOver) {
  for (const double height : {-0.14, 0.14}) {
    const Vec3 before(0.12, 0.0, 0.0), beyond(0.26, 0.01, height);
    EXPECT_EQ(Hind({before, beyond}).goes(), beyond) << height;
  }
}

TEST(FootholdPlanner, PrintsThatRiseEvenlyAreASlopeAndNoEdge) {
  struct Stride {
    double length, rise;
  };
  // The second print is near where the foot would go; the third is behind an edge if there is one.
  const auto goes_over_an_edge = [](const Stride& first, const Stride& second) {
    for (const double up : {1.0, -1.0}) {
      const Vec3 near(0.12, 0.0, 0.0);
      const Vec3 goal = Hind({near - Vec3(first.length, 0.0, up * first.rise), near,
                              near + Vec3(second.length, 0.0, up * second.rise)})
                            .goes();
      if (goal.x() == near.x()) return false;
    }
    return true;
  };
  EXPECT_FALSE(goes_over_an_edge({0.13, 0.035}, {0.13, 0.035}));
  EXPECT_FALSE(goes_over_an_edge({0.15, 0.040}, {0.13, 0.035}));
  EXPECT_TRUE(goes_over_an_edge({0.13, 0.0}, {0.13, 0.035})) << "where the slope begins";
  EXPECT_TRUE(goes_over_an_edge({0.13, 0.015}, {0.13, 0.035})) << "not evenly";
  EXPECT_TRUE(goes_over_an_edge({0.10, 0.040}, {0.13, 0.046})) << "too steep before";
  EXPECT_TRUE(goes_over_an_edge({0.13, 0.040}, {0.11, 0.045})) << "too steep behind";
  EXPECT_TRUE(goes_over_an_edge({0.22, 0.070}, {0.17, 0.061})) << "a print on every tread";
}

TEST(FootholdPlanner, AStepUpMayBeLongerThanOthers) {
  const FootholdOptions shorter{.max_step = 0.22};
  const Vec3 before(0.05, 0.0, 0.0), level(0.23, 0.0, 0.0), higher(0.26, 0.0, 0.14);
  EXPECT_LT((Hind({before, level}, shorter).goes() - Vec3(0.15, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(Hind({before, higher}, shorter).goes(), higher);
  EXPECT_EQ(Hind({before, Vec3(0.26, 0.0, -0.14)}, shorter).goes(), before);
}

TEST(FootholdPlanner, AnEdgeWhoseFarSideIsOutOfReachIsWaitedFor) {
  for (const double height : {-0.14, 0.14}) {
    const Vec3 before(0.12, 0.0, 0.0), beyond(0.26, 0.0, height);
    EXPECT_EQ(Hind({before, beyond}, {.max_step = 0.20}).goes(), before) << height;
  }
}

TEST(FootholdPlanner, AHindFootThatWaitedGoesAsFarAsItCan) {
  for (const double height : {-0.14, 0.14}) {
    const Vec3 here(0.01, 0.0, 0.0), within(0.24, 0.0, height), beyond(0.30, 0.0, height);
    EXPECT_EQ(Hind({here, within}, {.max_step = 0.20}).goes(), within) << height;
    const Vec3 goal = Hind({here, beyond}, {.max_step = 0.20}).goes();
    EXPECT_LT((goal - Vec3(0.25, 0.0, std::max(0.0, height))).norm(), 1e-12) << height;
  }
}

TEST(FootholdPlanner, AFrontFootDoesNotRunAwayFromTheHindFootOfItsSide) {
  const FootholdOptions options{.max_step = 1.0, .stretch_max = 0.06};
  Walker walker(options);
  walker.stand(Vec2(2.0, 1.0), 0.7);
  const Vec2 heading = turned(walker.yaw, Vec2::UnitX());
  for (int i = 0; i < 10; ++i) {  // the hind feet stay
    for (const Leg leg : {Leg::LF, Leg::RF}) {
      walker.feet[index(leg)] = walker.next(leg, command(0.06));
      const Vec2 apart = (walker.feet[index(leg)] - walker.feet[index(same_side(leg))]).head<2>();
      EXPECT_LE(heading.dot(apart), 2.0 * walker.stance.half_length + options.stretch_max + 1e-9);
    }
  }
}

TEST(FootholdPlanner, OnlyFrontFeetLeavePrintsAndEachForItsOwnSide) {
  Hind hind({});
  hind.walker.planner.remember(Leg::RF, Vec3(0.2, 0.0, 0.0));
  hind.walker.planner.remember(Leg::LH, Vec3(0.2, 0.0, 0.0));
  EXPECT_LT((hind.goes() - Vec3(0.15, 0.0, 0.0)).norm(), 1e-12);
  hind.walker.planner.remember(Leg::LF, Vec3(0.2, 0.0, 0.0));
  EXPECT_EQ(hind.goes(), Vec3(0.2, 0.0, 0.0));
}

TEST(FootholdPlanner, APrintWhereThereWasNoGroundIsTakenBack) {
  Hind hind({Vec3(0.2, 0.0, 0.0)});
  hind.walker.planner.remember(Leg::LF, Vec3(0.16, 0.0, 0.05));
  EXPECT_EQ(hind.goes(), Vec3(0.16, 0.0, 0.05));
  hind.walker.planner.forget_last(Leg::LH);
  EXPECT_EQ(hind.goes(), Vec3(0.16, 0.0, 0.05)) << "a hind foot leaves none";
  hind.walker.planner.forget_last(Leg::LF);
  EXPECT_EQ(hind.goes(), Vec3(0.2, 0.0, 0.0));
  hind.walker.planner.forget_last(Leg::LF);
  hind.walker.planner.forget_last(Leg::LF);
  EXPECT_LT((hind.goes() - Vec3(0.15, 0.0, 0.0)).norm(), 1e-12) << "there is none left";
  for (int i = 0; i < 20; ++i) hind.walker.planner.remember(Leg::LF, Vec3(5.0 + i, 0.0, 0.0));
  hind.walker.planner.remember(Leg::LF, Vec3(0.16, 0.0, 0.05));
  hind.walker.planner.forget_last(Leg::LF);
  EXPECT_LT((hind.goes().head<2>() - Vec2(0.15, 0.0)).norm(), 1e-12) << "after many, too";
}

TEST(FootholdPlanner, PrintsAndVoidsCanAllBeForgotten) {
  Hind hind({Vec3(0.2, 0.0, 0.0)});
  hind.walker.planner.avoid(Vec3(0.15, 0.0, 0.0));
  hind.walker.planner.forget();
  EXPECT_LT((hind.goes() - Vec3(0.15, 0.0, 0.0)).norm(), 1e-12);
}

TEST(FootholdPlanner, PrintsAreForgottenAfterMany) {
  Hind hind({Vec3(0.2, 0.0, 0.0)});
  for (int i = 0; i < 30; ++i) hind.walker.planner.remember(Leg::LF, Vec3(5.0 + i, 0.0, 0.0));
  EXPECT_LT((hind.goes().head<2>() - Vec2(0.15, 0.0)).norm(), 1e-12);
}

TEST(FootholdPlanner, WithoutPrintsInUseHindFeetGoWhereTheyNominallyWould) {
  const Hind hind({Vec3(0.12, 0.0, 0.0), Vec3(0.26, 0.0, -0.14)}, kWithoutPrints);
  EXPECT_LT((hind.goes() - Vec3(0.15, 0.0, 0.0)).norm(), 1e-12);
}

TEST(FootholdPlanner, KeepsAwayFromWhereThereWasNoGround) {
  const FootholdOptions options;
  for (const Leg leg : kLegs) {
    Walker walker(kWithoutPrints);
    walker.stand({0.3, -0.2}, 0.7);
    const UserCommand user = command(0.04);
    std::vector<Vec3> voids;
    for (int found_none = 0; found_none < 5; ++found_none) {
      const Vec3 place = walker.next(leg, user);
      for (const Vec3& known : voids) {
        EXPECT_GE((place - known).head<2>().norm(), options.void_radius);
      }
      EXPECT_NE(place, walker.feet[index(leg)]) << found_none;
      EXPECT_LE((place - walker.feet[index(leg)]).norm(), 1.25 * options.max_step);
      EXPECT_NEAR(place.z(), walker.ground, 1e-12);
      voids.push_back(place);
      walker.planner.avoid(place);
    }
    for (const Leg other : kLegs) {
      Walker unaware(kWithoutPrints);
      unaware.stand({0.3, -0.2}, 0.7);
      if (other == leg) continue;
      EXPECT_EQ(walker.next(other, user), unaware.next(other, user));
    }
  }
}

TEST(FootholdPlanner, DoesNotStretchALegToGetOverWhereThereWasNoGround) {
  const FootholdOptions options{.stretch_max = 0.06};
  Walker walker(options);
  walker.stand({0.0, 0.0}, 0.0);
  const double hind = walker.feet[index(Leg::LH)].x();
  const double furthest = hind + 2.0 * walker.stance.half_length + options.stretch_max;
  for (int found_none = 0; found_none < 6; ++found_none) {
    const Vec3 place = walker.next(Leg::LF, command(0.04));
    EXPECT_LT(place.x(), furthest + 1e-12) << found_none;
    walker.planner.avoid(place);
  }
}

TEST(FootholdPlanner, StepsOnTheSpotWhereNothingElseIsLeftAndTriesAgainLater) {
  Walker walker(kWithoutPrints);
  walker.stand({0.0, 0.0}, 0.0);
  const Vec3 nominal = walker.next(Leg::LF, command(0.04));
  for (int i = 0; i < 8; ++i) walker.planner.avoid(walker.next(Leg::LF, command(0.04)));
  EXPECT_EQ(walker.next(Leg::LF, command(0.04)), walker.feet[index(Leg::LF)]);
  for (int i = 0; i < 24; ++i) walker.planner.remember(Leg::LF, walker.feet[index(Leg::LF)]);
  EXPECT_EQ(walker.next(Leg::LF, command(0.04)), nominal);
}

}  // namespace
}  // namespace surefoot::gaits
