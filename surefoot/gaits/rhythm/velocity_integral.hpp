#pragma once

#include "surefoot/math/rotation.hpp"

namespace surefoot::gaits {

/// Integral of the velocity's error, in heading axes: a robot that is not as modelled is slower
/// than its feet step, or drifts aside, by the same in each step.
class VelocityIntegral {
 public:
  /// One tick of `period` [s]: `error` is reference minus estimate in heading axes [m/s]; `rate` of
  /// the integral [1/s], `most` its length at most [m/s].
  void update(const Vec2& error, double rate, double most, double period) {
    sum_ = clip_norm<2>(sum_ + period * rate * error, most);
  }
  /// To be added to the velocity in heading axes [m/s].
  [[nodiscard]] const Vec2& value() const { return sum_; }

 private:
  Vec2 sum_{0.0, 0.0};
};

}  // namespace surefoot::gaits
