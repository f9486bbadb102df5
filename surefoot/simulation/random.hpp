#pragma once

#include <array>
#include <cstdint>

namespace surefoot::simulation {

/// Random numbers, equal with every standard library: xoshiro256++ seeded by splitmix64, normal
/// deviates by Box and Muller.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  [[nodiscard]] std::uint64_t bits();
  /// Uniform in [0, 1).
  [[nodiscard]] double uniform();
  /// Normal with mean 0 and standard deviation 1.
  [[nodiscard]] double normal();

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace surefoot::simulation
