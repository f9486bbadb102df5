// Two feet at x = ±0.3 m carry 20 kg, whose centre is 0.5 m high and pushed with 60 N along x.
// Which forces x₁ z₁ x₂ z₂ [N] hold it? Friction first, then balance; where more than one answer
// is left the solver gives the smallest.
#include "surefoot/solver.hpp"

#include <cmath>
#include <cstdio>

int main() {
  surefoot::solver::Hierarchy hierarchy(4);
  for (const char* name : {"friction", "balance"}) hierarchy.add_level(name, 4);

  surefoot::solver::Rows friction = hierarchy.level(0).add(4, 0);  // ±x ≤ 0.5 z
  friction.A << 1.0, -0.5, 0.0, 0.0, -1.0, -0.5, 0.0, 0.0,         //
      0.0, 0.0, 1.0, -0.5, 0.0, 0.0, -1.0, -0.5;
  friction.lower.setConstant(-INFINITY);
  friction.upper.setZero();

  surefoot::solver::Rows balance = hierarchy.level(1).add(3, 0);  // of push, weight and moment
  balance.A << 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.5, -0.3, 0.5, 0.3;
  balance.lower = balance.upper = Eigen::Vector3d(-60.0, 20.0 * 9.81, 0.0);

  surefoot::solver::LexicographicSolver solver(hierarchy);
  const Eigen::VectorXd& x = solver.solve(hierarchy).x;
  std::printf("rear (%.1f, %.1f) N, front (%.1f, %.1f) N\n", x[0], x[1], x[2], x[3]);
  return solver.solution().levels[1].residual < 1e-9 ? 0 : 1;
}
