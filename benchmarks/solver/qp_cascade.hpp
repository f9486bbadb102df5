#pragma once

#include "benchmarks/solver/peer.hpp"

#include <memory>
#include <vector>

namespace surefoot::benchmarks {

/// min ½ yᵀ H y + gᵀ y  subject to  lower ≤ C y ≤ upper, with ±infinity on open sides.
struct Qp {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  Eigen::MatrixXd C;
  Eigen::VectorXd lower, upper;
};

/// A solver of general QPs.
class QpSolver {
 public:
  QpSolver() = default;
  QpSolver(const QpSolver&) = delete;
  QpSolver& operator=(const QpSolver&) = delete;
  virtual ~QpSolver() = default;
  /// False if the solver says that it failed.
  [[nodiscard]] virtual bool solve(const Qp& qp, Eigen::VectorXd& y) = 0;
};

/// The paper's cascade (Eqs. 9–12) over a solver of general QPs, as it is commonly built: level k
/// is
///
///     min ½ ‖A (x + Z z) − b‖² + ½ ‖v‖² + ½ ε ‖z‖²
///     lower ≤ D (x + Z z) − v ≤ upper                  its inequality rows, v of free sign
///     lower − v* ≤ D (x + Z z) ≤ upper + v*            those of the levels before, as solved
///
/// then x ← x + Z z and Z ← Z N(A Z). With `qp_everywhere` every level is a QP, as in the paper;
/// otherwise levels of equalities that no inequality precedes are solved by one complete orthogonal
/// decomposition.
class QpCascade final : public Peer {
 public:
  QpCascade(std::unique_ptr<QpSolver> solver, bool qp_everywhere)
      : solver_(std::move(solver)), qp_everywhere_(qp_everywhere) {}

  static double regularisation;  ///< ε of all cascades

  void prepare(const solver::Hierarchy& problem) override;
  bool solve() override;
  const Eigen::VectorXd& x() const override { return x_; }

 private:
  struct LevelData {
    Eigen::MatrixXd A, D;
    Eigen::VectorXd b, lower, upper;
  };

  bool solve_level(const LevelData& level);
  void form_qp(const LevelData& level, const Eigen::MatrixXd& AZ);
  void keep_rows(const LevelData& level);
  void shrink_null_space(const Eigen::MatrixXd& AZ);

  std::unique_ptr<QpSolver> solver_;
  bool qp_everywhere_;
  std::vector<LevelData> levels_;
  Eigen::VectorXd x_, y_;
  Eigen::MatrixXd Z_;
  Eigen::MatrixXd D_;  // inequality rows of the levels before
  Eigen::VectorXd lower_, upper_;
  Qp qp_;
};

}  // namespace surefoot::benchmarks
