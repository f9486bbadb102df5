#include "tests/solver/solve.hpp"
#include "tests/support/linear_algebra.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// What counts as rounding in the certificate: which rows of the levels above are fixed.

namespace surefoot::solver {
namespace {

TEST(CertificateRounding, DoesNotLeaveRowsThatAHigherLevelHoldsWhereWhatItFixesIsNearlyDependent) {
  // In coordinates (p, q1, q2, w), turned at random: the third level pulls at q1 + q2 by so little
  // that the null space of its row is only known to 1e-8, but for certain it holds q1 and q2 where
  // they are, so the fourth has nothing but w to reach further.
  constexpr double kWeak = 5e-9, kWeaker = 3e-9;
  constexpr CertificateOptions kTolerance{.tight = 1e-8, .rank = RankTolerance{}.solve};
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(4);
    const auto row = [&](double p, double q1, double q2, double w) -> MatrixXd {
      return Eigen::RowVector4d(p, q1, q2, w) * R;
    };
    const HierarchyData levels{equalities(row(1, 0, 0, 0), number(0.0)),
                               at_most(R.bottomRows(3), Vector3d(0.0, 0.0, 1.0)),
                               equalities(row(1, kWeak, kWeak, 0), number(1.0)),
                               equalities(row(1, 1, -1, kWeaker), number(10.0)),
                               equalities(row(0, 0, 0, 1), number(-5.0))};
    const Hierarchy hierarchy = make_hierarchy(4, levels);
    const VectorXd expected = R.transpose() * Eigen::Vector4d(0, 0, 0, 1);
    EXPECT_LE((LexicographicSolver(hierarchy).solve(hierarchy).x - expected).norm(), 1e-12);
    EXPECT_LE((CascadeSolver(hierarchy).solve(hierarchy).x - expected).norm(), 1e-12);
    EXPECT_LE(worst_stationarity(certify(hierarchy, expected, kTolerance)), kProven)
        << random.seed();
    // Beside it the third level misses its optimum by 1e-9 only, the fourth by a tenth.
    const VectorXd beyond = R.transpose() * Eigen::Vector4d(0, -1, 0, 1);
    EXPECT_GE(worst_stationarity(certify(hierarchy, beyond, kTolerance)), 1e-2) << random.seed();
  }
}

/// (1, 0) x = 0 and (1, weak) x = 1, which can't both be had without going far along the second
/// coordinate: they pull at it by weak / 2.
LevelData pulling(double weak, const MatrixXd& R) {
  MatrixXd rows(2, 2);
  rows << 1.0, 0.0, 1.0, weak;
  return equalities(rows * R, Vector2d(0.0, 1.0));
}

TEST(CertificateRounding, ALimitThatItsLevelIsBeyondByLittleButForCertainIsNotLeft) {
  // In coordinates (a, b), turned at random: b ≤ 0 gives way by 1.5e-9 to what pulls at it. That
  // fixes b, so the second level has nothing; also where an error of x is beyond it a little more.
  constexpr double kWeak = 3e-9;
  for (const double error : {0.0, 0.2}) {
    for (int seed = 0; seed < 100; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", error " + std::to_string(error));
      RandomMatrices random(static_cast<std::uint64_t>(seed));
      const MatrixXd R = random.rotation(2);
      const HierarchyData levels{
          joined(pulling(kWeak, R), at_most(RowVector2d(0.0, 1.0) * R, number(0.0))),
          equalities(RowVector2d(0.0, 1.0) * R, number(-1.0))};
      const VectorXd x = R.transpose() * Vector2d(0.5, 0.5 * (1.0 + error) * kWeak);
      ASSERT_LE(optimality_error(2, levels, x), kProven);
    }
  }
}

TEST(CertificateRounding, ALimitThatHoldsByLittleButByMoreThanRoundingIsNotLeft) {
  // In coordinates (a, b), turned at random: the second level misses its rows by half each, and
  // pulls at b ≤ 0 by 4e-10 of that.
  constexpr double kWeak = 8e-10;
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(2);
    const HierarchyData levels{at_most(RowVector2d(0.0, 1.0) * R, number(0.0)), pulling(kWeak, R),
                               equalities(RowVector2d(0.0, 1.0) * R, number(-1.0))};
    ASSERT_LE(optimality_error(2, levels, R.transpose() * Vector2d(0.5, 0.0)), kProven);
  }
}

TEST(CertificateRounding, ALimitThatOnlyWhatIsFixedAboveCouldMeetIsNotLeft) {
  // As above, but the limit is b + c ≤ 0, and a level above has c = 0.
  constexpr double kWeak = 3e-9;
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(3);
    const HierarchyData levels{
        equalities(RowVector3d(0.0, 0.0, 1.0) * R, number(0.0)),
        joined(pulling(kWeak, R.topRows(2)), at_most(RowVector3d(0.0, 1.0, 1.0) * R, number(0.0))),
        equalities(RowVector3d(0.0, 1.0, 0.0) * R, number(-1.0))};
    ASSERT_LE(optimality_error(3, levels, R.transpose() * Vector3d(0.5, 0.5 * kWeak, 0.0)),
              kProven);
  }
}

