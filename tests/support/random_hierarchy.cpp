#include "tests/support/random_hierarchy.hpp"

#include "surefoot/math/numbers.hpp"

#include <Eigen/QR>

#include <cmath>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd constant(Index size, double value) { return VectorXd::Constant(size, value); }

VectorXd random_row(RandomMatrices& random, const RandomOptions& options, const MatrixXd& earlier) {
  const Index n = options.unknowns;
  if (random.chance(options.zero_share)) return VectorXd::Zero(n);
  if (earlier.rows() > 0 && random.chance(options.duplicate_share)) {
    return earlier.row(random.integer(0, static_cast<int>(earlier.rows()) - 1)).transpose();
  }
  if (earlier.rows() > 0 && random.chance(options.dependent_share)) {
    return earlier.transpose() * random.vector(earlier.rows());
  }
  if (random.chance(options.integer_share)) {
    VectorXd row(n);
    for (Index i = 0; i < n; ++i) row[i] = random.integer(-2, 2);
    return row;
  }
  return random.vector(n);
}

}  // namespace

MatrixXd RandomMatrices::matrix(Index rows, Index columns) {
  MatrixXd M(rows, columns);
  for (Index j = 0; j < columns; ++j) {
    for (Index i = 0; i < rows; ++i) M(i, j) = normal();
  }
  return M;
}

MatrixXd RandomMatrices::rotation(Index size) {
  return Eigen::HouseholderQR<MatrixXd>(matrix(size, size)).householderQ();
}

solver::Hierarchy make_hierarchy(Index unknowns, const HierarchyData& levels) {
  solver::Hierarchy hierarchy(unknowns);
  int id = 0;
  for (const LevelData& data : levels) {
    const std::size_t k = hierarchy.add_level("level", data.lower.size());
    solver::Rows rows = hierarchy.level(k).add(data.lower.size(), id);
    if (data.lower.size() > 0) rows.A = data.A;
    rows.lower = data.lower;
    rows.upper = data.upper;
    id += static_cast<int>(data.lower.size());
  }
  return hierarchy;
}

LevelData equalities(const MatrixXd& A, const VectorXd& b) { return {A, b, b}; }

LevelData at_most(const MatrixXd& D, const VectorXd& f) {
  return {D, constant(f.size(), -kInfinity), f};
}

LevelData between(const MatrixXd& A, const VectorXd& lower, const VectorXd& upper) {
  return {A, lower, upper};
}

LevelData joined(const LevelData& first, const LevelData& second) {
  const Index m1 = first.lower.size();
  const Index m2 = second.lower.size();
  if (m1 == 0) return second;
  if (m2 == 0) return first;
  LevelData both{MatrixXd(m1 + m2, first.A.cols()), VectorXd(m1 + m2), VectorXd(m1 + m2)};
  both.A << first.A, second.A;
  both.lower << first.lower, second.lower;
  both.upper << first.upper, second.upper;
  return both;
}

HierarchyData random_levels(RandomMatrices& random, const RandomOptions& options) {
  HierarchyData levels;
  MatrixXd earlier(0, options.unknowns);
  const VectorXd common = random.vector(options.unknowns).array().round();
  for (int k = 0; k < options.levels; ++k) {
    const Index rows = random.integer(0, options.max_rows);
    LevelData level{MatrixXd(rows, options.unknowns), VectorXd(rows), VectorXd(rows)};
    for (Index i = 0; i < rows; ++i) {
      const VectorXd row = random_row(random, options, earlier);
      level.A.row(i) = row.transpose();
      earlier.conservativeResize(earlier.rows() + 1, Eigen::NoChange);
      earlier.bottomRows(1) = row.transpose();
      const double bound =
          random.chance(options.tight_share) ? row.dot(common) : 2.0 * random.normal();
      level.lower[i] = level.upper[i] = bound;
      if (!random.chance(options.inequality_share)) continue;
      if (random.chance(options.two_sided_share)) {
        level.lower[i] = bound - random.uniform(0.0, 2.0);
      } else if (random.chance(0.5)) {
        level.lower[i] = -kInfinity;
      } else {
        level.upper[i] = kInfinity;
      }
    }
    levels.push_back(level);
  }
  return levels;
}

