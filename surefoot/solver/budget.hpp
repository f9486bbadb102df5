#pragma once

#include <chrono>
#include <limits>

namespace surefoot {

/// What a solve may cost. Without limits it ends at the optimum.
struct SolveBudget {
  double seconds = std::numeric_limits<double>::infinity();  ///< of wall time
  /// Additions and multiplications of the search, counted from the sizes of what is multiplied: the
  /// same problem ends at the same place on every machine.
  double flops = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_limited() const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return seconds < kNone || flops < kNone;
  }
};

/// What is left of a budget while it is being spent.
class BudgetWatch {
 public:
  explicit BudgetWatch(const SolveBudget& budget) : budget_(budget) {}

  void start() {
    flops_ = 0.0;
    if (budget_.is_limited()) begin_ = std::chrono::steady_clock::now();
  }
  void spend(double flops) { flops_ += flops; }

  [[nodiscard]] bool is_limited() const { return budget_.is_limited(); }
  [[nodiscard]] bool is_spent() const {
    if (!is_limited()) return false;
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin_;
    return flops_ > budget_.flops || time.count() > budget_.seconds;
  }

 private:
  SolveBudget budget_;
  double flops_ = 0.0;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace surefoot
