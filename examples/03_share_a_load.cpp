// Two feet at x = ±0.3 m carry a body of 20 kg whose centre is 0.5 m high; a hand pushes it with
// 60 N along x. Which forces (x, z) under the feet hold it? Friction comes first, then balance of
// forces and moment, and of all that balance, the smallest forces. Unknowns: x₁ z₁ x₂ z₂ [N].
#include "surefoot/solver/extra_rows.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"

#include <cstdio>
#include <limits>

int main() {
  constexpr double kFriction = 0.5, kWeight = 20.0 * 9.81, kPush = 60.0;
  surefoot::Hierarchy hierarchy(4);
  hierarchy.add_level("friction", 4);
  hierarchy.add_level("balance", 3);
  hierarchy.add_level("small forces", 4);

  surefoot::Rows friction = hierarchy.level(0).add(4, 0);  // ±x − μ z ≤ 0 for each foot
  friction.A << 1.0, -kFriction, 0.0, 0.0, -1.0, -kFriction, 0.0, 0.0,  //
      0.0, 0.0, 1.0, -kFriction, 0.0, 0.0, -1.0, -kFriction;
  friction.lower.setConstant(-std::numeric_limits<double>::infinity());
  friction.upper.setZero();

  surefoot::Rows balance = hierarchy.level(1).add(3, 0);
  balance.A << 1.0, 0.0, 1.0, 0.0,  // x₁ + x₂ + push = 0 [N]
      0.0, 1.0, 0.0, 1.0,           // z₁ + z₂ = weight [N]
      0.5, -0.3, 0.5, 0.3;          // moment about the centre [N·m]
  balance.set_equal(0, -kPush);
  balance.set_equal(1, kWeight);
  balance.set_equal(2, 0.0);

  surefoot::add_reference(hierarchy.level(2), Eigen::Vector4d::Zero(), 0);

  surefoot::LexicographicSolver solver(hierarchy);
  const surefoot::Solution& solution = solver.solve(hierarchy);
  std::printf("rear foot (%.1f, %.1f) N, front foot (%.1f, %.1f) N\n", solution.x[0], solution.x[1],
              solution.x[2], solution.x[3]);
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    std::printf("%-12s missed by %.3f\n", hierarchy.level(k).name().c_str(),
                solution.levels[k].residual);
  }
  return solution.levels[1].residual < 1e-9 ? 0 : 1;
}
