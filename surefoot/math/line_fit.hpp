#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// Least-squares line through one sample a tick.
class LineFit {
 public:
  void add(const Vec3& y) {
    sum_ += y;
    moment_ += n_ * y;
    ++n_;
  }

  [[nodiscard]] int size() const { return n_; }
  /// Of the samples, and of the line in their middle; needs one sample.
  [[nodiscard]] Vec3 mean() const { return sum_ / n_; }
  /// Per tick: Σ (k − (n−1)/2) y_k / Σ (k − (n−1)/2)²; zero with one sample.
  [[nodiscard]] Vec3 slope() const {
    if (n_ < 2) return Vec3::Zero();
    const double n = n_;
    return (moment_ - 0.5 * (n - 1.0) * sum_) * 12.0 / (n * (n * n - 1.0));
  }
  /// Of the line, at the last sample.
  [[nodiscard]] Vec3 last() const { return mean() + 0.5 * (n_ - 1.0) * slope(); }

 private:
  int n_ = 0;
  Vec3 sum_ = Vec3::Zero(), moment_ = Vec3::Zero();  // Σ y_k, Σ k y_k
};

}  // namespace surefoot