TEST(CertificateRounding, ALimitThatAnErrorOfXIsBeyondIsLeft) {
  // At the corner of two limits, beyond both by `error`; the level above is met but for what can't
  // be. The second level asks x to go back by 0.1, which nothing forbids.
  for (const double contradiction : {1.0, 1e3}) {
    for (const double error : {1e-9, 1e-11, 1e-12}) {
      for (int seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", error " + std::to_string(error));
        RandomMatrices random(static_cast<std::uint64_t>(seed));
        const MatrixXd R = random.rotation(3);
        const MatrixXd limits = random.matrix(2, 2) * R.topRows(2);
        MatrixXd twice(2, 3);
        twice << R.row(2), R.row(2);
        const LevelData first = joined(at_most(limits, Vector2d::Zero()),
                                       equalities(twice, contradiction * Vector2d(-1.0, 1.0)));
        const VectorXd x = test::least_squares(limits, error * Vector2d::Ones());
        const HierarchyData back{first, equalities(limits, -0.1 * Vector2d::Ones())};
        ASSERT_GE(optimality_error(3, back, x), 1e-3);
        const HierarchyData further{first, equalities(limits, Vector2d::Ones())};
        ASSERT_LE(optimality_error(3, further, x), 1e-8);
      }
    }
  }
}

TEST(CertificateRounding, AnErrorOfXBeyondTwoLimitsOfWhichOneIsLongerHoldsNeither) {
  // a ≤ 0 and 3 a ≤ 2.7e-9 at a = 1e-9: the step that takes the second away leaves of the first
  // most, until the second doesn't count.
  MatrixXd limits(2, 1);
  limits << 1.0, 3.0;
  const HierarchyData levels{at_most(limits, Vector2d(0.0, 2.7e-9)),
                             equalities(MatrixXd::Ones(1, 1), number(-1.0))};
  EXPECT_GE(optimality_error(1, levels, number(1e-9)), 0.1);
}

TEST(CertificateRounding, ALimitThatAWeakDirectionCouldMeetIsLeft) {
  // In coordinates (a, b, c), turned at random: with a fixed, b = 0 would meet a + 3e-8 b ≤ 0, of
  // which x is 3e-9 beyond; what a longer row of the level does is no reason to doubt it.
  constexpr double kWeak = 3e-8;
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(3);
    const HierarchyData levels{equalities(RowVector3d(1.0, 0.0, 0.0) * R, number(0.0)),
                               joined(at_most(RowVector3d(1.0, kWeak, 0.0) * R, number(0.0)),
                                      equalities(RowVector3d(0.0, 0.0, 10.0) * R, number(0.0))),
                               equalities(RowVector3d(0.0, 1.0, 0.0) * R, number(-1.0))};
    ASSERT_GE(optimality_error(3, levels, R.transpose() * Vector3d(0.0, 0.1, 0.0)), 0.1);
  }
}

TEST(CertificateRounding, LimitsThatRoundingIsBeyondAreLeft) {
  // At a corner of six limits in two of three coordinates x is beyond some of them by rounding.
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(3);
    MatrixXd limits = random.matrix(6, 2);
    limits.col(0) = limits.col(0).cwiseAbs();  // so that one can go back along the first coordinate
    const VectorXd x = random.vector(3);
    const HierarchyData levels{at_most(limits * R.topRows(2), limits * (R.topRows(2) * x)),
                               equalities(R.topRows(1), R.topRows(1) * x - number(1.0))};
    ASSERT_GE(optimality_error(3, levels, x), 0.1);
  }
}

TEST(CertificateRounding, LimitsThatRoundingOfALargeXIsBeyondAreLeft) {
  // Limits, duplicates and combinations of them through common points, and an answer to another
  // order of levels, which is worse.
  int worse = 0;
  for (int seed = 250; seed < 350; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index unknowns = random.integer(2, 6);
    HierarchyData levels = random_levels(random, {.unknowns = unknowns,
                                                  .levels = 4,
                                                  .max_rows = random.integer(2, 8),
                                                  .inequality_share = 0.6,
                                                  .two_sided_share = 0.2,
                                                  .duplicate_share = 0.2,
                                                  .dependent_share = 0.1,
                                                  .tight_share = 0.5,
                                                  .integer_share = 0.5});
    levels.push_back(close_to(3.0 * random.vector(unknowns)));
    for (LevelData& level : levels) {
      level.lower *= 1e3;
      level.upper *= 1e3;
    }
    const std::vector<double> best = residuals(solve<LexicographicSolver>(unknowns, levels));
    for (std::size_t k = 0; k < 3; ++k) {
      HierarchyData swapped = levels;
      std::swap(swapped[k], swapped[k + 1]);
      const VectorXd x = solve<LexicographicSolver>(unknowns, swapped).x;
      const double reached = certify(make_hierarchy(unknowns, levels), x)[k].residual;
      const bool is_worse = reached > best[k] + 1e-4 * (1e3 + best[k]);
      ASSERT_TRUE(!is_worse || optimality_error(unknowns, levels, x) >= 1e-7) << k;
      worse += is_worse ? 1 : 0;
    }
  }
  EXPECT_GE(worse, 50);
}

