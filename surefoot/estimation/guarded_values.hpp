#pragma once

#include "surefoot/estimation/sample_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace surefoot::estimation {

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Decides whether to accept an unusually large step: if the next sample's step is large, too, and
/// then until `patience` passes without one; never while `sure_only` holds.
class StepDoubt {
 public:
  /// A new sample; `waited`: the samples before it were doubted together; `sure_only`: accept no
  /// large step. True: refused.
  [[nodiscard]] bool refuses(bool is_large, bool waited, bool sure_only, double sample_time,
                             double patience) noexcept {
    const bool is_confirmed = doubts_ || waited || sample_time - believed_ <= patience;
    const bool is_believed = !is_large || (is_confirmed && !sure_only);
    if (is_large) large_ = sample_time;
    if (is_large && is_believed) believed_ = sample_time;
    doubts_ = !is_believed;
    return doubts_;
  }
  /// A sample that is faulty for another reason.
  void skip(bool is_large, double sample_time) noexcept {
    if (is_large) large_ = sample_time;
    doubts_ = false;
  }
  /// Was the last sample refused?
  [[nodiscard]] bool doubts() const { return doubts_; }
  /// Was a step large since then?
  [[nodiscard]] bool is_shaken_since(double time) const { return large_ >= time; }

 private:
  double large_ = kNaN;     // time of the last large step [s]
  double believed_ = kNaN;  // time of the last accepted large step [s]
  bool doubts_ = false;
};

/// Values that are sampled together: their last good samples and this tick's faults. Judges each
/// value alone, and all together.
template <typename Vector>
class GuardedValues {
 public:
  explicit GuardedValues(Eigen::Index n)
      : expected_(Vector::Constant(n, kNaN)),
        seen_(expected_),
        sampled_(expected_),
        repaired_(expected_),
        measured_(expected_),
        faults_(static_cast<std::size_t>(n)),
        doubts_(static_cast<std::size_t>(n)) {}

  /// Range of a value, and limits on its distance from the expected one. Beyond `tolerance` it is
  /// refused; beyond `sure` accepted only as `StepDoubt` allows, and with `sure_only` never. If
  /// half of the values are beyond `group_step`, `StepDoubt` decides on all; if half are beyond
  /// `max_group_step`, all are refused. The last three are per period between the samples.
  struct Limits {
    Vector range, tolerance, sure;
    double group_step = kUnlimited, max_group_step = kUnlimited;
    bool sure_only = false;
  };

  /// Moves the expected next samples; otherwise they are expected to stay.
  void move(const Vector& change) noexcept { expected_ += change; }

  /// One tick. `common` is a fault of all. After `patience` without a good sample any value in
  /// range is accepted.
  void take(const Vector& raw, SampleFault common, const SampleWatch& watch, const Limits& limits,
            double patience) noexcept {
    const bool all_waited = all_.doubts();
    if (common == SampleFault::none && doubts_all(raw, watch, limits, patience)) {
      common = SampleFault::jump;
    }
    for (int i = 0; i < size(); ++i) {
      SampleFault& fault = faults_[static_cast<std::size_t>(i)];
      fault = common;
      if (common == SampleFault::none) {
        fault = judge(i, raw[i], watch, limits, all_waited, patience);
      }
      const bool good = fault == SampleFault::none;
      if (good && watch.is_new()) accept(i, raw[i], watch.sample_time());
      repaired_[i] = good ? raw[i] : expected_[i];
      measured_[i] = good ? raw[i] : kNaN;
    }
    for (int i = 0; i < size(); ++i) {
      if (std::isfinite(raw[i])) sampled_[i] = watch.sample_time();
    }
  }

  /// The values possible by these limits, NaN for others; does not count as a sample.
  [[nodiscard]] Vector plausible(const Vector& raw, const Limits& limits) const noexcept {
    Vector result = raw;
    for (int i = 0; i < size(); ++i) {
      const SampleFault fault = check(i, raw[i], limits.range[i], limits.tolerance[i]);
      if (fault != SampleFault::none) result[i] = kNaN;
    }
    return result;
  }

  /// Discards samples since then.
  void forget_since(double time) noexcept { seen_ = seen_.cwiseMin(time); }

