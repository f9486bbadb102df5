#pragma once

#include "benchmarks/solver/peer.hpp"
#include "benchmarks/solver/problems.hpp"

#include <cstdint>
#include <vector>

namespace surefoot::benchmarks {

/// How a solver got on with a problem.
enum class Outcome : std::uint8_t {
  not_tried = 0,
  solved,   ///< says the solver
  failed,   ///< says the solver
  hung,     ///< no answer within the time limit
  crashed,  ///< took the process down
};

/// Calls a solver on every problem in a child process, which may hang or crash: it is then ended,
/// and another one goes on behind that problem. In a sequence the solver keeps what it knows.
[[nodiscard]] std::vector<Outcome> try_all(const PeerKind& kind, const ProblemSet& set,
                                           double time_limit);

/// Whether it came back, with an answer or without.
[[nodiscard]] constexpr bool returns(Outcome outcome) {
  return outcome == Outcome::solved || outcome == Outcome::failed;
}

}  // namespace surefoot::benchmarks
