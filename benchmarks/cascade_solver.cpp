// Time of one cold solve of the cascade, on random problems of the shape of Table I and of a COM
// trajectory. Counter Q: the time over that of Eigen's HouseholderQR of a 30 × 30 matrix, measured
// in the same process; it travels between machines.

#include "surefoot/solver/cascade_solver.hpp"

#include "tests/support/random_hierarchy.hpp"

#include <Eigen/QR>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <limits>
#include <vector>

namespace surefoot::test {
namespace {

using Clock = std::chrono::steady_clock;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Seconds of the unit Q: the fastest of many factorizations.
double seconds_of_householder_qr() {
  const MatrixXd A = RandomMatrices(1).matrix(30, 30);
  Eigen::HouseholderQR<MatrixXd> qr(30, 30);
  double fastest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3000; ++i) {
    const auto begin = Clock::now();
    qr.compute(A);
    benchmark::DoNotOptimize(qr.matrixQR().data());
    fastest = std::min(fastest, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return fastest;
}

/// Problems that are solved in turn, each by its own solver.
class Problems {
 public:
  void add(Eigen::Index unknowns, const HierarchyData& levels) {
    hierarchies_.push_back(make_hierarchy(unknowns, levels));
    solvers_.emplace_back(hierarchies_.back());
  }

  void run(benchmark::State& state) {
    static const double q = seconds_of_householder_qr();
    std::size_t next = 0;
    const std::clock_t begin = std::clock();
    for (auto _ : state) {
      benchmark::DoNotOptimize(solvers_[next].solve(hierarchies_[next]).x.data());
      next = (next + 1) % solvers_.size();
    }
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    state.counters["active"] = mean_active();
    state.counters["time_in_Q"] = seconds / static_cast<double>(state.iterations()) / q;
  }

 private:
  [[nodiscard]] double mean_active() const {
    int active = 0;
    for (const solver::CascadeSolver& solver : solvers_) {
      for (const solver::LevelResult& level : solver.solution().levels)
        active += level.num_active();
    }
    return static_cast<double>(active) / static_cast<double>(solvers_.size());
  }

  std::vector<solver::Hierarchy> hierarchies_;
  std::vector<solver::CascadeSolver> solvers_;
};

/// Argument: share of aggression in percent, from few to many active limits.
void BM_TableOne(benchmark::State& state) {
  Problems problems;
  for (int seed = 0; seed < 60; ++seed) {
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const double aggression = static_cast<double>(state.range(0)) / 100.0;
    problems.add(30, table_one_levels(random, 2 + seed % 3, aggression));
  }
  problems.run(state);
}
BENCHMARK(BM_TableOne)->Arg(0)->Arg(50)->Arg(100)->Unit(benchmark::kMicrosecond);

/// Argument: number of unknowns. Limits, then a least-squares level that pushes into them.
void BM_LargeLeastSquares(benchmark::State& state) {
  Problems problems;
  for (int seed = 0; seed < 10; ++seed) {
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    problems.add(state.range(0), least_squares_under_limits(random, state.range(0)));
  }
  problems.run(state);
}
BENCHMARK(BM_LargeLeastSquares)->Arg(20)->Arg(40)->Arg(60)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace surefoot::test

BENCHMARK_MAIN();
