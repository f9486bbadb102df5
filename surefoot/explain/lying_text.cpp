#include "surefoot/explain/lying_text.hpp"

#include "surefoot/base/formatted.hpp"

#include <algorithm>
#include <functional>

namespace surefoot::explain {
namespace {

std::string parts_text(const GroundTouch& touch) {
  std::string legs;
  for (const Leg leg : touch.feet.legs()) {
    const bool touches = ((touch.shanks >> index(leg)) & 1) != 0;
    if (touches)
      legs += (legs.empty() ? "" : ", ") +
              std::string(leg_name(leg, static_cast<int>(touch.feet.size())));
  }
  std::string text = touch.torso ? "its torso" : "";
  if (!legs.empty()) text += (text.empty() ? "" : " and ") + ("thigh, knee or shank of " + legs);
  const bool is_another = text.empty() && touch.largest > 0.0;
  return is_another ? "another part than its feet" : text;
}

}  // namespace

void GroundTouch::see(const simulation::GroundTruth& truth) {
  feet.resize(static_cast<int>(truth.feet.size()));
  for (std::size_t k = 0; k < feet.size(); ++k) feet[k] = feet[k] || truth.feet[k].touching;
  torso = torso || truth.torso_contact;
  shanks |= truth.shank_contacts;
  largest = std::max(largest, truth.body_contact_force);
}

std::string lying_text(const GroundTouch& touch) {
  const bool stands = std::ranges::any_of(touch.feet, std::identity{});
  const std::string parts = parts_text(touch);
  if (parts.empty()) return stands ? "" : "nothing: it is in the air";
  return parts + (touch.largest > 0.0 ? formatted(", up to %.0f N on a part", touch.largest) : "") +
         (stands ? ", beside its feet" : "");
}

}  // namespace surefoot::explain
