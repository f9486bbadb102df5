#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/signals/motion_plan.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::tasks {

/// The joints that a task is for.
class ChosenJoints {
 public:
  static constexpr std::array<std::string_view, 6> kWords{"arms", "legs",      "further",
                                                          "all",  "idle_arms", "reaching_arm"};
  static constexpr std::string_view kHelp =
      "which joints: further ones are a leg's beside HAA, HFE and KFE; an arm is idle while it "
      "does "
      "not reach";

  struct Joint {
    int joint, arm;  // −1: of a leg
  };

  ChosenJoints() = default;
  /// `words`: one of `kWords`, or names of joints, separated by spaces. Throws Error without a
  /// name, UnknownNameError for unknown ones; both begin with the name of the task.
  ChosenJoints(std::string_view task, const std::string& words,
               const model::RobotDescription& robot);

  /// Reaching or not.
  [[nodiscard]] const std::vector<Joint>& all() const { return joints_; }

  /// Calls `write(joint)` for each while this arm reaches; −1: none.
  template <typename Write>
  void for_each(int reaching_arm, Write write) const {
    for (const auto& [joint, arm] : joints_) {
      const bool reaches = reaching_arm == arm;
      if (when_ == When::always || reaches == (when_ == When::reaches)) write(joint);
    }
  }

 private:
  enum class When { always, reaches, idle };

  When when_ = When::always;  // of a joint's arm
  std::vector<Joint> joints_;
};

}  // namespace surefoot::tasks
