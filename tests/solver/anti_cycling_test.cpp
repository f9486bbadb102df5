#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace surefoot::solver {
namespace {

LevelData non_negative(Index n) {
  return between(MatrixXd::Identity(n, n), VectorXd::Zero(n), VectorXd::Constant(n, kInfinity));
}

/// A linear programme as a hierarchy: the constraints, then a value of the objective that is out of
/// reach. The residual of the last level is the distance to the optimum.
template <typename Solver>
Solution linear_programme(const LevelData& constraints, const VectorXd& cost, double target) {
  const Index n = cost.size();
  return solve<Solver>(
      n, {joined(constraints, non_negative(n)), equalities(cost.transpose(), number(target))});
}

/// The same with every constraint in a level of its own; where they can all be met, the order of
/// the levels makes no difference.
template <typename Solver>
Solution programme_of_levels(const LevelData& constraints, const VectorXd& cost, double target) {
  const Index n = cost.size();
  const LevelData all = joined(constraints, non_negative(n));
  HierarchyData levels;
  for (Index i = 0; i < all.lower.size(); ++i) {
    levels.push_back(between(all.A.row(i), all.lower.segment(i, 1), all.upper.segment(i, 1)));
  }
  levels.push_back(equalities(cost.transpose(), number(target)));
  return solve<Solver>(n, levels);
}

struct Programme {
  LevelData constraints;
  VectorXd cost;
  double target = 0.0;
};

Programme beale() {
  MatrixXd D(3, 4);
  D << 0.25, -8.0, -1.0, 9.0, 0.5, -12.0, -0.5, 3.0, 0.0, 0.0, 1.0, 0.0;
  return {at_most(D, (VectorXd(3) << 0.0, 0.0, 1.0).finished()),
          (VectorXd(4) << -0.75, 20.0, -0.5, 6.0).finished(), -10.0};
}

Programme marshall_and_suurballe() {
  MatrixXd D(3, 4);
  D << 0.5, -5.5, -2.5, 9.0, 0.5, -1.5, -0.5, 1.0, 1.0, 0.0, 0.0, 0.0;
  return {at_most(D, (VectorXd(3) << 0.0, 0.0, 1.0).finished()),
          (VectorXd(4) << -10.0, 57.0, 9.0, 24.0).finished(), -10.0};
}

Programme klee_and_minty(Index n) {
  MatrixXd D = MatrixXd::Identity(n, n);
  VectorXd f(n), cost(n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j) D(i, j) = std::pow(2.0, static_cast<double>(i - j + 1));
    f[i] = std::pow(5.0, static_cast<double>(i + 1));
    cost[i] = std::pow(2.0, static_cast<double>(n - 1 - i));
  }
  return {at_most(D, f), cost, 2.0 * f[n - 1]};
}

template <typename Solver>
class AntiCycling : public testing::Test {};
TYPED_TEST_SUITE(AntiCycling, Solvers);

template <typename Solver>
void expect_missed_by(const Programme& programme, double expected) {
  const auto& [constraints, cost, target] = programme;
  const Solution together = linear_programme<Solver>(constraints, cost, target);
  const Solution row_by_row = programme_of_levels<Solver>(constraints, cost, target);
  for (const Solution& solution : {together, row_by_row}) {
    EXPECT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_NEAR(solution.levels.back().residual, expected, 1e-9 * expected);
  }
}

TYPED_TEST(AntiCycling, BealesExampleReachesItsOptimum) {
  expect_missed_by<TypeParam>(beale(), 10.0 - 1.25);
}

TYPED_TEST(AntiCycling, MarshallAndSuurballesExampleReachesItsOptimum) {
  expect_missed_by<TypeParam>(marshall_and_suurballe(), 10.0 - 1.0);
}

TYPED_TEST(AntiCycling, KleeAndMintysCubesReachTheirOptimum) {
  for (Index n = 2; n <= 6; ++n) {
    SCOPED_TRACE(n);
    expect_missed_by<TypeParam>(klee_and_minty(n), std::pow(5.0, static_cast<double>(n)));
  }
}

TYPED_TEST(AntiCycling, ManyRowsThroughOnePointEndWithinTheCap) {
  int most_iterations = 0;
  for (SeededRandom& random : Seeds(3000)) {
    const Index n = random.integer(2, 8);
    HierarchyData levels = random_levels(random, {.unknowns = n,
                                                  .levels = 4,
                                                  .max_rows = 20,
                                                  .inequality_share = 1.0,
                                                  .two_sided_share = 0.0,
                                                  .tight_share = 1.0,
                                                  .integer_share = 1.0});
    levels.push_back(close_to(3.0 * random.vector(n)));
    const Solution solution = solve<TypeParam>(n, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(n, levels, solution.x), 1e-9);
    for (const LevelResult& level : solution.levels) {
      most_iterations = std::max(most_iterations, level.iterations);
    }
  }
  EXPECT_LE(most_iterations, 150);
}

