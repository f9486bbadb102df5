#pragma once

#include "surefoot/base/error.hpp"

#include <limits>
#include <string>

namespace surefoot::solver {

/// Limit of a solve's cost. Without limits it ends at the optimum.
struct SolveBudget {
  /// By the solver's clock; ignored without a clock.
  double seconds = std::numeric_limits<double>::infinity();
  /// Additions and multiplications, counted from matrix sizes: the same problem stops at the same
  /// place on every machine.
  double flops = std::numeric_limits<double>::infinity();
};

/// Remaining budget of a running solve.
class BudgetWatch {
 public:
  using Clock = double (*)();

  /// Throws Error unless the limits are numbers ≥ 0.
  BudgetWatch(const SolveBudget& budget, Clock clock)
      : budget_(budget), clock_(budget.seconds < kNone ? clock : nullptr) {
    if (!(budget.flops >= 0.0)) refuse("flops", budget.flops);
    if (!(budget.seconds >= 0.0)) refuse("seconds", budget.seconds);
  }

  void start() {
    flops_ = 0.0;
    if (clock_ != nullptr) begin_ = clock_();
  }
  void spend(double flops) { flops_ += flops; }

  [[nodiscard]] double spent() const { return flops_; }

  [[nodiscard]] bool is_limited() const { return budget_.flops < kNone || clock_ != nullptr; }
  [[nodiscard]] bool is_spent() const {
    return flops_ >= budget_.flops || (clock_ != nullptr && clock_() - begin_ >= budget_.seconds);
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  [[noreturn]] static void refuse(const std::string& of, double number) {
    throw Error("the budget of a solve is " + std::to_string(number) + " " + of +
                "; expected a number from 0 on");
  }

  SolveBudget budget_;
  Clock clock_;
  double flops_ = 0.0, begin_ = 0.0;
};

}  // namespace surefoot::solver
