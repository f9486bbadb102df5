#include "surefoot/gaits/gait_choice.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>
#include <string>

namespace surefoot::gaits {
namespace {

constexpr double kHysteresis = 0.1;  // share of a limit within which the gait stays

}  // namespace

GaitChoice::GaitChoice(const PlannerOptions& own, const std::vector<NamedGait>& gaits, int first)
    : own_(own), first_(first) {
  for (const NamedGait& gait : gaits) {
    if (gait.options.gait.num_legs() != own.gait.num_legs())
      throw Error("gait \"" + gait.name + "\" is for " +
                  std::to_string(gait.options.gait.num_legs()) + " legs; the robot has " +
                  std::to_string(own.gait.num_legs()));
    gaits_.push_back(gait.options);
  }
  if (first_ >= size() || first_ < UserCommand::kAutoGait)
    throw Error("first gait is " + std::to_string(first_) + "; there are " +
                std::to_string(size()) + " gaits");
}

int GaitChoice::wanted(const UserCommand& user, int present) const {
  if (user.gait >= 0 && user.gait < size()) return user.gait;
  const bool is_auto = user.gait == UserCommand::kAutoGait ||
                       (user.gait == UserCommand::kOwnGait && first_ == UserCommand::kAutoGait);
  if (is_auto) return by_speed(foot_speed(user), present);
  return user.gait == UserCommand::kOwnGait ? first_ : present;
}

int GaitChoice::by_speed(double speed, int present) const {
  const auto limit = [&](int gait) { return gait < 0 ? 0.0 : options(gait).rhythm.chosen_to; };
  int fastest = UserCommand::kOwnGait, chosen = UserCommand::kOwnGait;
  double slower = 0.0;  // limit of the gait below the present one
  for (int gait = 0; gait < size(); ++gait) {
    if (limit(gait) > limit(fastest)) fastest = gait;
    if (limit(gait) < limit(present)) slower = std::max(slower, limit(gait));
    if (limit(gait) >= speed && limit(gait) > 0.0 && (chosen < 0 || limit(gait) < limit(chosen)))
      chosen = gait;
  }
  if (chosen < 0) chosen = fastest;
  const bool may_stay = limit(present) > 0.0 && speed >= (1.0 - kHysteresis) * slower;
  return may_stay && speed <= (1.0 + kHysteresis) * limit(present) ? present : chosen;
}

}  // namespace surefoot::gaits
