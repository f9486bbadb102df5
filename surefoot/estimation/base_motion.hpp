#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// Velocity of the base's origin and its angular velocity, in B [m/s], [rad/s].
struct BaseMotion {
  Vec3 v = Vec3::Zero();
  Vec3 w = Vec3::Zero();
};

/// How a base moves whose feet all stand still and are seen from it at p_BF, moving by v_BF, both
/// in B [m], [m/s]: the v and ω that leave least of Σ |v + ω × p_BF + v_BF|². Not finite where all
/// feet lie in a line.
[[nodiscard]] BaseMotion base_motion(const PerLeg<Vec3>& p_BF, const PerLeg<Vec3>& v_BF);

/// A straight line through samples that come one a tick, by least squares.
class LineFit {
 public:
  void clear() { *this = {}; }
  void add(const Vec3& y);
  [[nodiscard]] int size() const { return n_; }
  [[nodiscard]] Vec3 mean() const { return sum_ / n_; }
  [[nodiscard]] Vec3 slope() const;  ///< per tick; zero of less than two samples
  [[nodiscard]] Vec3 last() const;   ///< of the line, at the last sample

 private:
  int n_ = 0;
  Vec3 sum_ = Vec3::Zero(), moment_ = Vec3::Zero();  // Σ y, Σ k y
};

}  // namespace surefoot