TYPED_TEST(AntiCycling, AllPyramidsAtTheirApexLetEveryWishedForceBeProjected) {
  constexpr Index kFeet = 4;
  MatrixXd pyramid(5, 3);
  pyramid << 1, 0, -0.5, -1, 0, -0.5, 0, 1, -0.5, 0, -1, -0.5, 0, 0, -1;
  MatrixXd all = MatrixXd::Zero(5 * kFeet, 3 * kFeet);
  for (Index foot = 0; foot < kFeet; ++foot) all.block(5 * foot, 3 * foot, 5, 3) = pyramid;
  const LevelData cones = at_most(all, VectorXd::Zero(5 * kFeet));
  for (SeededRandom& random : Seeds(500)) {
    // Sums of forces and moments first, then the forces themselves.
    const LevelData sums = equalities(random.matrix(6, 3 * kFeet), random.vector(6));
    const HierarchyData levels{cones, sums, close_to(random.vector(3 * kFeet))};
    const Solution solution = solve<TypeParam>(3 * kFeet, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(3 * kFeet, levels, solution.x), 1e-9);
  }
}

/// The guess comes from the same cones with another wish, from none, and from the opposite wish.
TEST(AntiCycling, StaleGuessesAtAnApexGiveTheSameX) {
  MatrixXd pyramid(5, 3);
  pyramid << 1, 0, -0.5, -1, 0, -0.5, 0, 1, -0.5, 0, -1, -0.5, 0, 0, -1;
  const LevelData cone = at_most(pyramid, VectorXd::Zero(5));
  RandomMatrices random(8);
  LexicographicSolver warm(make_hierarchy(3, {cone, close_to(VectorXd::Zero(3))}));
  for (int tick = 0; tick < 500; ++tick) {
    const VectorXd wish = random.vector(3);
    for (const double sign : {1.0, -1.0, 0.0}) {
      const Hierarchy hierarchy = make_hierarchy(3, {cone, close_to(sign * wish)});
      const VectorXd expected = CascadeSolver(hierarchy).solve(hierarchy).x;
      ASSERT_EQ(warm.solve(hierarchy).status, SolveStatus::optimal);
      ASSERT_LE((warm.solution().x - expected).norm(), 1e-9) << "tick " << tick;
    }
  }
}

/// All instances again, in a loop that never forgets: the guess is that of another instance.
TEST(AntiCycling, GuessesOfOtherDegenerateHierarchiesGiveTheSameX) {
  Hierarchy capacity(6);
  for (int k = 0; k < 5; ++k) capacity.add_level("", 12);
  LexicographicSolver warm(capacity), again(capacity);
  for (SeededRandom& random : Seeds(1000)) {
    HierarchyData levels = random_levels(random, {.unknowns = 6,
                                                  .levels = 4,
                                                  .max_rows = 12,
                                                  .inequality_share = 0.9,
                                                  .duplicate_share = 0.2,
                                                  .tight_share = 1.0,
                                                  .integer_share = 1.0});
    levels.push_back(close_to(3.0 * random.vector(6)));
    const Hierarchy hierarchy = make_hierarchy(6, levels);
    const VectorXd expected = CascadeSolver(hierarchy).solve(hierarchy).x;
    ASSERT_EQ(warm.solve(hierarchy).status, SolveStatus::optimal);
    ASSERT_LE((warm.solution().x - expected).norm(), 1e-9 * (1.0 + expected.norm()));
    ASSERT_EQ(again.solve(hierarchy).x, warm.solution().x) << "the same calls, the same bits";
  }
}

/// Three equalities in one unknown whose least-squares optimum is 0, the limit a x ≤ 0 in the same
/// level, and a wish for 5 below: of all small integers, how many are not answered by 0.
template <typename Solver>
int unanswered_on_a_limit() {
  int unanswered = 0;
  Hierarchy hierarchy(1);
  hierarchy.add_level("limit", 4);
  hierarchy.add_level("wish", 1);
  Solver solver(hierarchy);
  for (int code = 0; code < 7 * 7 * 7 * 7 * 7 * 7; ++code) {
    std::array<int, 6> digits{};  // coefficients and values, −3 … 3
    for (int rest = code; int& digit : digits) {
      digit = rest % 7 - 3;
      rest /= 7;
    }
    const auto [a, b, c, value_a, value_b, value_c] = digits;
    const bool is_one = a != 0 && a <= b && b <= c && b != 0 && c != 0;
    if (!is_one || a * value_a + b * value_b + c * value_c != 0) continue;
    hierarchy.level(0).clear();
    hierarchy.level(1).clear();
    Rows rows = hierarchy.level(0).add(4, 0);
    rows.A << a, b, c, 1.0;
    rows.lower << value_a, value_b, value_c, -kInfinity;
    rows.upper << value_a, value_b, value_c, 0.0;
    Rows wish = hierarchy.level(1).add(1, 0);
    wish.A(0, 0) = 1.0;
    wish.set_equal(0, 5.0);
    const Solution& solution = solver.solve(hierarchy);
    const bool is_answered =
        solution.status == SolveStatus::optimal && std::abs(solution.x[0]) < 1e-12;
    unanswered += is_answered ? 0 : 1;
  }
  return unanswered;
}

TEST(AntiCycling, AnOptimumOfContradictionsOnALimitOfTheirOwnLevelIsNoCycle) {
  EXPECT_EQ(unanswered_on_a_limit<LexicographicSolver>(), 0);
  EXPECT_EQ(unanswered_on_a_limit<CascadeSolver>(), 0);
}

}  // namespace
}  // namespace surefoot::solver
