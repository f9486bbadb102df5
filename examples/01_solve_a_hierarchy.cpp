// The solver alone: a mass of 2 kg, pushed by at most 10 N, that should accelerate with 8 m/s².
// Unknowns x = (acceleration, force). It gets 5 m/s²; each level says how far it was missed.
#include "surefoot/solver.hpp"

#include <cstdio>

int main() {
  surefoot::solver::Hierarchy hierarchy(2);  // highest priority first
  for (const char* name : {"dynamics", "force limit", "wish"}) hierarchy.add_level(name, 1);
  surefoot::solver::Rows dynamics = hierarchy.level(0).add(1, 0);  // 2 a − f = 0
  dynamics.A << 2.0, -1.0;
  dynamics.set_equal(0, 0.0);
  surefoot::solver::Rows limit = hierarchy.level(1).add(1, 0);  // −10 ≤ f ≤ 10
  limit.A << 0.0, 1.0;
  limit.lower << -10.0;
  limit.upper << 10.0;
  surefoot::solver::Rows wish = hierarchy.level(2).add(1, 0);  // a = 8
  wish.A << 1.0, 0.0;
  wish.set_equal(0, 8.0);

  surefoot::solver::LexicographicSolver solver(hierarchy);
  const surefoot::solver::Solution& solution = solver.solve(hierarchy);
  std::printf("acceleration %.3f m/s², force %.3f N\n", solution.x[0], solution.x[1]);
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const double residual = solution.levels[k].residual;
    std::printf("%-12s missed by %.3f\n", hierarchy.level(k).name().c_str(), residual);
  }
  return solution.x.isApprox(Eigen::Vector2d(5.0, 10.0), 1e-9) ? 0 : 1;
}
