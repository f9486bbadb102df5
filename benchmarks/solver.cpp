// The lexicographic solver against the cascade on the same problems: hierarchies recorded from
// scenarios, in sequence, and generated families, each without a guess. Solvers take turns on every
// problem; each problem counts with its least time. Times are printed in units of Q, the time of
// Eigen's HouseholderQR of a 30 × 30 matrix in the same process.

#include "surefoot/base/error.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/simulation/plant.hpp"
#include "surefoot/simulation/truth_estimator.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace surefoot {
namespace {

constexpr int kPasses = 5;
constexpr double kExact = 1e-6;
using Solve = std::function<const Solution&(const Hierarchy&)>;

template <typename Action>
double microseconds(Action&& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
      .count();
}

double time_of_q() {
  const Eigen::MatrixXd A = test::RandomMatrices(1).matrix(30, 30);
  Eigen::HouseholderQR<Eigen::MatrixXd> qr(30, 30);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3000; ++i) least = std::min(least, microseconds([&] { qr.compute(A); }));
  return least;
}

/// A solver under test. Peers are added in `make_peers`.
struct Peer {
  std::string name;
  std::function<Solve(const Hierarchy& capacity)> make;
};

template <typename Solver, typename Options>
Peer make_peer(const std::string& name, const Options& options) {
  return {name, [options](const Hierarchy& capacity) -> Solve {
            auto solver = std::make_shared<Solver>(capacity, options);
            return [solver](const Hierarchy& h) -> const Solution& { return solver->solve(h); };
          }};
}

std::vector<Peer> make_peers() {
  LexicographicOptions cold;
  cold.warm_start = false;
  return {make_peer<LexicographicSolver>("ours, warm", LexicographicOptions{}),
          make_peer<LexicographicSolver>("ours, cold", cold),
          make_peer<CascadeSolver>("cascade", CascadeOptions{})};
}

/// Every level as good as the cascade's, and certified.
bool is_exact(const Hierarchy& hierarchy, const Solution& solution, const Solution& reference) {
  if (solution.status != SolveStatus::optimal) return false;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const double expected = reference.levels[k].residual;
    if (std::abs(solution.levels[k].residual - expected) > kExact * (1.0 + expected)) return false;
  }
  return worst_stationarity(certify(hierarchy, solution.x)) < kExact;
}

double quantile(std::vector<double> times, double share) {
  std::ranges::sort(times);
  const auto last = static_cast<double>(times.size() - 1);
  return times[static_cast<std::size_t>(std::lround(share * last))];
}

/// In a sequence a solver keeps what it knows from problem to problem; every pass begins anew.
void run(const std::string& name, const std::vector<Hierarchy>& problems, bool is_sequence,
         double q) {
  const std::vector<Peer> peers = make_peers();
  std::vector<std::vector<double>> least(
      peers.size(), std::vector<double>(problems.size(), std::numeric_limits<double>::infinity()));
  std::vector<int> num_exact(peers.size(), 0);
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<Solve> solvers;
    for (const Peer& peer : peers) solvers.push_back(peer.make(problems.front()));
    Hierarchy live = problems.front();
    for (std::size_t i = 0; i < problems.size(); ++i) {
      if (is_sequence) {
        live = problems[i];  // the rows are where a controller has just written them
      } else {
        for (std::size_t p = 0; p < peers.size(); ++p) solvers[p] = peers[p].make(problems[i]);
      }
      const Hierarchy& problem = is_sequence ? live : problems[i];
      const Solution reference = pass == 0 ? CascadeSolver(problem).solve(problem) : Solution{};
      for (std::size_t p = 0; p < peers.size(); ++p) {
        const Solution* solution = nullptr;
        const double time = microseconds([&] { solution = &solvers[p](problem); });
        least[p][i] = std::min(least[p][i], time);
        if (pass == 0 && is_exact(problem, *solution, reference)) ++num_exact[p];
      }
    }
  }
  for (std::size_t p = 0; p < peers.size(); ++p) {
    std::printf("%-24s %-12s %8.3f %8.3f %8.3f Q  %8.2f µs  exact %6.2f %%\n", name.c_str(),
                peers[p].name.c_str(), quantile(least[p], 0.5) / q, quantile(least[p], 0.99) / q,
                quantile(least[p], 1.0) / q, quantile(least[p], 0.5),
                100.0 * num_exact[p] / static_cast<double>(problems.size()));
  }
}

