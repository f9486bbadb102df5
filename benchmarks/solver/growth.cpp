#include "benchmarks/solver/growth.hpp"

#include "benchmarks/solver/measure.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

namespace surefoot::benchmarks {
namespace {

using Eigen::Index;
using Json = nlohmann::ordered_json;
using test::RandomMatrices;

/// A stack that is like Table I but of any size: dynamics first, then limits and wishes in turn.
struct Shape {
  Index unknowns = 30;
  int levels = 11;
  Index rows = 72;
  double push = 1.0;  ///< how far the wishes lie beyond the limits; more make more rows active
};

double microseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
      .count();
}

/// A slowly moving problem: right-hand sides turn with the tick.
solver::Hierarchy make(const Shape& shape, unsigned seed, int tick) {
  RandomMatrices random(seed);
  test::HierarchyData levels;
  const Index n = shape.unknowns;
  Index left = shape.rows;
  for (int k = 0; k < shape.levels; ++k) {
    const Index rows = std::max<Index>(1, left / (shape.levels - k));
    left -= rows;
    const Eigen::MatrixXd A = random.matrix(rows, n) / std::sqrt(static_cast<double>(n));
    const Eigen::VectorXd b = random.vector(rows), turn = random.vector(rows);
    const Eigen::VectorXd now = b + 0.02 * std::sin(0.05 * tick) * turn;
    if (k % 3 == 1) {
      const Eigen::VectorXd width = Eigen::VectorXd::Constant(rows, 1.0);
      levels.push_back(test::between(A, -width, width));
    } else {
      levels.push_back(test::equalities(A, shape.push * now));
    }
  }
  return test::make_hierarchy(n, levels);
}

double operations(const Shape& shape) {
  double sum = 0.0;
  for (Index i = 0; i < std::min(shape.unknowns, shape.rows); ++i) {
    sum += 4.0 * static_cast<double>(shape.rows * (shape.unknowns - i));
  }
  return sum;
}

/// Operations in a microsecond of Eigen's matrix product.
double product_speed() {
  constexpr Index kSize = 96;
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(kSize, kSize);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(kSize, kSize);
  Eigen::MatrixXd C(kSize, kSize);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    C.noalias() = A * B;
    least = std::min(least, microseconds_since(begin));
  }
  return 2.0 * kSize * kSize * kSize / least;
}

struct Timing {
  double warm = 0.0, warm_max = 0.0, cold = 0.0, active = 0.0;
};

double least_time(solver::LexicographicSolver& solver, const solver::Hierarchy& problem) {
  const auto begin = std::chrono::steady_clock::now();
  (void)solver.solve(problem);
  return microseconds_since(begin);
}

Timing time(const Shape& shape, int passes) {
  constexpr int kSeeds = 5, kTicks = 40;
  solver::LexicographicOptions without_guess;
  without_guess.warm_start = false;
  std::vector<double> warm, cold;
  double active = 0.0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::vector<solver::Hierarchy> ticks;
    for (int tick = 0; tick < kTicks; ++tick) ticks.push_back(make(shape, seed, tick));
    std::vector<double> least_warm(kTicks, 1e300), least_cold(kTicks, 1e300);
    for (int pass = 0; pass < passes; ++pass) {
      solver::LexicographicSolver guessing(ticks[0]), starting(ticks[0], without_guess);
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        least_warm[i] = std::min(least_warm[i], least_time(guessing, ticks[i]));
        least_cold[i] = std::min(least_cold[i], least_time(starting, ticks[i]));
      }
      if (pass > 0) continue;
      for (const solver::LevelResult& level : guessing.solution().levels)
        active += level.num_active();
    }
    warm.insert(warm.end(), least_warm.begin() + 1, least_warm.end());  // the first had no guess
    cold.insert(cold.end(), least_cold.begin(), least_cold.end());
  }
  return {quantile(warm, 0.5), quantile(warm, 1.0), quantile(cold, 0.5), active / kSeeds};
}

class Growth {
 public:
  explicit Growth(int passes) : passes_(passes), speed_(product_speed()) {}

  void point(const char* against, double value, const Shape& shape) {
    const Timing timing = time(shape, passes_);
    const double bound = operations(shape) / speed_;
    std::printf(
        "%-10s %6g   n %3ld  levels %2d  rows %3ld  active %5.1f   warm %8.2f (max %8.2f)"
        "   cold %8.2f   bound %7.2f us\n",
        against, value, static_cast<long>(shape.unknowns), shape.levels,
        static_cast<long>(shape.rows), timing.active, timing.warm, timing.warm_max, timing.cold,
        bound);
    std::fflush(stdout);
    points_.push_back({{"against", against},
                       {"value", std::string(against) == "active" ? timing.active : value},
                       {"unknowns", shape.unknowns},
                       {"levels", shape.levels},
                       {"rows", shape.rows},
                       {"active", timing.active},
                       {"warm_us", timing.warm},
                       {"warm_max_us", timing.warm_max},
                       {"cold_us", timing.cold},
                       {"operations", operations(shape)},
                       {"bound_us", bound}});
  }

  [[nodiscard]] Json points() && { return std::move(points_); }

 private:
  int passes_;
  double speed_;
  Json points_ = Json::array();
};

}  // namespace

Json measure_growth(int passes) {
  Growth growth(passes);
  for (const Index n : {12, 18, 24, 30, 42, 60, 90, 120}) {
    growth.point("unknowns", static_cast<double>(n), {.unknowns = n, .rows = 12 * n / 5});
  }
  for (const int levels : {1, 2, 4, 6, 8, 11, 14, 17, 20}) {
    growth.point("levels", levels, {.levels = levels});
  }
  for (const Index rows : {24, 36, 48, 72, 108, 144, 216}) {
    growth.point("rows", static_cast<double>(rows), {.rows = rows});
  }
  for (const double push : {0.1, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0}) {
    growth.point("active", push, {.push = push});
  }
  for (const Index n : {60, 75, 90}) {
    growth.point("humanoid", static_cast<double>(n),
                 {.unknowns = n, .levels = 10, .rows = 2 * n, .push = 0.7});
  }
  return std::move(growth).points();
}

}  // namespace surefoot::benchmarks
