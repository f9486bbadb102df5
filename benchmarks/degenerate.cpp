// Random degenerate hierarchies: do both solvers always end, and with the right answer? Prints the
// histogram of iterations (of the cascade's active-set method, all levels of a hierarchy together,
// and of the sweeps of the lexicographic solver) and a line for each failure.
//
//     benchmark_degenerate [instances = 1000000] [first seed = 0]
//
// Rows are small integers, duplicates, combinations of others, zero rows, and bounds that all go
// through one point: what active-set methods cycle on. Each instance is solved cold, and by the
// lexicographic solver a second time after a random guess. Exit code 1 if anything failed.

#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "tests/solver/guess.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace surefoot {
namespace {

using test::HierarchyData;
using test::RandomMatrices;
using Histogram = std::map<int, long>;

constexpr double kExact = 1e-9;

int iterations(const solver::Solution& solution) {
  int sum = 0;
  for (const solver::LevelResult& level : solution.levels) sum += level.iterations;
  return sum;
}

class Trial {
 public:
  void run(std::uint64_t seed) {
    RandomMatrices random(seed);
    const Eigen::Index unknowns = random.integer(2, 8);
    const HierarchyData levels = test::degenerate_levels(random, unknowns);
    const solver::Hierarchy hierarchy = test::make_hierarchy(unknowns, levels);
    solver::CascadeSolver cascade(hierarchy);
    solver::LexicographicSolver solver(hierarchy);
    check(seed, "cascade", hierarchy, cascade.solve(hierarchy));
    ++cascade_[iterations(cascade.solution())];
    check(seed, "cold", hierarchy, solver.solve(hierarchy));
    ++cold_[solver.num_sweeps()];
    const auto any_side = [&](std::size_t, Eigen::Index) { return random.integer(-1, 1); };
    (void)solver.solve(test::make_hierarchy(unknowns, test::guess(levels, any_side)));
    check(seed, "random guess", hierarchy, solver.solve(hierarchy));
    ++warm_[solver.num_sweeps()];
    const double distance = (solver.solution().x - cascade.solution().x).norm();
    if (!(distance <= kExact * (1.0 + cascade.solution().x.norm()))) {
      fail(seed, "two answers", distance);
    }
  }

  int print() const {
    print("iterations of the cascade, cold, all levels", cascade_);
    print("sweeps, cold", cold_);
    print("sweeps, after a random guess", warm_);
    std::printf("failures: %ld\n", num_failed_);
    return num_failed_ == 0 ? 0 : 1;
  }

 private:
  void check(std::uint64_t seed, const char* what, const solver::Hierarchy& hierarchy,
             const solver::Solution& solution) {
    if (solution.status != solver::SolveStatus::optimal) return fail(seed, what, -1.0);
    const double distance = solver::worst_stationarity(solver::certify(hierarchy, solution.x));
    if (!(distance <= kExact)) fail(seed, what, distance);
  }

  void fail(std::uint64_t seed, const char* what, double distance) {
    ++num_failed_;
    std::printf("seed %llu: %s: %g\n", static_cast<unsigned long long>(seed), what, distance);
  }

  static void print(const char* title, const Histogram& histogram) {
    std::printf("%s\n", title);
    for (const auto& [count, instances] : histogram) std::printf("%6d %9ld\n", count, instances);
  }

  Histogram cascade_, cold_, warm_;
  long num_failed_ = 0;
};

}  // namespace
}  // namespace surefoot

int main(int argc, char** argv) {
  const long instances = argc > 1 ? std::atol(argv[1]) : 1000000;
  const long first = argc > 2 ? std::atol(argv[2]) : 0;
  surefoot::Trial trial;
  for (long i = 0; i < instances; ++i) trial.run(static_cast<std::uint64_t>(first + i));
  return trial.print();
}
