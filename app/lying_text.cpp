#include "app/lying_text.hpp"

#include "surefoot/base/formatted.hpp"

#include <algorithm>

namespace surefoot {
namespace {

std::string parts_text(const GroundTruth& truth) {
  std::string legs;
  for (const Leg leg : kLegs) {
    const bool touches = ((truth.shank_contacts >> index(leg)) & 1) != 0;
    if (touches) legs += (legs.empty() ? "" : ", ") + std::string(kLegNames[index(leg)]);
  }
  std::string text = truth.torso_contact ? "its torso" : "";
  if (!legs.empty()) text += (text.empty() ? "" : " and ") + ("thigh, knee or shank of " + legs);
  const bool is_another = text.empty() && truth.body_contact_force > 0.0;
  return is_another ? "another part than its feet" : text;
}

}  // namespace

std::string lying_text(const GroundTruth& truth) {
  const bool stands = std::ranges::any_of(truth.feet, &TrueContact::touching);
  const std::string parts = parts_text(truth);
  if (parts.empty()) return stands ? "" : "nothing at this tick";
  const double most = truth.body_contact_force;
  return parts + (most > 0.0 ? formatted(", up to %.0f N on a part", most) : "") +
         (stands ? ", beside its feet" : "");
}

}  // namespace surefoot
