#include "benchmarks/solver/peer.hpp"

#include "surefoot/runtime/steady_clock.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"

namespace surefoot::benchmarks {
namespace {

/// One of our own solvers, made for the first problem's capacity or for a larger one that follows.
template <typename Solver, typename Options>
class Ours final : public Peer {
 public:
  explicit Ours(const Options& options) : options_(options) {}

  void prepare(const solver::Hierarchy& problem) override {
    problem_ = &problem;
    if (!solver_) solver_ = std::make_unique<Solver>(problem, options_);
  }
  bool solve() override {
    const solver::Solution& solution = solver_->solve(*problem_);
    return solution.status == solver::SolveStatus::optimal;
  }
  const Eigen::VectorXd& x() const override { return solver_->solution().x; }

 private:
  Options options_;
  std::unique_ptr<Solver> solver_;
  const solver::Hierarchy* problem_ = nullptr;
};

template <typename Solver, typename Options>
PeerKind ours(const std::string& name, bool is_warm, const Options& options) {
  return {name, is_warm, [options] { return std::make_unique<Ours<Solver, Options>>(options); }};
}

}  // namespace

std::vector<PeerKind> all_peers() {
  solver::LexicographicOptions cold;
  cold.warm_start = false;
  std::vector<PeerKind> peers = {
      ours<solver::LexicographicSolver>("ours, warm", true, solver::LexicographicOptions{}),
      ours<solver::LexicographicSolver>("ours", false, cold),
      ours<solver::CascadeSolver>("our cascade", false, solver::CascadeOptions{})};
#ifdef SUREFOOT_PEER_DAQP
  add_daqp(peers);
#endif
#ifdef SUREFOOT_PEER_EIQUADPROG
  add_eiquadprog(peers);
#endif
#ifdef SUREFOOT_PEER_QPOASES
  add_qpoases(peers);
#endif
#ifdef SUREFOOT_PEER_PROXQP
  add_proxqp(peers);
#endif
  return peers;
}

void add_ours_with_clock(std::vector<PeerKind>& peers) {
  solver::LexicographicOptions options;
  options.clock = runtime::steady_seconds;
  peers.push_back(ours<solver::LexicographicSolver>("ours, warm, with a clock", true, options));
  options.warm_start = false;
  peers.push_back(ours<solver::LexicographicSolver>("ours, with a clock", false, options));
}

}  // namespace surefoot::benchmarks