/// The rows that the controller has solved in every tick of a scenario, a part of it.
std::vector<Hierarchy> record(const std::string& name, std::size_t first, std::size_t count) {
  const Scenario scenario = load_scenario({.name_or_path = name, .seed = 0, .assignments = {}});
  Plant plant(scenario.robot, scenario.plant);
  Controller controller(scenario.robot, scenario.controller,
                        std::make_unique<TruthEstimator>(plant.truth()));
  std::vector<Hierarchy> ticks;
  for (std::size_t tick = 0; tick < first + count; ++tick) {
    const SensorReading& reading = plant.read();
    plant.write(controller.step(reading, scenario.user(reading.time)));
    if (tick >= first) ticks.push_back(controller.hierarchy());
  }
  return ticks;
}

using Make = std::function<Hierarchy(test::RandomMatrices& random, int seed)>;

std::vector<Hierarchy> family(const Make& make) {
  std::vector<Hierarchy> problems;
  for (int seed = 0; seed < 200; ++seed) {
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    problems.push_back(make(random, seed));
  }
  return problems;
}

Make table_one(double aggression) {
  return [aggression](test::RandomMatrices& random, int seed) {
    return test::make_hierarchy(30, test::table_one_levels(random, 2 + seed % 3, aggression));
  };
}

/// Torque and force limits that can't all be met.
Hierarchy infeasible(test::RandomMatrices& random, int seed) {
  test::HierarchyData levels = test::table_one_levels(random, 2 + seed % 3, 1.0);
  levels[2].lower *= 0.3;
  levels[2].upper *= 0.3;
  return test::make_hierarchy(30, levels);
}

/// Contacts and friction rows twice, and a level that contradicts the one before.
Hierarchy degenerate(test::RandomMatrices& random, int seed) {
  test::HierarchyData levels = test::table_one_levels(random, 2 + seed % 3, 0.3);
  levels[1] = test::joined(levels[1], levels[1]);
  levels[3] = test::joined(levels[3], levels[3]);
  test::LevelData opposite = levels[4];
  opposite.lower = opposite.upper = -levels[4].upper;
  levels.insert(levels.begin() + 5, opposite);
  return test::make_hierarchy(30, levels);
}

/// What remains of Table I without its first two levels: 12 unknowns and 9 levels.
Hierarchy reduced(test::RandomMatrices& random, int seed) {
  test::HierarchyData levels = test::table_one_levels(random, 2 + seed % 3, 0.3);
  Eigen::MatrixXd fixed(levels[0].A.rows() + levels[1].A.rows(), 30);
  fixed << levels[0].A, levels[1].A;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(fixed.transpose());
  const Eigen::MatrixXd Q = qr.householderQ();
  const Eigen::MatrixXd N = Q.rightCols(12);
  levels.erase(levels.begin(), levels.begin() + 2);
  for (test::LevelData& level : levels) level.A = (level.A * N).eval();
  return test::make_hierarchy(12, levels);
}

void run_all() {
  const double q = time_of_q();
  std::printf("Q = %.2f µs; kernels for %s\n%-24s %-12s %8s %8s %8s\n", q, fastest_kernels().name,
              "problems", "solver", "median", "p99", "max");
  run("walk_flat_sea", record("walk_flat_sea", 1000, 3000), true, q);
  run("step_down", record("step_down", 4000, 3000), true, q);
  run("nominal", family(table_one(0.0)), false, q);
  run("aggressive", family(table_one(1.0)), false, q);
  run("infeasible", family(infeasible), false, q);
  run("degenerate", family(degenerate), false, q);
  run("reduced", family(reduced), false, q);
}

}  // namespace
}  // namespace surefoot

int main() {
  try {
    surefoot::run_all();
    return 0;
  } catch (const surefoot::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
