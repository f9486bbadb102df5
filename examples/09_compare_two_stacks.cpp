// Which of two stacks tracks better? The same seeds with both, then a test of the pairs: how likely
// are differences this one-sided if the stacks are equally good? Seeds draw sensors and ground.
#include "surefoot/closed_loop.hpp"
#include "surefoot/scenario.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

/// RMS of the torso's orientation error in a run [rad]; NaN if it did not stay up.
double error_of(const std::string& stack, std::uint64_t seed) {
  const auto scenario = surefoot::config::load_scenario(
      {"walk_flat_mismatch", seed, {"duration=14", "stack=" + stack}});
  const auto result = surefoot::closed_loop::run_closed_loop(scenario, {});
  return result.safety_stop ? NAN : result.metrics.orientation_error_rms_rad;
}

/// Two-sided p of the sign-flip test: the share of all 2ⁿ choices of signs whose mean is at least
/// as far from 0. Exact, and without a distribution.
double p_of_sign_flips(const std::vector<double>& differences) {
  double seen = 0.0;
  for (const double d : differences) seen += d;
  int as_far = 0;
  const int choices = 1 << differences.size();
  for (int choice = 0; choice < choices; ++choice) {
    double sum = 0.0;
    for (std::size_t i = 0; i < differences.size(); ++i)
      sum += (choice >> i & 1) != 0 ? differences[i] : -differences[i];
    if (std::abs(sum) >= std::abs(seen) - 1e-15) ++as_far;
  }
  return static_cast<double>(as_far) / choices;
}

int main() {
  std::vector<double> differences;
  std::printf("seed  terrain_adaptation  regular   [mrad]\n");
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const double a = error_of("terrain_adaptation", seed), b = error_of("regular", seed);
    std::printf("%4d  %18.2f  %7.2f\n", static_cast<int>(seed), 1e3 * a, 1e3 * b);
    if (std::isfinite(a - b)) differences.push_back(a - b);
  }
  double mean = 0.0;
  for (const double d : differences) mean += d / static_cast<double>(differences.size());
  const double p = p_of_sign_flips(differences);
  std::printf("mean difference %+.2f mrad in %zu pairs, p = %.3f: %s\n", 1e3 * mean,
              differences.size(), p, p < 0.05 ? "they differ" : "more seeds are needed");
  return differences.size() >= 5 ? 0 : 1;
}
