// qpOASES: parametric active set, with the settings that its manual gives for control (setToMPC)
// and room for 1000 changes of the active set. Its status is honoured.

#include "benchmarks/solver/qp_cascade.hpp"

#include <qpOASES.hpp>

namespace surefoot::benchmarks {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class QpOases final : public QpSolver {
 public:
  bool solve(const Qp& qp, Eigen::VectorXd& y) override {
    const auto n = static_cast<int>(qp.H.cols());
    const auto m = static_cast<int>(qp.C.rows());
    const RowMajor H = qp.H, C = qp.C;
    const Eigen::VectorXd lower = qp.lower.cwiseMax(-qpOASES::INFTY);
    const Eigen::VectorXd upper = qp.upper.cwiseMin(qpOASES::INFTY);
    qpOASES::Options options;
    options.setToMPC();
    options.printLevel = qpOASES::PL_NONE;
    options.enableEqualities = qpOASES::BT_TRUE;
    qpOASES::QProblem problem(n, m);
    problem.setOptions(options);
    qpOASES::int_t changes = 1000;
    const qpOASES::returnValue status = problem.init(H.data(), qp.g.data(), C.data(), nullptr,
                                                     nullptr, lower.data(), upper.data(), changes);
    y.setZero(n);
    problem.getPrimalSolution(y.data());
    return status == qpOASES::SUCCESSFUL_RETURN;
  }
};

}  // namespace

void add_qpoases(std::vector<PeerKind>& peers) {
  peers.push_back({"qpOASES cascade", false,
                   [] { return std::make_unique<QpCascade>(std::make_unique<QpOases>(), false); }});
}

}  // namespace surefoot::benchmarks
