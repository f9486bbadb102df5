#include "app/operator_text.hpp"

#include "surefoot/base/formatted.hpp"

#include <cmath>
#include <utility>

namespace surefoot {
namespace {

constexpr double kTold = 0.38;  // share of a force that is told: less is within 22.5° of the others

std::string with(const std::string& amount, const logged::Change& change, double yaw) {
  const std::string direction = direction_text(change.force, yaw);
  return change.body + " with " + amount + (direction.empty() ? "" : " " + direction);
}

}  // namespace

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

bool ToldChanges::tells(const logged::Change& change) {
  if (change.kind != "pull") return true;
  const bool goes_on = std::exchange(is_pulled_, !change.force.isZero());
  const double passed = change.time - std::exchange(since_, change.time);
  const double before = std::exchange(force_, change.force.norm());
  given_ = goes_on ? given_ + before * passed : 0.0;
  return !goes_on || !is_pulled_;
}

std::string operator_text(const logged::Change& change, double yaw) {
  const double force = change.force.norm();
  if (change.kind == "push") {
    return "the operator pushes " +
           with(formatted("%.3g N·s", force * change.duration), change, yaw) +
           formatted(" (%.3g N", force) + formatted(" for %.3g s)", change.duration);
  }
  if (change.kind == "pull" && force > 0.0)
    return "the operator pulls " + with(formatted("%.3g N", force), change, yaw);
  if (change.kind == "friction" || change.kind == "stack") return change.text + ", by the operator";
  return change.text;
}

}  // namespace surefoot
