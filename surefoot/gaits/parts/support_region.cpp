#include "surefoot/gaits/parts/support_region.hpp"

#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace surefoot::gaits {
namespace {

constexpr double kSmallShare = 1e-9;
constexpr double kCoincident = 1e-6;  // [m]
constexpr double kParallel = 1e-6;    // sine of the angle between two edges
constexpr double kMinTotal = 1.02;    // at 1 the region would be a single point without edges

double inradius(const Vec2& first, const Vec2& second, const Vec2& third) {
  const Vec2 a = second - first, b = third - first;
  const double circumference = a.norm() + b.norm() + (b - a).norm();
  const double twice_area = std::abs(a.x() * b.y() - a.y() * b.x());
  return circumference > kCoincident ? twice_area / circumference : 0.0;
}

}  // namespace

double inradius_without(Leg lifted, const PerLeg<Vec2>& feet) {
  double widest = 0.0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    for (std::size_t j = i + 1; j < feet.size(); ++j) {
      for (std::size_t k = j + 1; k < feet.size(); ++k) {
        const std::size_t without = index(lifted);
        if (i == without || j == without || k == without) continue;
        widest = std::max(widest, inradius(feet[i], feet[j], feet[k]));
      }
    }
  }
  return widest;
}

SupportRegion::SupportRegion(const PerLeg<Vec2>& feet, const PerLeg<double>& share,
                             const PerLeg<double>& heights)
    : feet_(feet), share_(share), heights_(heights) {
  const double total = std::accumulate(share.begin(), share.end(), 0.0);
  if (total <= kSmallShare) return;
  for (double& a : share_) a *= std::max(1.0, kMinTotal / total);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    for (std::size_t j = i + 1; j < feet.size(); ++j) {
      if (share_[i] <= kSmallShare || share_[j] <= kSmallShare) continue;
      add_edges_between(i, j);
    }
  }
  close();
}

// Unit vector from a loaded foot to the centre of all feet: rotates with the feet.
Vec2 SupportRegion::inward() const {
  Vec2 middle = Vec2::Zero(), carrying = Vec2::Zero();
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    middle += feet_[i] / static_cast<double>(feet_.size());
    if (share_[i] > kSmallShare) carrying = feet_[i];
  }
  const Vec2 offset = middle - carrying;
  return offset.norm() > kCoincident ? offset.normalized() : Vec2::UnitX();
}

// Feet in a line have edges along it only, and a single foot has none: adds the missing edges.
void SupportRegion::close() {
  const bool point = num_edges_ == 0;
  const Vec2 normal = point ? inward() : edge(0).normal;
  const Vec2 along(-normal.y(), normal.x());
  for (int i = 0; i < num_edges_; ++i) {
    if (std::abs(along.dot(edge(i).normal)) > kParallel) return;
  }
  double height = 0.0, total = 0.0;
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    height += share_[i] * heights_[i];
    total += share_[i];
  }
  for (const double sign : {1.0, -1.0}) {
    add_edge(sign * along, height / total);
    if (point) add_edge(sign * normal, height / total);
  }
}

// The support point of a direction loads the feet greedily in the order of normal·p. Feet i and j
// tie on the edge between them. The edge has a length only if the weight left for the tied feet is
// above zero and below their total share.
void SupportRegion::add_edges_between(std::size_t i, std::size_t j) {
  const Vec2 along = feet_[j] - feet_[i];
  if (along.norm() < kCoincident) return;
  const Vec2 perpendicular = Vec2(along.y(), -along.x()).normalized();
  for (const double sign : {1.0, -1.0}) {
    const Vec2 normal = sign * perpendicular;
    const double tie = normal.dot(feet_[i]);
    double before = 0.0, tied = 0.0;
    for (std::size_t k = 0; k < feet_.size(); ++k) {
      const double ahead = normal.dot(feet_[k]) - tie;
      if (ahead > kCoincident)
        before += share_[k];
      else if (ahead >= -kCoincident)
        tied += share_[k];
    }
    const double left = 1.0 - before;
    if (left > kSmallShare && left < tied - kSmallShare) {
      add_edge(normal, 0.5 * (heights_[i] + heights_[j]));
    }
  }
}

void SupportRegion::add_edge(const Vec2& normal, double height) {
  if (num_edges_ == kMaxEdges || has_edge(normal)) return;
  edges_[static_cast<std::size_t>(num_edges_++)] = {normal, support(normal), height};
}

// A third foot in line with two others gives the same edge again.
bool SupportRegion::has_edge(const Vec2& normal) const {
  for (int i = 0; i < num_edges_; ++i) {
    if ((edge(i).normal - normal).cwiseAbs().maxCoeff() < kParallel) return true;
  }
  return false;
}

double SupportRegion::support(const Vec2& normal) const {
  const auto ahead = [&](Leg k) { return normal.dot(feet_[index(k)]); };
  PerLeg<bool> taken(static_cast<int>(feet_.size()), false);
  double left = 1.0, sum = 0.0;
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    std::optional<Leg> next;
    for (const Leg k : feet_.legs()) {
      if (!taken[index(k)] && (!next || ahead(k) > ahead(*next))) next = k;
    }
    taken[index(*next)] = true;
    const double carries = std::min(left, share_[index(*next)]);
    sum += carries * ahead(*next);
    left -= carries;
  }
  return sum;
}

double SupportRegion::margin(const Vec2& p) const {
  double smallest = num_edges_ == 0 ? -kInfinity : kInfinity;
  for (int i = 0; i < num_edges_; ++i) {
    smallest = std::min(smallest, edge(i).offset - edge(i).normal.dot(p));
  }
  return smallest;
}

}  // namespace surefoot::gaits