HierarchyData table_one_levels(RandomMatrices& random, int feet, double aggression) {
  constexpr Index kAccelerations = 18;
  constexpr Index kTorques = 12;
  constexpr Index kUnknowns = kAccelerations + kTorques;
  const Index nc = feet;
  const auto motion_rows = [&](Index rows) {
    MatrixXd A = MatrixXd::Zero(rows, kUnknowns);
    A.leftCols(kAccelerations) = random.matrix(rows, kAccelerations) / std::sqrt(18.0);
    return A;
  };
  const double a = 1.0 + 8.0 * aggression;
  HierarchyData levels;
  // Equations of motion without contact forces, then no contact motion.
  const MatrixXd dynamics = random.matrix(18 - 3 * nc, kUnknowns) / std::sqrt(30.0);
  levels.push_back(equalities(dynamics, random.vector(18 - 3 * nc)));
  const MatrixXd contact = motion_rows(3 * nc);
  levels.push_back(equalities(contact, 0.3 * random.vector(3 * nc)));
  // Torque limits.
  MatrixXd torque = MatrixXd::Zero(kTorques, kUnknowns);
  torque.rightCols(kTorques).setIdentity();
  const double limit = 6.0 - 4.5 * aggression;
  levels.push_back(between(torque, constant(kTorques, -limit), constant(kTorques, limit)));
  // Contact forces λ = F x + λ₀: friction pyramids and normal-force bounds.
  const MatrixXd force = random.matrix(3 * nc, kUnknowns) / std::sqrt(30.0);
  VectorXd force0 = 0.3 * random.vector(3 * nc);
  MatrixXd friction(5 * nc, kUnknowns);
  VectorXd lower(5 * nc), upper(5 * nc);
  const double mu = 0.7 - 0.3 * aggression;
  for (Index foot = 0; foot < nc; ++foot) {
    force0[3 * foot + 2] += 3.0;
    for (Index side = 0; side < 5; ++side) {
      Eigen::RowVector3d pyramid(0.0, 0.0, side == 4 ? 1.0 : -mu);
      if (side < 4) pyramid[side / 2] = side % 2 == 0 ? 1.0 : -1.0;
      const Index row = 5 * foot + side;
      friction.row(row) = pyramid * force.middleRows(3 * foot, 3);
      const double constant_part = pyramid.dot(force0.segment(3 * foot, 3));
      lower[row] = side == 4 ? 0.2 + 2.0 * aggression - constant_part : -kInfinity;
      upper[row] = side == 4 ? 8.0 - constant_part : -constant_part;
    }
  }
  levels.push_back(between(friction, lower, upper));
  levels.push_back(equalities(motion_rows(2), a * 0.5 * random.vector(2)));
  const Index swing = 3 * (4 - nc);
  levels.push_back(equalities(motion_rows(swing), a * 0.5 * random.vector(swing)));
  // Limb limits, then yaw, height, roll and pitch, force minimisation.
  const MatrixXd limbs = motion_rows(4);
  const VectorXd centre = 0.5 * aggression * random.vector(4);
  levels.push_back(
      between(limbs, centre.array() - 1.5 + aggression, centre.array() + 1.5 - aggression));
  levels.push_back(equalities(motion_rows(1), a * 0.5 * random.vector(1)));
  levels.push_back(equalities(motion_rows(1), a * 0.5 * random.vector(1)));
  levels.push_back(equalities(motion_rows(2), a * 0.5 * random.vector(2)));
  levels.push_back(equalities(force, -force0));
  return levels;
}