TEST(CertificateRounding, AnswersWhoseRowsAreMetButForRoundingAreProven) {
  // Found among 20,000 of a kind: without the rounding of the level's own unit in what is added up,
  // these are refused.
  for (const std::uint64_t seed : {1742, 6308, 9969}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(seed);
    const Index unknowns = random.integer(2, 8);
    const HierarchyData levels = degenerate_levels(random, unknowns);
    EXPECT_LE(optimality_error(unknowns, levels, solve<LexicographicSolver>(unknowns, levels).x),
              kProven);
  }
}

TEST(CertificateRounding, ALimitThatOnlyRoundingOfALargeXPullsAtIsLeft) {
  // The second level is met, but for the rounding of x; the third leads away from the limit.
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(3);
    const VectorXd x = 1e6 * random.vector(3);
    const HierarchyData levels{at_most(R.topRows(1), R.topRows(1) * x),
                               equalities(random.matrix(2, 2) * R.topRows(2), VectorXd::Zero(2)),
                               equalities(R.topRows(1), R.topRows(1) * x - number(1e6))};
    HierarchyData met = levels;
    met[1] = equalities(levels[1].A, levels[1].A * x);
    met[1].A.row(1) = met[1].A.row(0);  // so that the limit's coordinate is free
    met[1].upper[1] = met[1].lower[1] = met[1].upper[0];
    ASSERT_GE(optimality_error(3, met, x), 1e-3);
  }
}

TEST(CertificateRounding, ALimitIsHeldToItsOwnSizeHoweverLargeXIs) {
  // A torque of 40 next to accelerations of 5000.
  const HierarchyData levels{at_most(RowVector2d(0.0, 1.0), number(40.0)),
                             equalities(RowVector2d(1.0, 0.0), number(5000.0)),
                             equalities(RowVector2d(0.0, 1.0), number(50.0))};
  EXPECT_LE(optimality_error(2, levels, Vector2d(5000.0, 40.0)), kProven);
  EXPECT_GE(optimality_error(2, levels, Vector2d(5000.0, 40.0 + 2e-6)), 3.0 * kProvenStationarity);
}

TEST(CertificateRounding, ALimitThatOnlyAnErrorOfXPullsAtIsLeft) {
  // a + b = 0 is missed by 1e-10, for which a can make up: b ≤ 0 isn't needed.
  const HierarchyData levels{at_most(RowVector2d(0.0, 1.0), number(0.0)),
                             equalities(RowVector2d(1.0, 1.0), number(0.0)),
                             equalities(RowVector2d(0.0, 1.0), number(-1.0))};
  EXPECT_GE(optimality_error(2, levels, Vector2d(-1e-10, 0.0)), 0.1);
}

TEST(CertificateRounding, ForcesOfNearlyParallelLimitsAreAsLargeAsTheirRoundingIsExcused) {
  // Two limits a ≤ 0 and a ± 1e-5 b ≤ 0 hold what pulls at b, each with 1e5 times as much.
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(2);
    MatrixXd rows(2, 2);
    rows << 1.0, 1e-5, -1.0, 1e-5;
    const HierarchyData levels{at_most(rows * R, Vector2d::Zero()),
                               equalities(RowVector2d(0.3, 1.0) * R, number(1.0))};
    ASSERT_LE(optimality_error(2, levels, Vector2d::Zero()), 1e-9);
  }
}

TEST(CertificateRounding, ForcesOfNearlyParallelEqualitiesAreAsLargeAsTheirRoundingIsExcused) {
  // In coordinates (a, b, c), turned at random: a = 0 and a + 1e-5 b = 0 are fixed. The third level
  // misses b = 1 and has c = 0.
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(3);
    MatrixXd rows(2, 3);
    rows << 1.0, 0.0, 0.0, 1.0, 1e-5, 0.0;
    MatrixXd wishes(2, 3);
    wishes << 0.0, 1.0, 0.0, 0.0, 0.0, 1e-3;
    const HierarchyData levels{equalities(rows * R, Vector2d::Zero()),
                               equalities(wishes * R, Vector2d(1.0, 0.0))};
    ASSERT_LE(optimality_error(3, levels, Vector3d::Zero()), 1e-9);
  }
}

}  // namespace
}  // namespace surefoot::solver
