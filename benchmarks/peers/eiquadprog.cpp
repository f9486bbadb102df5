// eiquadprog: the dual method of Goldfarb and Idnani. `eiquadprog-fast` keeps its memory; the plain
// `eiquadprog.hpp` is QuadProg++ in Eigen, the solver family that the paper names.

#include "benchmarks/solver/qp_cascade.hpp"

#include <eiquadprog/eiquadprog-fast.hpp>
#include <eiquadprog/eiquadprog.hpp>

#include <cmath>

namespace surefoot::benchmarks {
namespace {

using Eigen::Index;

/// Both want CI y + ci0 ≥ 0, one-sided.
struct OneSided {
  Eigen::MatrixXd CI;  // rows × unknowns
  Eigen::VectorXd ci0;

  explicit OneSided(const Qp& qp) {
    const Index m = qp.lower.array().isFinite().count() + qp.upper.array().isFinite().count();
    CI.resize(m, qp.H.cols());
    ci0.resize(m);
    Index row = 0;
    for (Index i = 0; i < qp.C.rows(); ++i) {
      if (std::isfinite(qp.lower[i])) {
        CI.row(row) = qp.C.row(i);
        ci0[row++] = -qp.lower[i];
      }
      if (std::isfinite(qp.upper[i])) {
        CI.row(row) = -qp.C.row(i);
        ci0[row++] = qp.upper[i];
      }
    }
  }
};

class Fast final : public QpSolver {
 public:
  bool solve(const Qp& qp, Eigen::VectorXd& y) override {
    const OneSided rows(qp);
    y.setZero(qp.H.cols());
    solver_.reset(static_cast<std::size_t>(qp.H.cols()), 0,
                  static_cast<std::size_t>(rows.ci0.size()));
    const Eigen::MatrixXd CE(0, qp.H.cols());
    return solver_.solve_quadprog(qp.H, qp.g, CE, Eigen::VectorXd(0), rows.CI, rows.ci0, y) ==
           eiquadprog::solvers::EIQUADPROG_FAST_OPTIMAL;
  }

 private:
  eiquadprog::solvers::EiquadprogFast solver_;
};

class Plain final : public QpSolver {
 public:
  bool solve(const Qp& qp, Eigen::VectorXd& y) override {
    const OneSided rows(qp);
    const Index n = qp.H.cols();
    y.setZero(n);
    Eigen::MatrixXd H = qp.H;
    Eigen::VectorXd g = qp.g;
    Eigen::VectorXi active(rows.ci0.size());
    std::size_t num_active = 0;
    const double value =
        eiquadprog::solvers::solve_quadprog(H, g, Eigen::MatrixXd(n, 0), Eigen::VectorXd(0),
                                            rows.CI.transpose(), rows.ci0, y, active, num_active);
    return std::isfinite(value);
  }
};

}  // namespace

void add_eiquadprog(std::vector<PeerKind>& peers) {
  peers.push_back({"eiquadprog-fast cascade", false,
                   [] { return std::make_unique<QpCascade>(std::make_unique<Fast>(), false); }});
  peers.push_back({"QuadProg cascade (paper)", false,
                   [] { return std::make_unique<QpCascade>(std::make_unique<Plain>(), true); }});
}

}  // namespace surefoot::benchmarks
