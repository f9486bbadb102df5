#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/mesh_vertices.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace surefoot::doctor {
namespace {

constexpr double kMostShape = 10.0;  // of a collision shape, in legs: it is in another unit

/// Of a shape about its link's origin; 0: not known [m].
double size_of(const model::CollisionShape& shape, const model::Urdf& urdf) {
  if (shape.mesh.empty()) return std::max({shape.radius, shape.size.maxCoeff(), shape.length});
  double size = 0.0;
  for (const Vec3& vertex : mesh_vertices(shape, urdf)) size = std::max(size, vertex.norm());
  return size;
}

}  // namespace

void check_shapes(Diagnosis& robot) {
  if (!robot.anatomy.legs) return;
  const FoundLeg& leg = (*robot.anatomy.legs)[0];
  const double most = kMostShape * (leg.thigh + leg.shank);
  std::vector<std::string> links;
  double largest = 0.0;
  for (const model::CollisionShape& shape : model::collision_shapes(robot.urdf)) {
    const double size = size_of(shape, robot.urdf);
    if (size <= most) continue;
    largest = std::max(largest, size);
    if (std::ranges::find(links, shape.link) == links.end()) links.push_back(shape.link);
  }
  if (links.empty()) return;
  std::string others;
  for (std::size_t i = 1; i < links.size(); ++i) others += " " + links[i];
  robot.findings.push_back(
      {Severity::error, Confidence::likely, "link \"" + links.front() + "\"",
       robot.urdf.find_link(links.front())->line,
       formatted("it collides with a shape of up to %.3g m, and the leg has %.3g m", largest,
                 leg.thigh + leg.shank) +
           (others.empty() ? "" : "; so it is with" + others),
       "are the sizes of <collision> in mm? Expected are m; a mesh in mm needs scale=\"0.001 0.001 "
       "0.001\"",
       true});
}

}  // namespace surefoot::doctor
