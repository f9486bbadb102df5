#include "surefoot/base.hpp"
#include "surefoot/solver.hpp"

#include <cmath>
#include <iostream>
#include <limits>

// First x + y = 1, then x ≤ 0.25, then x = 1 as far as that leaves it open: x = 0.25, y = 0.75.
int main() {
  surefoot::solver::Hierarchy hierarchy(2);
  for (const char* name : {"sum", "limit", "wish"}) hierarchy.add_level(name, 1);

  surefoot::solver::Rows sum = hierarchy.level(0).add(1, 0);
  sum.A.row(0) << 1.0, 1.0;
  sum.set_equal(0, 1.0);
  surefoot::solver::Rows limit = hierarchy.level(1).add(1, 0);
  limit.A.row(0) << 1.0, 0.0;
  limit.lower[0] = -std::numeric_limits<double>::infinity();
  limit.upper[0] = 0.25;
  surefoot::solver::Rows wish = hierarchy.level(2).add(1, 0);
  wish.A.row(0) << 1.0, 0.0;
  wish.set_equal(0, 1.0);

  surefoot::solver::LexicographicSolver solver(hierarchy);
  const surefoot::solver::Solution& solution = solver.solve(hierarchy);
  std::cout << "surefoot " << surefoot::build_info().version << ": x = " << solution.x.transpose()
            << ", missed by " << solution.levels[2].residual << '\n';
  const bool right = solution.status == surefoot::solver::SolveStatus::optimal &&
                     (solution.x - Eigen::Vector2d(0.25, 0.75)).norm() < 1e-12 &&
                     std::abs(solution.levels[2].residual - 0.75) < 1e-12;
  return right ? 0 : 1;
}
