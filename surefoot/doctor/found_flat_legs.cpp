#include "surefoot/doctor/found_flat_legs.hpp"

#include "surefoot/config/data_directory.hpp"
#include "surefoot/model/collision_shapes.hpp"
#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/mesh_points.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace surefoot::doctor {
namespace {

constexpr std::size_t kLeastJoints = kJointsPerLeg + 1;
constexpr double kAlike = 0.1;   // of the leg's length, from one foot to the other's mirror image
constexpr double kAsDeep = 0.8;  // of the lowest foot's depth: another leg, no arm
constexpr double kPitch = 0.9;   // share of an axis along y
constexpr double kAngles[] = {-0.3, 0.6,
                              -0.3};  // of hip, knee and ankle, so that the sole is level
constexpr double kSoleDepth = 0.02;   // of the leg's length, above the lowest point

/// A chain from the base at angles of zero.
struct Straight {
  std::vector<double> pitch;  // of each axis, along y of the base
  model::Weld tip;            // of the last link
  Vec3 hip = Vec3::Zero();
};

Straight straight(const Limb& limb, const std::map<std::string, model::Weld>& welds) {
  Straight chain;
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

bool are_alike(const Limb& a, const Limb& b, const std::map<std::string, model::Weld>& welds) {
  const Vec3 p = straight(a, welds).tip.p, q = straight(b, welds).tip.p;
  return a.joints.size() == b.joints.size() && p.z() < 0.0 &&
         (p - q.cwiseProduct(Vec3(1.0, -1.0, 1.0))).norm() < kAlike * std::abs(p.z());
}

/// Bent at hip, knee and ankle, where these are three pitch joints; else 0.
std::vector<double> bent(const Limb& limb, const Straight& chain) {
  std::vector<double> posture(limb.joints.size(), 0.0);
  std::vector<std::size_t> pitches;
  for (std::size_t i = 0; i < posture.size(); ++i) {
    if (std::abs(chain.pitch[i]) > kPitch) pitches.push_back(i);
  }
  if (pitches.size() != std::size(kAngles)) return posture;
  for (std::size_t i = 0; i < pitches.size(); ++i)
    posture[pitches[i]] = std::copysign(1.0, chain.pitch[pitches[i]]) * kAngles[i];
  return posture;
}

/// Points of a shape, in the link's frame; the lowest ones count.
std::vector<Vec3> points_of(const model::CollisionShape& shape, const model::Urdf& urdf) {
  std::vector<Vec3> points;
  if (!shape.mesh.empty()) {
    const model::MeshFolders folders{.packages = config::package_directories(),
                                     .urdf = std::filesystem::absolute(urdf.path).parent_path()};
    for (const Vec3& vertex : model::mesh_points(model::find_mesh(shape.mesh, folders)))
      points.push_back(shape.center + shape.R * vertex.cwiseProduct(shape.scale));
  } else if (shape.kind == "box") {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        for (const double z : {-0.5, 0.5})
          points.push_back(shape.center + shape.R * shape.size.cwiseProduct(Vec3(x, y, z)));
      }
    }
  } else if (shape.kind == "sphere") {
    points.push_back(shape.center - shape.radius * Vec3::UnitZ());
  }
  return points;
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

void find_flat_legs(const model::Urdf& urdf, Anatomy& anatomy) {
  std::vector<const Limb*> legs;
  for (const Limb& limb : anatomy.others) {
    if (may_be_leg(limb)) legs.push_back(&limb);
  }
  std::ranges::stable_sort(
      legs, {}, [&](const Limb* limb) { return straight(*limb, anatomy.welds).tip.p.z(); });
  if (legs.size() < 2 || !are_alike(*legs[0], *legs[1], anatomy.welds)) return;
  const auto depth = [&](const Limb* limb) { return -straight(*limb, anatomy.welds).tip.p.z(); };
  if (legs.size() > 2 && depth(legs[2]) > kAsDeep * depth(legs[0])) return;  // more than two legs
  const auto y_of = [&](const Limb* limb) { return straight(*limb, anatomy.welds).tip.p.y(); };
  if (y_of(legs[0]) < y_of(legs[1])) std::swap(legs[0], legs[1]);
  FlatLegs found;
  for (const std::size_t side : {0u, 1u}) {
    const Straight chain = straight(*legs[side], anatomy.welds);
    const std::string& foot = legs[side]->joints.back().child;
    found.legs[side] = {.joints = legs[side]->joints,
                        .foot = foot,
                        .line = urdf.find_link(foot)->line,
                        .posture = bent(*legs[side], chain)};
    found.length = (chain.hip - chain.tip.p).norm();
  }
  found.sole = sole_of(found.legs[0], found.length, urdf);
  const std::string first = legs[0]->joints[0].name, second = legs[1]->joints[0].name;
  std::erase_if(anatomy.others, [&](const Limb& limb) {
    return limb.joints[0].name == first || limb.joints[0].name == second;
  });
  anatomy.flat_legs = std::move(found);
}

std::vector<Limb> chains_of(const Limb& limb, const std::map<std::string, model::Weld>& welds) {
  std::vector<Limb> chains;
  const auto parent = [&](const model::UrdfJoint& joint) { return welds.at(joint.parent).body; };
  for (const model::UrdfJoint& joint : limb.joints) {
    if (joint.type != "revolute" && joint.type != "continuous") return {};
    const auto siblings = std::ranges::count_if(
        limb.joints, [&](const auto& other) { return parent(other) == parent(joint); });
    const bool goes_on =
        siblings == 1 && !chains.empty() && chains.back().joints.back().child == parent(joint);
    if (!goes_on) chains.push_back({.joints = {}, .no_leg = limb.no_leg, .is_chain = true});
    chains.back().joints.push_back(joint);
  }
  return chains;
}

}  // namespace surefoot::doctor
