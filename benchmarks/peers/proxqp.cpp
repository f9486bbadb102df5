// ProxQP, dense: proximal augmented Lagrangian, asked for 1e-9.

#include "benchmarks/solver/qp_cascade.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <proxsuite/proxqp/dense/dense.hpp>
#pragma GCC diagnostic pop

namespace surefoot::benchmarks {
namespace {

using namespace proxsuite::proxqp;

class ProxQp final : public QpSolver {
 public:
  bool solve(const Qp& qp, Eigen::VectorXd& y) override {
    constexpr double kLarge = 1e20;
    const Eigen::VectorXd lower = qp.lower.cwiseMax(-kLarge);
    const Eigen::VectorXd upper = qp.upper.cwiseMin(kLarge);
    dense::QP<double> problem(qp.H.cols(), 0, qp.C.rows());
    problem.settings.eps_abs = 1e-9;
    problem.settings.eps_rel = 0.0;
    problem.settings.initial_guess = InitialGuessStatus::NO_INITIAL_GUESS;
    problem.init(qp.H, qp.g, proxsuite::nullopt, proxsuite::nullopt, qp.C, lower, upper);
    problem.solve();
    y = problem.results.x;
    return problem.results.info.status == QPSolverOutput::PROXQP_SOLVED && y.allFinite();
  }
};

}  // namespace

void add_proxqp(std::vector<PeerKind>& peers) {
  peers.push_back({"ProxQP cascade", false,
                   [] { return std::make_unique<QpCascade>(std::make_unique<ProxQp>(), false); }});
}

}  // namespace surefoot::benchmarks
