#include "benchmarks/solver/problems.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/simulation/make_estimator.hpp"
#include "surefoot/simulation/plant.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <Eigen/QR>

#include <fstream>

namespace surefoot::benchmarks {
namespace {

using Eigen::Index;

/// A hierarchy with these rows; ids and names stay.
solver::Hierarchy with_rows(
    const solver::Hierarchy& source, std::size_t first_level, Index unknowns,
    const std::function<void(const solver::Level& from, Index row, solver::Rows& to)>& write) {
  solver::Hierarchy result(unknowns);
  for (std::size_t k = first_level; k < source.num_levels(); ++k) {
    const solver::Level& from = source.level(k);
    const std::size_t added = result.add_level(from.name(), from.max_rows());
    for (Index i = 0; i < from.num_rows(); ++i) {
      solver::Rows to = result.level(added).add(1, from.id(i));
      write(from, i, to);
    }
  }
  return result;
}

/// The rows that a controller with this stack has solved in every tick of a scenario, a part of it.
ProblemSet record(const std::string& scenario_name, const std::string& stack, int first,
                  int count) {
  const config::Scenario scenario = config::load_scenario({scenario_name, 0, {"stack=" + stack}});
  simulation::Plant plant(scenario.robot, scenario.plant);
  control::Controller controller(
      scenario.robot, scenario.controller,
      simulation::make_estimator(scenario.estimation, {scenario.robot, scenario.controller.period,
                                                       plant, scenario.estimator}));
  ProblemSet set{scenario_name + ", " + stack, true, {}};
  for (int tick = 0; tick < first + count; ++tick) {
    const SensorReading& reading = plant.read();
    plant.write(controller.step(reading, scenario.user(reading.time)));
    if (tick >= first) set.problems.push_back(normalised(controller.hierarchy()));
  }
  return set;
}

ProblemSet without_physics(ProblemSet set) {
  for (solver::Hierarchy& problem : set.problems) problem = reduced(problem, 2);
  set.name += ", reduced";
  return set;
}

ProblemSet generate(const std::string& name, int count,
                    const std::function<solver::Hierarchy(unsigned seed)>& make) {
  ProblemSet set{name, false, {}};
  for (int seed = 0; seed < count; ++seed)
    set.problems.push_back(make(static_cast<unsigned>(seed)));
  return set;
}

solver::Hierarchy random_matrices(unsigned seed) {
  test::RandomMatrices random(seed);
  const int feet = 2 + static_cast<int>(seed % 3);
  return normalised(test::make_hierarchy(30, test::table_one_levels(random, feet, 0.5)));
}

void add_generated(std::vector<Family>& result) {
  struct Kind {
    std::string name, about;
    Difficulty difficulty;
  };
  for (const Kind& kind :
       {Kind{"nominal", "Table I near the stance, small references", Difficulty::nominal},
        Kind{"aggressive", "large accelerations, weak motors, little friction",
             Difficulty::aggressive},
        Kind{"infeasible", "limits that contradict each other", Difficulty::infeasible},
        Kind{"degenerate", "straight knees, rows twice, levels that contradict, zero rows",
             Difficulty::degenerate}}) {
    const auto make = [kind](unsigned seed) { return table_one_problem(seed, kind.difficulty); };
    result.push_back({kind.name, kind.about, [kind, make](const Amount& amount) {
                        return generate(kind.name, amount.problems, make);
                      }});
    if (kind.difficulty == Difficulty::degenerate) continue;  // its first levels lose rank
    result.push_back({kind.name + "_reduced", kind.about + "; levels 1 and 2 eliminated",
                      [kind, make](const Amount& amount) {
                        return generate(kind.name + ", reduced", amount.problems,
                                        [&](unsigned seed) { return reduced(make(seed), 2); });
                      }});
  }
}

}  // namespace

solver::Hierarchy normalised(const solver::Hierarchy& hierarchy) {
  return with_rows(hierarchy, 0, hierarchy.unknowns(),
                   [](const solver::Level& from, Index i, solver::Rows& to) {
                     const double norm = from.A().row(i).norm();
                     const double scale = norm > 1e-9 ? 1.0 / norm : 1.0;
                     to.A = scale * from.A().row(i);
                     to.lower[0] = scale * from.lower()[i];
                     to.upper[0] = scale * from.upper()[i];
                   });
}

solver::Hierarchy reduced(const solver::Hierarchy& hierarchy, std::size_t levels) {
  const Index n = hierarchy.unknowns();
  Eigen::MatrixXd A(0, n);
  Eigen::VectorXd b(0);
  for (std::size_t k = 0; k < levels; ++k) {
    const solver::Level& level = hierarchy.level(k);
    A.conservativeResize(A.rows() + level.num_rows(), n);
    b.conservativeResize(A.rows());
    A.bottomRows(level.num_rows()) = level.A();
    b.tail(level.num_rows()) = level.upper();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A.transpose());
  const Eigen::MatrixXd Q = qr.householderQ();
  const Eigen::MatrixXd N = Q.rightCols(n - A.rows());
  const Eigen::VectorXd x0 = A.completeOrthogonalDecomposition().solve(b);
  return normalised(with_rows(
      hierarchy, levels, N.cols(), [&](const solver::Level& from, Index i, solver::Rows& to) {
        const double offset = from.A().row(i).dot(x0);
        to.A = from.A().row(i) * N;
        to.lower[0] = from.lower()[i] - offset;
        to.upper[0] = from.lower()[i] == from.upper()[i] ? to.lower[0] : from.upper()[i] - offset;
      }));
}

ProblemSet read_problems(const std::string& file, bool is_sequence) {
  std::ifstream input(file);
  if (!input) {
    throw FileError(file + ": can't be read; expected a file as `surefoot dump` writes it");
  }
  ProblemSet set{file, is_sequence, {}};
  std::string line;
  for (int number = 1; std::getline(input, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    set.problems.push_back(
        config::parse_hierarchy(line, file + ":" + std::to_string(number)).hierarchy);
  }
  if (set.problems.empty()) throw FileError(file + ": holds no problem; expected one a line");
  return set;
}

std::vector<Family> families() {
  std::vector<Family> result;
  constexpr const char* kStrict = "terrain_adaptation";
  const auto walk = [](const Amount& amount) {
    return record("walk_flat_sea", kStrict, 1000, amount.ticks);
  };
  const auto step = [](const Amount& amount) {
    return record("step_down", kStrict, 4000, amount.ticks);
  };
  const auto weighted = [](const Amount& amount) {
    return record("walk_flat_sea", "walk", 1000, amount.ticks);
  };
  result.push_back({"walk", "consecutive ticks of walk_flat_sea, all levels strict", walk});
  result.push_back({"step_down", "consecutive ticks of step_down, over the edge", step});
  result.push_back({"walk_weighted", "walk_flat_sea, its stack's motion in one level", weighted});
  result.push_back({"walk_reduced", "the same as walk, levels 1 and 2 eliminated: 12 unknowns",
                    [=](const Amount& amount) { return without_physics(walk(amount)); }});
  result.push_back({"step_down_reduced", "the same as step_down, levels 1 and 2 eliminated",
                    [=](const Amount& amount) { return without_physics(step(amount)); }});
  result.push_back({"walk_weighted_reduced", "the same as walk_weighted",
                    [=](const Amount& amount) { return without_physics(weighted(amount)); }});
  add_generated(result);
  result.push_back({"random_matrices", "the shape of Table I, filled with random numbers",
                    [](const Amount& amount) {
                      return generate("random_matrices", amount.problems, random_matrices);
                    }});
  return result;
}

}  // namespace surefoot::benchmarks
