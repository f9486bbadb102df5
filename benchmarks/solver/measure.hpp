#pragma once

#include "benchmarks/solver/peer.hpp"
#include "benchmarks/solver/problems.hpp"

#include <string>
#include <vector>

namespace surefoot::benchmarks {

struct MeasureOptions {
  int passes = 5;           ///< of each problem the least time counts
  double time_limit = 1.0;  ///< of a solve, before it counts as hung [s]
};

/// What one solver did with one set of problems.
struct PeerResult {
  std::string peer;
  std::vector<double> times;  ///< least of each problem that it came back from [µs]
  int problems = 0;
  int right = 0;   ///< every level's residual that of the reference, and certified, to 1e-6
  int near = 0;    ///< every level's residual that of the reference, to 1e-3
  int failed = 0;  ///< by its own word
  int hung = 0;    ///< or crashed
  double allocations = 0.0;  ///< of a solve, mean
};

struct SetResult {
  std::string name;
  int problems = 0;
  double active = 0.0;  ///< inequality rows at a bound or beyond, mean
  double q = 0.0;       ///< median over the whole measurement [µs]
  std::vector<PeerResult> peers;
};

/// All solvers in turn on each problem, pass after pass, with Q measured between them. Peers that
/// warm starts are for are left out where the problems are no sequence.
[[nodiscard]] SetResult measure(const ProblemSet& set, const std::vector<PeerKind>& kinds,
                                const MeasureOptions& options);

/// The value at this share of the sorted values; NaN of none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

}  // namespace surefoot::benchmarks
