#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <random>
#include <vector>

namespace surefoot::test {

/// Seeded numbers for property tests.
class RandomMatrices {
 public:
  explicit RandomMatrices(std::uint64_t seed) : engine_(seed) {}

  double normal() { return normal_(engine_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns);
  Eigen::VectorXd vector(Eigen::Index size) { return matrix(size, 1); }
  /// Orthogonal, rows × rows.
  Eigen::MatrixXd rotation(Eigen::Index size);

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

/// A level as plain matrices: easy to change, to permute and to print.
struct LevelData {
  Eigen::MatrixXd A;
  Eigen::VectorXd lower, upper;
};
using HierarchyData = std::vector<LevelData>;

/// Levels without rows keep the number of unknowns.
solver::Hierarchy make_hierarchy(Eigen::Index unknowns, const HierarchyData& levels);

LevelData equalities(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
LevelData at_most(const Eigen::MatrixXd& D, const Eigen::VectorXd& f);
LevelData between(const Eigen::MatrixXd& A, const Eigen::VectorXd& lower,
                  const Eigen::VectorXd& upper);
/// Rows of both, in one level.
LevelData joined(const LevelData& first, const LevelData& second);

struct RandomOptions {
  Eigen::Index unknowns = 8;
  int levels = 4;
  int max_rows = 4;               ///< of a level
  double inequality_share = 0.5;  ///< of the rows
  double two_sided_share = 0.3;   ///< of the inequalities
  double duplicate_share = 0.0;   ///< of the rows: a copy of an earlier row, with another bound
  double dependent_share = 0.0;   ///< of the rows: a combination of earlier rows
  double zero_share = 0.0;        ///< of the rows
  double tight_share = 0.0;    ///< of the bounds: through one common point, so vertices are shared
  double integer_share = 0.0;  ///< of the rows: small integers, so that ties are exact
};

HierarchyData random_levels(RandomMatrices& random, const RandomOptions& options);

/// What active-set methods cycle on: small integer rows, duplicates, dependent rows and limits
/// through one point, then a last level that makes x unique.
HierarchyData degenerate_levels(RandomMatrices& random, Eigen::Index unknowns);

/// The shape of Table I of the paper with `feet` down: 30 unknowns, 11 levels. With `aggression` 0
/// few limits are active, with 1 many at several levels.
HierarchyData table_one_levels(RandomMatrices& random, int feet, double aggression);

/// The same with legs that are nearly straight: of each contact's rows a direction is left of 1e-8
/// to 1e-4, or none, that only the base moves. Contacts and force limits stand twice, a level
/// beside its opposite and rows of zeros, and each level is scaled by 1e-6 to 1e6.
HierarchyData straight_legged_levels(RandomMatrices& random, int feet);

/// The shape of a COM trajectory: few equalities, many limits, then more least-squares rows than
/// unknowns, which push into many of the limits. Three levels and x is unique.
HierarchyData least_squares_under_limits(RandomMatrices& random, Eigen::Index unknowns);

}  // namespace surefoot::test
