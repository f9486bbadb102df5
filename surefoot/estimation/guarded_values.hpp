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

  /// What a value can be, and how far its next sample can be from what is expected: beyond
  /// `tolerance` it is not believed; beyond `sure` only if the next is, too, and from then on until
  /// it was calm for `patience`. How fast it can go from one sample to the next: by `margin` and
  /// `speed` × time.
  struct Limits {
    Vector range, tolerance = Vector::Constant(kUnlimited), sure = Vector::Constant(kUnlimited),
                  margin = Vector::Constant(kUnlimited), speed = Vector::Zero();
  };

  /// Moves what is expected of the next samples; without it, they are expected to stay.
  void move(const Vector& change) noexcept { expected_ += change; }

  /// One tick. `common` is a fault of all. A value that got no good sample for `patience` is
  /// believed at any place in its range.
  void take(const Vector& raw, SampleFault common, const SampleWatch& watch, const Limits& limits,
            double patience) noexcept {
    for (int i = 0; i < n; ++i) {
      SampleFault& fault = faults_[static_cast<std::size_t>(i)];
      fault = common;
      if (common == SampleFault::none) {
        const double age = watch.sample_time() - seen_[i];
        const double apart = std::abs(watch.given_time() - seen_[i]);
        fault = age <= patience ? check(i, raw[i], limits, apart)
                                : check(i, raw[i], {.range = limits.range}, apart);
        if (fault == SampleFault::none && std::abs(raw[i] - expected_[i]) > limits.sure[i]) {
          fault = doubt(i, watch.sample_time(), patience);
        } else if (watch.is_new()) {
          doubted_[static_cast<std::size_t>(i)] = false;
        }
      }
      const bool good = fault == SampleFault::none;
      if (good && watch.is_new()) accept(i, raw[i], watch.sample_time());
      repaired_[i] = good ? raw[i] : expected_[i];
      measured_[i] = good ? raw[i] : kNaN;
    }
  }

  /// The values that can be by these limits `age` after the last samples, NaN in the place of
  /// others; they are no samples.
  [[nodiscard]] Vector plausible(const Vector& raw, const Limits& limits,
                                 const Vector& age) const noexcept {
    Vector result = raw;
    for (int i = 0; i < n; ++i) {
      if (check(i, raw[i], limits, age[i]) != SampleFault::none) result[i] = kNaN;
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
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();

  void accept(int i, double value, double time) noexcept {
    expected_[i] = last_[i] = value;
    seen_[i] = time;
  }

  /// Of a sample so long `apart` from the last good one; NaN before it.
  [[nodiscard]] SampleFault check(int i, double raw, const Limits& limits,
                                  double apart) const noexcept {
    if (!std::isfinite(raw)) return SampleFault::not_a_number;
    if (std::abs(raw) > limits.range[i]) return SampleFault::out_of_range;
    const bool is_too_far = std::abs(raw - expected_[i]) > limits.tolerance[i];
    const bool is_too_fast = std::abs(raw - last_[i]) > limits.margin[i] + limits.speed[i] * apart;
    return is_too_far || is_too_fast ? SampleFault::jump : SampleFault::none;
  }

  [[nodiscard]] SampleFault doubt(int i, double sample_time, double patience) noexcept {
    bool& doubted = doubted_[static_cast<std::size_t>(i)];
    const bool is_believed = doubted || sample_time - shaken_[i] <= patience;
    if (is_believed) shaken_[i] = sample_time;
    doubted = !is_believed;
    return is_believed ? SampleFault::none : SampleFault::jump;
  }

  Vector expected_ = Vector::Constant(kNaN), seen_ = Vector::Constant(kNaN);
  Vector last_ = Vector::Constant(kNaN);    // good sample
  Vector shaken_ = Vector::Constant(kNaN);  // when a step was large and believed [s]
  std::array<bool, n> doubted_{};           // the sample before
  Vector repaired_ = Vector::Constant(kNaN), measured_ = Vector::Constant(kNaN);
  std::array<SampleFault, n> faults_{};
};

}  // namespace surefoot
