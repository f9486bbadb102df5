#include "surefoot/explain/operator_text.hpp"

#include "surefoot/base/formatted.hpp"

#include <cmath>

namespace surefoot::explain {
namespace {

constexpr double kTold = 0.38;  // share of a force that is told: less is within 22.5° of the others

/// Where a force in W goes as the robot sees it: "forwards and to the left"; empty where it or the
/// heading is not known.
std::string direction_text(const Vec3& force, double yaw) {
  const Vec3 seen = Eigen::AngleAxisd(-yaw, Vec3::UnitZ()) * force.normalized();
  if (!seen.allFinite() || force.isZero()) return "";
  std::string out;
  const auto tell = [&](double share, const char* more, const char* less) {
    if (std::abs(share) < kTold) return;
    out += (out.empty() ? "" : " and ") + std::string(share > 0.0 ? more : less);
  };
  tell(seen.x(), "forwards", "backwards");
  tell(seen.y(), "to the left", "to the right");
  tell(seen.z(), "upwards", "downwards");
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
