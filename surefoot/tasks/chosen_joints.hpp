#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/signals/motion_plan.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::tasks {

/// The joints that a task is for.
class ChosenJoints {
 public:
  ChosenJoints() = default;
  /// `words`: `arms`, `legs`, `further` ones of legs, `all`, `idle_arms`, `reaching_arm`, or names,
  /// separated by spaces. Throws Error for other words, UnknownNameError for unknown names; both
  /// begin with the name of the task.
  ChosenJoints(std::string_view task, const std::string& words,
               const model::RobotDescription& robot);

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
  struct Joint {
    int joint, arm;
  };

  When when_ = When::always;  // of a joint's arm
  std::vector<Joint> joints_;
};

}  // namespace surefoot::tasks