  /// Was any step unusually large?
  [[nodiscard]] bool is_shaken_since(double time) const noexcept {
    return std::ranges::any_of(doubts_,
                               [&](const StepDoubt& d) { return d.is_shaken_since(time); });
  }

  /// Was a step of all together?
  [[nodiscard]] bool all_are_shaken_since(double time) const noexcept {
    return all_.is_shaken_since(time);
  }

  [[nodiscard]] GroupHealth health(double time) const noexcept {
    GroupHealth result;
    int num_faults = 0;
    for (int i = 0; i < size(); ++i) {
      const double age = std::max(0.0, time - seen_[i]);
      if (!std::isnan(seen_[i]) && !(age <= result.age)) result.age = age;
      const SampleFault fault = faults_[static_cast<std::size_t>(i)];
      if (fault == SampleFault::none) continue;
      if (num_faults++ == 0) result.fault = fault;
      result.joint = num_faults == 1 ? i : -1;
    }
    return result;
  }

  /// The samples, with expected values for faulty ones.
  [[nodiscard]] const Vector& repaired() const { return repaired_; }
  /// The samples, with NaN for faulty ones.
  [[nodiscard]] const Vector& measured() const { return measured_; }
  /// Times of the last good samples [s].
  [[nodiscard]] const Vector& seen() const { return seen_; }

 private:
  [[nodiscard]] int size() const noexcept { return static_cast<int>(expected_.size()); }

  void accept(int i, double value, double time) noexcept {
    expected_[i] = value;
    seen_[i] = time;
  }

  /// Periods since the sample before.
  [[nodiscard]] double periods(int i, const SampleWatch& watch) const noexcept {
    return std::max(1.0, (watch.sample_time() - sampled_[i]) / watch.period());  // not NaN
  }

  /// After a sample that waited for confirmation, two periods are unknown.
  [[nodiscard]] SampleFault judge(int i, double raw, const SampleWatch& watch, const Limits& limits,
                                  bool all_waited, double patience) noexcept {
    const bool is_lost = !(watch.sample_time() - seen_[i] <= patience);
    if (is_lost) return check(i, raw, limits.range[i], kUnlimited);
    StepDoubt& doubt = doubts_[static_cast<std::size_t>(i)];
    const double share = all_waited || doubt.doubts() ? 2.0 : 1.0;
    const SampleFault fault = check(i, raw, limits.range[i], share * limits.tolerance[i]);
    const bool is_large = std::abs(raw - expected_[i]) > limits.sure[i] * periods(i, watch);
    if (fault != SampleFault::none) {
      if (watch.is_new()) doubt.skip(is_large, watch.sample_time());
      return fault;
    }
    const bool is_doubted = watch.is_new() ? doubt.refuses(is_large, all_waited, limits.sure_only,
                                                           watch.sample_time(), patience)
                                           : doubt.doubts();
    return is_doubted ? SampleFault::jump : SampleFault::none;
  }

  /// Considers values that are not lost.
  [[nodiscard]] bool doubts_all(const Vector& raw, const SampleWatch& watch, const Limits& limits,
                                double patience) noexcept {
    if (!watch.is_new()) return all_.doubts();
    int num_off = 0, num_far = 0;
    for (int i = 0; i < size(); ++i) {
      if (!(watch.sample_time() - seen_[i] <= patience)) continue;  // lost, or NaN
      const double off = std::abs(raw[i] - expected_[i]) / periods(i, watch);
      num_off += off > limits.group_step ? 1 : 0;
      num_far += off > limits.max_group_step ? 1 : 0;
    }
    const bool refused =
        all_.refuses(2 * num_off >= size(), false, false, watch.sample_time(), patience);
    return refused || 2 * num_far >= size();
  }

  [[nodiscard]] SampleFault check(int i, double raw, double range,
                                  double tolerance) const noexcept {
    if (!std::isfinite(raw)) return SampleFault::not_a_number;
    if (std::abs(raw) > range) return SampleFault::out_of_range;
    return std::abs(raw - expected_[i]) > tolerance ? SampleFault::jump : SampleFault::none;
  }

  Vector expected_, seen_;
  Vector sampled_;  // times of the samples before [s]
  Vector repaired_, measured_;
  std::vector<SampleFault> faults_;
  std::vector<StepDoubt> doubts_;
  StepDoubt all_;
};

}  // namespace surefoot::estimation
