#include "surefoot/doctor/found_flat_legs.hpp"

#include "surefoot/doctor/shape_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace surefoot::doctor {
namespace {

constexpr std::size_t kLeastJoints = kJointsPerLeg + 1;
constexpr double kMostMismatch =
    0.1;                             // of the leg's length, of a foot and the other's mirror image
constexpr double kLegDepth = 0.8;    // share of the lowest foot's, from which another limb is a leg
constexpr double kPitchShare = 0.9;  // of an axis along y
constexpr std::array kAngles{-0.3, 0.6, -0.3};  // of hip, knee and ankle: the sole is level [rad]
constexpr double kSoleDepth = 0.02;             // of the leg's length, above the lowest point

/// A chain from the base at angles of zero.
struct Straight {
  const Limb* limb;
  std::vector<double> pitch{};  // of each axis, along y of the base
  model::Weld tip{};            // of the last link
  Vec3 hip = Vec3::Zero();
};

Straight straight(const Limb& limb, const std::map<std::string, model::Weld>& welds) {
  Straight chain{.limb = &limb};
  for (const model::UrdfJoint& joint : limb.joints) {
    const model::Weld& parent = welds.at(joint.parent);  // in its body's frame
    chain.tip.p += chain.tip.R * (parent.p + parent.R * joint.p);
    chain.tip.R = (chain.tip.R * parent.R * joint.R).eval();
    chain.pitch.push_back((chain.tip.R * joint.axis).y());
    if (chain.pitch.size() == 1) chain.hip = chain.tip.p;
  }
  return chain;
}

bool may_be_leg(const Limb& limb) {
  return limb.is_chain && limb.joints.size() >= kLeastJoints && limb.joints.size() <= kMaxLegJoints;
}

bool are_alike(const Straight& a, const Straight& b) {
  const Vec3 p = a.tip.p, q = b.tip.p;
  return a.pitch.size() == b.pitch.size() && p.z() < 0.0 &&
         (p - q.cwiseProduct(Vec3(1.0, -1.0, 1.0))).norm() < kMostMismatch * std::abs(p.z());
}

/// Bent at hip, knee and ankle, where these are three pitch joints; else 0.
std::vector<double> bent(const Straight& chain) {
  std::vector<double> posture(chain.pitch.size(), 0.0);
  std::vector<std::size_t> pitches;
  for (std::size_t i = 0; i < posture.size(); ++i) {
    if (std::abs(chain.pitch[i]) > kPitchShare) pitches.push_back(i);
  }
  if (pitches.size() != kAngles.size()) return posture;
  for (std::size_t i = 0; i < pitches.size(); ++i)
    posture[pitches[i]] = std::copysign(1.0, chain.pitch[pitches[i]]) * kAngles[i];
  return posture;
}

/// A sphere has its lowest point alone.
std::vector<Vec3> points_of(const model::CollisionShape& shape, const model::Urdf& urdf) {
  if (shape.kind == "sphere") return {shape.center - shape.radius * Vec3::UnitZ()};
  return shape_points(shape, urdf);
}

/// The rectangle of what lies lowest on the foot's link.
Sole sole_of(const FlatLeg& leg, double length, const model::Urdf& urdf) {
  std::vector<Vec3> points;
  for (const model::CollisionShape& shape : model::collision_shapes(urdf)) {
    if (shape.link != leg.foot) continue;
    for (const Vec3& point : points_of(shape, urdf)) points.push_back(point);
  }
  Sole sole{.size = {0.25 * length, 0.1 * length}, .center = Vec3::Zero(), .is_guess = true};
  if (points.empty()) return sole;
  double lowest = kInfinity;
  for (const Vec3& point : points) lowest = std::min(lowest, point.z());
  Vec3 low = Vec3::Constant(kInfinity), high = -low;
  for (const Vec3& point : points) {
    if (point.z() > lowest + kSoleDepth * length) continue;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Vec2 size = (high - low).head<2>();
  if (!(size.minCoeff() > 0.0)) return sole;
  const Vec2 middle = 0.5 * (high + low).head<2>();
  return {.size = size, .center = {middle.x(), middle.y(), lowest}, .is_guess = false};
}

}  // namespace

void find_flat_legs(const model::Urdf& urdf, const std::vector<FoundLeg>& shorter,
                    Anatomy& anatomy) {
  std::vector<Straight> legs;
  for (const Limb& limb : anatomy.others) {
    if (may_be_leg(limb)) legs.push_back(straight(limb, anatomy.welds));
  }
  const auto depth = [](const Straight& leg) { return -leg.tip.p.z(); };
  std::ranges::stable_sort(legs, std::greater(), depth);
  if (legs.size() < 2 || !are_alike(legs[0], legs[1])) return;
  const double deep = kLegDepth * depth(legs[0]);
  const auto is_leg = [&](const FoundLeg& limb) { return -limb.tip.z() > deep; };
  const bool has_more = legs.size() > 2 && depth(legs[2]) > deep;
  if (has_more || std::ranges::any_of(shorter, is_leg)) return;
  if (legs[0].tip.p.y() < legs[1].tip.p.y()) std::swap(legs[0], legs[1]);
  FlatLegs found;
  for (const std::size_t side : {0u, 1u}) {
    const std::vector<model::UrdfJoint>& joints = legs[side].limb->joints;
    found.legs[side] = {.joints = joints,
                        .foot = joints.back().child,
                        .line = urdf.find_link(joints.back().child)->line,
                        .posture = bent(legs[side])};
  }
  found.length = (legs[1].hip - legs[1].tip.p).norm();
  found.sole = sole_of(found.legs[0], found.length, urdf);
  std::erase_if(anatomy.others, [&](const Limb& limb) {
    return std::ranges::any_of(found.legs, [&](const FlatLeg& leg) {
      return leg.joints.front().name == limb.joints.front().name;
    });
  });
  anatomy.flat_legs = std::move(found);
}

}  // namespace surefoot::doctor
