#include "surefoot/solver/sweep.hpp"
#include "surefoot/solver/sweep_memory.hpp"
#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Sweeps over equalities with kernels of one's choice.
class EqualitySweep {
 public:
  EqualitySweep(const Hierarchy& hierarchy, const SweepKernels& kernels)
      : memory_(hierarchy), kernels_(kernels) {
    load(hierarchy);
  }

  /// Levels before `first` are swept and done with, then the others in what is left free.
  void run(int first) {
    Sweep& s = memory_.sweep;
    sweep(0, first);
    if (s.fixed > 0) kernels_.reduce(s);
    sweep(first, s.num_levels);
    kernels_.recover(s);
    kernels_.evaluate(s, 0, s.num_rows);
  }

  [[nodiscard]] VectorXd x() const { return copy(memory_.sweep.x, memory_.sweep.unknowns); }
  [[nodiscard]] VectorXd values() const {
    return copy(memory_.sweep.value, memory_.sweep.num_rows);
  }
  [[nodiscard]] VectorXd lengths() const {
    return copy(memory_.sweep.scale, memory_.sweep.num_rows);
  }
  /// Multipliers with which the rows of the levels before balance the gradient of the last level.
  [[nodiscard]] VectorXd forces() {
    Sweep& s = memory_.sweep;
    std::fill_n(s.force, s.num_rows, 0.0);
    kernels_.balance(s, s.num_levels - 1, 0);
    return copy(s.force, s.num_rows);
  }

 private:
  static VectorXd copy(const double* begin, int count) {
    return Eigen::Map<const VectorXd>(begin, count);
  }

  void load(const Hierarchy& hierarchy) {
    Sweep& s = memory_.sweep;
    s.unknowns = static_cast<int>(hierarchy.unknowns());
    s.num_levels = static_cast<int>(hierarchy.num_levels());
    s.num_rows = 0;
    for (int k = 0; k < s.num_levels; ++k) {
      const Level& level = hierarchy.level(static_cast<std::size_t>(k));
      s.level_begin[k] = s.num_rows;
      for (Index i = 0; i < level.num_rows(); ++i, ++s.num_rows) {
        s.a[s.num_rows] = level.A().row(i).data();
        s.lower[s.num_rows] = s.upper[s.num_rows] = level.upper()[i];
        s.side[s.num_rows] = 2;
      }
    }
    s.level_begin[s.num_levels] = s.num_rows;
    s.columns = s.unknowns;
    s.stride = (s.unknowns + kernels_.pack - 1) / kernels_.pack * kernels_.pack;
    s.fixed = 0;
    s.solve_tolerance = RankTolerance{}.solve;
    s.keep_tolerance = RankTolerance{}.keep;
    s.smallest_pivot = 1.0;
    kernels_.measure(s);
  }

  void sweep(int first, int end) {
    Sweep& s = memory_.sweep;
    for (int row = s.level_begin[first]; row < s.level_begin[end]; ++row) kernels_.project(s, row);
    kernels_.start(s, first, end);
    kernels_.run(s, first, end);
  }

  SweepMemory memory_;
  const SweepKernels& kernels_;
};

HierarchyData random_equalities(RandomMatrices& random, Index unknowns, Index max_rows) {
  HierarchyData levels;
  for (int k = 0; k < 4; ++k) {
    const Index rows = random.integer(1, static_cast<int>(max_rows));
    levels.push_back(equalities(random.matrix(rows, unknowns), random.vector(rows)));
  }
  levels.push_back(close_to(random.vector(unknowns)));
  return levels;
}

TEST(SweepKernels, TheFastestOfAllAreThoseThatAreUsed) {
  const std::vector<const SweepKernels*> all = all_kernels();
  ASSERT_GE(all.size(), 1u);
  EXPECT_EQ(all.back(), &fastest_kernels());
}

TEST(SweepKernels, AllInstructionSetsGiveTheSameAnswer) {
  const std::vector<const SweepKernels*> all = all_kernels();
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index n = random.integer(1, 40);
    const Hierarchy hierarchy = make_hierarchy(n, random_equalities(random, n, 12));
    const VectorXd expected = CascadeSolver(hierarchy).solve(hierarchy).x;
    const int first = random.integer(0, 2);
    EqualitySweep reference(hierarchy, *all.front());
    reference.run(first);
    for (const SweepKernels* kernels : all) {
      SCOPED_TRACE(kernels->name);
      EqualitySweep sweep(hierarchy, *kernels);
      sweep.run(first);
      const double size = static_cast<double>(n) * (1.0 + expected.norm());
      ASSERT_LE((sweep.x() - expected).norm(), 1e-9 * size);
      ASSERT_LE((sweep.values() - reference.values()).norm(), 1e-9 * size);
      ASSERT_LE((sweep.lengths() - reference.lengths()).norm(), 1e-12 * size);
      const VectorXd forces = reference.forces();
      ASSERT_LE((sweep.forces() - forces).norm(), 1e-9 * (1.0 + forces.norm()));
    }
  }
}

TEST(SweepKernels, AllInstructionSetsSeeNumbersThatAreNone) {
  for (const SweepKernels* kernels : all_kernels()) {
    SCOPED_TRACE(kernels->name);
    for (Index column = 0; column < 11; ++column) {
      HierarchyData levels{equalities(Eigen::MatrixXd::Ones(1, 11), VectorXd::Ones(1))};
      levels[0].A(0, column) = std::numeric_limits<double>::quiet_NaN();
      const Hierarchy hierarchy = make_hierarchy(11, levels);
      ASSERT_FALSE(std::isfinite(EqualitySweep(hierarchy, *kernels).lengths()[0])) << column;
    }
  }
}

}  // namespace
}  // namespace surefoot::test
