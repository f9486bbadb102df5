#pragma once

#include "surefoot/estimation/sample_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace surefoot {

/// n values that are sampled together: the last good samples, and what this tick's are worth. Each
/// value is judged by itself.
template <int n>
class GuardedValues {
 public:
  using Vector = Eigen::Matrix<double, n, 1>;

  /// What a value can be, and how far its next sample can be from what is expected.
  struct Limits {
    Vector range, tolerance;
  };

  /// Moves what is expected of the next samples; without it, they are expected to stay.
  void move(const Vector& change) noexcept { expected_ += change; }

  /// One tick. `common` is a fault of all. A value that got no good sample for `patience` is
  /// believed at any place in its range.
  void take(const Vector& raw, SampleFault common, const SampleWatch& watch, const Limits& limits,
            double patience) noexcept {
    for (int i = 0; i < n; ++i) {
      const bool is_lost = !(watch.sample_time() - seen_[i] <= patience);
      const double tolerance =
          is_lost ? std::numeric_limits<double>::infinity() : limits.tolerance[i];
      SampleFault& fault = faults_[static_cast<std::size_t>(i)];
      fault = common != SampleFault::none ? common : check(i, raw[i], limits.range[i], tolerance);
      const bool good = fault == SampleFault::none;
      if (good && watch.is_new()) accept(i, raw[i], watch.sample_time());
      repaired_[i] = good ? raw[i] : expected_[i];
      measured_[i] = good ? raw[i] : kNaN;
    }
  }

  /// The values that can be by these limits, NaN in the place of others; they are no samples.
  [[nodiscard]] Vector plausible(const Vector& raw, const Limits& limits) const noexcept {
    Vector result = raw;
    for (int i = 0; i < n; ++i) {
      if (check(i, raw[i], limits.range[i], limits.tolerance[i]) != SampleFault::none) {
        result[i] = kNaN;
      }
    }
    return result;
  }

  /// They were no samples since then.
  void forget_since(double time) noexcept { seen_ = seen_.cwiseMin(time); }

  [[nodiscard]] GroupHealth health(double time) const noexcept {
    GroupHealth result;
    int num_faults = 0;
    for (int i = 0; i < n; ++i) {
      const double age = std::max(0.0, time - seen_[i]);
      if (!std::isnan(seen_[i]) && !(age <= result.age)) result.age = age;
      const SampleFault fault = faults_[static_cast<std::size_t>(i)];
      if (fault == SampleFault::none) continue;
      if (num_faults++ == 0) result.fault = fault;
      result.joint = num_faults == 1 ? i : -1;
    }
    return result;
  }

  /// The samples, with what is expected in the place of faulty ones.
  [[nodiscard]] const Vector& repaired() const { return repaired_; }
  /// The samples, NaN in the place of faulty ones.
  [[nodiscard]] const Vector& measured() const { return measured_; }
  /// Times of the last good samples [s].
  [[nodiscard]] const Vector& seen() const { return seen_; }

 private:
  void accept(int i, double value, double time) noexcept {
    expected_[i] = value;
    seen_[i] = time;
  }

  [[nodiscard]] SampleFault check(int i, double raw, double range,
                                  double tolerance) const noexcept {
    if (!std::isfinite(raw)) return SampleFault::not_a_number;
    if (std::abs(raw) > range) return SampleFault::out_of_range;
    return std::abs(raw - expected_[i]) > tolerance ? SampleFault::jump : SampleFault::none;
  }

  Vector expected_ = Vector::Constant(kNaN), seen_ = Vector::Constant(kNaN);
  Vector repaired_ = Vector::Constant(kNaN), measured_ = Vector::Constant(kNaN);
  std::array<SampleFault, n> faults_{};
};

}  // namespace surefoot
