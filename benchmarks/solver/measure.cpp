#include "benchmarks/solver/measure.hpp"

#include "benchmarks/solver/trial.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace surefoot::benchmarks {
namespace {

constexpr double kRight = 1e-6;
constexpr double kNear = 1e-3;

template <typename Action>
double microseconds(Action&& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
      .count();
}

/// Q: Eigen's HouseholderQR of a 30 × 30 matrix.
class UnitOfTime {
 public:
  UnitOfTime() : A_(test::RandomMatrices(1).matrix(30, 30)), qr_(30, 30) {}
  double measure() {
    return microseconds([&] { qr_.compute(A_); });
  }

 private:
  Eigen::MatrixXd A_;
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
};

double residual(const solver::Level& level, const Eigen::VectorXd& x) {
  const Eigen::VectorXd value = level.A() * x;
  return (level.lower() - value).cwiseMax(value - level.upper()).cwiseMax(0.0).norm();
}

/// Largest distance of a level's residual from the reference's, relative to 1 + that.
double distance(const solver::Hierarchy& problem, const Eigen::VectorXd& x,
                const solver::Solution& reference) {
  if (x.size() != problem.unknowns() || !x.allFinite()) {
    return std::numeric_limits<double>::infinity();
  }
  double largest = 0.0;
  for (std::size_t k = 0; k < problem.num_levels(); ++k) {
    const double expected = reference.levels[k].residual;
    const double difference = std::abs(residual(problem.level(k), x) - expected);
    largest = std::max(largest, difference / (1.0 + expected));
  }
  return largest;
}

bool is_certified(const solver::Hierarchy& problem, const Eigen::VectorXd& x) {
  // What counts as independent is what it is for the solvers.
  const solver::CertificateOptions tolerance{.tight = kRight,
                                             .rank = solver::RankTolerance{}.solve};
  return solver::worst_stationarity(solver::certify(problem, x, tolerance)) < kRight;
}

void judge(const solver::Hierarchy& problem, const Eigen::VectorXd& x,
           const solver::Solution& reference, PeerResult& result) {
  const double off = distance(problem, x, reference);
  if (off <= kNear) ++result.near;
  if (off <= kRight && is_certified(problem, x)) ++result.right;
}

/// One solver on its way through the problems.
struct Run {
  PeerKind kind;
  std::vector<Outcome> outcomes;
  std::unique_ptr<Peer> peer, shadow;
  std::vector<double> least;
  PeerResult result;
  double allocations = 0.0;
  long solves = 0;
};

class Measurement {
 public:
  Measurement(const ProblemSet& set, const MeasureOptions& options)
      : set_(set),
        options_(options),
        least_q_(set.problems.size(), std::numeric_limits<double>::infinity()) {}

  void add(const PeerKind& kind) {
    if (kind.is_warm && !set_.is_sequence) return;
    Run run;
    run.kind = kind;
    run.outcomes = try_all(kind, set_, options_.time_limit);
    run.least.assign(set_.problems.size(), std::numeric_limits<double>::infinity());
    run.result.peer = kind.name;
    run.result.problems = static_cast<int>(set_.problems.size());
    for (const Outcome outcome : run.outcomes) {
      if (outcome == Outcome::failed) ++run.result.failed;
      if (!returns(outcome)) ++run.result.hung;
    }
    runs_.push_back(std::move(run));
  }

  /// Every second pass goes through the solvers backwards: who comes after one that is much like it
  /// finds the processor's branch predictors trained for this very problem.
  SetResult run() {
    for (int pass = 0; pass < options_.passes; ++pass) {
      for (Run& run : runs_) forget(run);
      for (std::size_t i = 0; i < set_.problems.size(); ++i) solve(i, pass == 0);
      std::ranges::reverse(runs_);
    }
    if (options_.passes % 2 == 1) std::ranges::reverse(runs_);
    return result();
  }

 private:
  void solve(std::size_t i, bool is_first_pass) {
    // In a sequence the rows lie where a controller has just written them.
    if (set_.is_sequence) live_ = set_.problems[i];
    const solver::Hierarchy& problem = set_.is_sequence ? live_ : set_.problems[i];
    solver::Solution reference;
    if (is_first_pass) {
      reference = solver::CascadeSolver(problem).solve(problem);
      for (const solver::LevelResult& level : reference.levels) num_active_ += level.num_active();
    }
    least_q_[i] = std::min(least_q_[i], unit_.measure());
    for (Run& run : runs_) {
      if (!returns(run.outcomes[i])) {
        forget(run);  // as in the trial, where the next problem met a new solver
        continue;
      }
      time(run, problem, i);
      if (is_first_pass) judge(problem, run.peer->x(), reference, run.result);
    }
  }

  static void forget(Run& run) {
    run.peer.reset();
    run.shadow.reset();
  }

  /// The solver's shadow goes first, not timed: so everyone has code and problem in the caches,
  /// not only who comes after a solver that is much like it.
  void time(Run& run, const solver::Hierarchy& problem, std::size_t i) const {
    for (std::unique_ptr<Peer>* peer : {&run.peer, &run.shadow}) {
      if (!*peer || !set_.is_sequence) *peer = run.kind.make();
      (*peer)->prepare(problem);
    }
    (void)run.shadow->solve();
    const test::MallocCounter counter;
    const double time = microseconds([&] { (void)run.peer->solve(); });
    run.allocations += static_cast<double>(counter.count());
    ++run.solves;
    run.least[i] = std::min(run.least[i], time);
  }

  SetResult result() {
    const auto count = static_cast<int>(set_.problems.size());
    SetResult result{
        set_.name, count, static_cast<double>(num_active_) / count, quantile(least_q_, 0.5), {}};
    for (Run& run : runs_) {
      // One that did not come back took at least the time limit.
      for (const double time : run.least) {
        run.result.times.push_back(std::isfinite(time) ? time : 1e6 * options_.time_limit);
      }
      if (run.solves > 0)
        run.result.allocations = run.allocations / static_cast<double>(run.solves);
      result.peers.push_back(run.result);
    }
    return result;
  }

  const ProblemSet& set_;
  MeasureOptions options_;
  std::vector<double> least_q_;
  std::vector<Run> runs_;
  UnitOfTime unit_;
  solver::Hierarchy live_{0};
  long num_active_ = 0;
};

}  // namespace

SetResult measure(const ProblemSet& set, const std::vector<PeerKind>& kinds,
                  const MeasureOptions& options) {
  Measurement measurement(set, options);
  for (const PeerKind& kind : kinds) measurement.add(kind);
  return measurement.run();
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(share * last))];
}

}  // namespace surefoot::benchmarks
