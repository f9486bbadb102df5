#include "surefoot/explain/operator_text.hpp"

#include "surefoot/base/formatted.hpp"

#include <cmath>

namespace surefoot::explain {
namespace {

constexpr double kMinShare = 0.38;  // of a force, along a direction that is named: sin 22.5°

/// Direction of a force in S, seen from the robot: "forwards and to the left"; empty if the force
/// or the heading is unknown.
std::string direction_text(const Vec3& force, double yaw) {
  const Vec3 seen = Eigen::AngleAxisd(-yaw, Vec3::UnitZ()) * force.normalized();
  if (!seen.allFinite() || force.isZero()) return "";
  std::string out;
  const auto add = [&](double share, const char* more, const char* less) {
    if (std::abs(share) < kMinShare) return;
    out += (out.empty() ? "" : " and ") + std::string(share > 0.0 ? more : less);
  };
  add(seen.x(), "forwards", "backwards");
  add(seen.y(), "to the left", "to the right");
  add(seen.z(), "upwards", "downwards");
  return out;
}

}  // namespace

std::string operator_text(const logged::Change& change, double yaw) {
  const double force = change.force.norm();
  if (change.kind == "push") {
    const std::string direction = direction_text(change.force, yaw);
    return "the operator pushes " + change.body + " with " +
           formatted("%.3g N·s", force * change.duration) +
           (direction.empty() ? "" : " " + direction) + formatted(" (%.3g N", force) +
           formatted(" for %.3g s)", change.duration);
  }
  if (change.kind == "friction" || change.kind == "stack") return change.text + ", by the operator";
  return change.text;
}

}  // namespace surefoot::explain
