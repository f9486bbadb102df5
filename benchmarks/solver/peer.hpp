#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace surefoot::benchmarks {

/// A solver under test, ours or another's.
class Peer {
 public:
  Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  virtual ~Peer() = default;

  /// Not timed: brings a problem into the solver's own layout. The problem stays until it is
  /// solved.
  virtual void prepare(const solver::Hierarchy& problem) = 0;
  /// Timed: from data in that layout to x. False if the solver says that it failed; x is then what
  /// it got to.
  [[nodiscard]] virtual bool solve() = 0;
  [[nodiscard]] virtual const Eigen::VectorXd& x() const = 0;
};

/// How to make one.
struct PeerKind {
  std::string name;
  bool is_warm = false;  ///< keeps what it knows from problem to problem; only of use in sequences
  std::function<std::unique_ptr<Peer>()> make;
};

/// Ours first: what the others are divided by.
[[nodiscard]] std::vector<PeerKind> all_peers();

/// Ours once more, telling the time of each level. Not among the others: who comes after a solver
/// that is much like it finds the processor's branch predictors trained.
void add_ours_with_clock(std::vector<PeerKind>& peers);

// Each is defined where the solver was found when the build was configured.
void add_daqp(std::vector<PeerKind>& peers);
void add_eiquadprog(std::vector<PeerKind>& peers);
void add_qpoases(std::vector<PeerKind>& peers);
void add_proxqp(std::vector<PeerKind>& peers);

}  // namespace surefoot::benchmarks