namespace {

constexpr Index kBase = 6, kLeg = 3, kAll = 30;

/// Rows of a foot: those of a rigid base, and its own leg, which reaches up and down by `weak`
/// only.
MatrixXd foot_rows(RandomMatrices& random, Index foot, double weak) {
  MatrixXd rows = MatrixXd::Zero(kLeg, kAll);
  const double x = foot % 2 == 0 ? 0.3 : -0.3, y = foot < 2 ? 0.2 : -0.2, z = -0.5;
  rows.leftCols(kBase) << 1, 0, 0, 0, z, -y, 0, 1, 0, -z, 0, x, 0, 0, 1, y, -x, 0;
  MatrixXd leg = random.matrix(kLeg, kLeg);
  leg.row(2) *= weak;
  rows.middleCols(kBase + kLeg * foot, kLeg) = leg;
  return rows;
}

LevelData twice(const LevelData& level) { return joined(level, level); }

LevelData opposite(const LevelData& level) { return {-level.A, -level.upper, -level.lower}; }

/// Unknowns of the base alone, one a row.
LevelData base_level(RandomMatrices& random, std::initializer_list<Index> unknowns) {
  MatrixXd A = MatrixXd::Zero(static_cast<Index>(unknowns.size()), kAll);
  Index row = 0;
  for (const Index unknown : unknowns) A(row++, unknown) = 1.0;
  return equalities(A, random.vector(row));
}

/// With rows of zeros, of which one asks for what can't be had.
LevelData with_zeros(const LevelData& level, double impossible) {
  return joined(level, equalities(MatrixXd::Zero(2, kAll), Eigen::Vector2d(0.0, impossible)));
}

}  // namespace

HierarchyData straight_legged_levels(RandomMatrices& random, int feet) {
  HierarchyData levels = table_one_levels(random, feet, random.uniform(0.0, 0.6));
  const double usual = random.chance(0.2) ? 0.0 : std::pow(10.0, random.uniform(-8.0, -4.0));
  MatrixXd contacts(0, kAll), swings(0, kAll);
  for (Index foot = 0; foot < 4; ++foot) {
    MatrixXd& rows = foot < feet ? contacts : swings;
    rows.conservativeResize(rows.rows() + kLeg, Eigen::NoChange);
    rows.bottomRows(kLeg) = foot_rows(random, foot, usual * random.uniform(-1.0, 1.0));
  }
  levels[1] = twice(equalities(contacts, 0.3 * random.vector(contacts.rows())));
  levels[3] = twice(levels[3]);
  levels[5] = with_zeros(equalities(swings, random.vector(swings.rows())), random.integer(0, 1));
  levels[7] = base_level(random, {5});
  levels[8] = base_level(random, {2});
  levels[9] = base_level(random, {3, 4});
  levels.insert(levels.begin() + 5, opposite(levels[4]));
  for (LevelData& level : levels) {
    const double factor = std::pow(10.0, random.uniform(-6.0, 6.0));
    level = {factor * level.A, factor * level.lower, factor * level.upper};
  }
  return levels;
}

HierarchyData degenerate_levels(RandomMatrices& random, Index unknowns) {
  HierarchyData levels = random_levels(random, {.unknowns = unknowns,
                                                .levels = random.integer(2, 5),
                                                .max_rows = random.integer(2, 12),
                                                .inequality_share = random.uniform(0.5, 1.0),
                                                .two_sided_share = 0.2,
                                                .duplicate_share = 0.2,
                                                .dependent_share = 0.1,
                                                .zero_share = 0.03,
                                                .tight_share = random.uniform(0.5, 1.0),
                                                .integer_share = random.uniform(0.5, 1.0)});
  levels.push_back(
      equalities(MatrixXd::Identity(unknowns, unknowns), 3.0 * random.vector(unknowns)));
  return levels;
}

HierarchyData least_squares_under_limits(RandomMatrices& random, Index unknowns) {
  const VectorXd inside = random.vector(unknowns);
  const MatrixXd equal = random.matrix(unknowns / 5, unknowns);
  const MatrixXd limits = random.matrix(3 * unknowns, unknowns);
  VectorXd bounds = limits * inside;
  for (double& bound : bounds) bound += random.uniform(0.0, 2.0);
  const MatrixXd task = random.matrix(unknowns + 10, unknowns);
  return {equalities(equal, equal * inside), at_most(limits, bounds),
          equalities(task, 3.0 * random.vector(unknowns + 10))};
}

}  // namespace surefoot::test
