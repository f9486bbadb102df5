#pragma once

#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/signals/user_command.hpp"

#include <vector>

namespace surefoot::gaits {

/// The gaits that a planner was given, and which of them a command asks for. A gait is its place in
/// the list, or `UserCommand::kOwnGait` where there is no list.
class GaitChoice {
 public:
  GaitChoice(const PlannerOptions& own, const std::vector<NamedGait>& gaits, int first);

  /// For a command, in the present gait: the one that it names; where the speed decides, the
  /// slowest whose `chosen_to` it does not exceed, and the present one about its limits.
  [[nodiscard]] int wanted(const UserCommand& user, int present) const;
  /// Of the start, at rest.
  [[nodiscard]] int first() const { return wanted({}, first_); }

  /// Is it one of the list, or one of `UserCommand`'s own?
  [[nodiscard]] bool has(int gait) const { return gait >= UserCommand::kKeepGait && gait < size(); }
  [[nodiscard]] const PlannerOptions& options(int gait) const {
    return gait < 0 ? own_ : gaits_[static_cast<std::size_t>(gait)];
  }
  [[nodiscard]] int size() const { return static_cast<int>(gaits_.size()); }
  /// Speed of a foot relative to the torso [m/s].
  [[nodiscard]] double foot_speed(const UserCommand& user) const {
    return user.velocity.norm() + std::abs(user.yaw_rate) * own_.stance.half_length;
  }

 private:
  [[nodiscard]] int by_speed(double speed, int present) const;

  PlannerOptions own_;
  std::vector<PlannerOptions> gaits_;
  int first_;
};

}  // namespace surefoot::gaits
