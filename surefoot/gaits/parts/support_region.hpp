#pragma once

#include "surefoot/signals/per_leg.hpp"

#include <array>

namespace surefoot::gaits {

/// Half-plane n·p ≤ offset with unit outward normal n.
struct HalfPlane {
  Vec2 normal{1.0, 0.0};
  double offset = 0.0;
  double height = 0.0;  ///< mean height of the two feet that the edge runs between [m]
};

/// Largest inradius of a triangle of the other feet: twice its area over its perimeter [m].
[[nodiscard]] double inradius_without(Leg lifted, const PerLeg<Vec2>& feet);

/// Where the zero-moment point can be while each foot carries at most a share α_i of the weight:
///
///     { Σ w_i p_i :  0 ≤ w_i ≤ α_i,  Σ w_i = 1 }
///
/// With α = 1 for all feet down it is the support polygon; while f_max of a foot ramps down before
/// a lift-off it shrinks to the polygon of the others. Its edges are parallel to lines
/// between two feet.
class SupportRegion {
 public:
  static constexpr int kMaxEdges = kMaxLegs * (kMaxLegs - 1) + 2;

  SupportRegion() = default;
  /// `share[i]` = α_i ≥ 0, zero for a foot in the air. Shares whose sum is less than 1.02 are
  /// scaled up to it, so that the region is not a point. `heights` of the feet [m] are only
  /// averaged for the edges.
  SupportRegion(const PerLeg<Vec2>& feet, const PerLeg<double>& share,
                const PerLeg<double>& heights = {});

  [[nodiscard]] int num_edges() const { return num_edges_; }
  [[nodiscard]] const HalfPlane& edge(int i) const { return edges_[static_cast<std::size_t>(i)]; }
  /// Distance of p to the nearest edge, positive inside [m]; −∞ with no foot down.
  [[nodiscard]] double margin(const Vec2& p) const;

 private:
  void add_edges_between(std::size_t i, std::size_t j);
  void add_edge(const Vec2& normal, double height);
  void close();
  [[nodiscard]] bool has_edge(const Vec2& normal) const;
  [[nodiscard]] Vec2 inward() const;
  [[nodiscard]] double support(const Vec2& normal) const;

  PerLeg<Vec2> feet_ = per_leg(Vec2(0.0, 0.0));
  PerLeg<double> share_{}, heights_{};
  std::array<HalfPlane, kMaxEdges> edges_{};
  int num_edges_ = 0;
};

}  // namespace surefoot::gaits
