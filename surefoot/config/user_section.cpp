#include "surefoot/config/user_section.hpp"

namespace surefoot {
namespace {

constexpr NumberRange kHeight{.min = -UserCommand::kMostHeight,
                              .max = UserCommand::kMostHeight,
                              .words = "from -0.3 to 0.3 m"};
static_assert(UserCommand::kMostHeight == 0.3);

}  // namespace

void read_user(Section& top, std::vector<TimedCommand>& commands) {
  commands = {TimedCommand{}};
  const ConfigNode* list = top.node("user");
  if (list == nullptr) return;
  if (list->kind != ConfigNode::Kind::list)
    top.fail("user", "must be a list of commands, each with its time");
  for (const ConfigNode& item : list->items) {
    TimedCommand command;
    Section section(item, "user");
    section.require("time");
    section.number("time", command.time, kNotNegative);
    section.flag("walk", command.user.walk);
    section.vector("velocity", command.user.velocity);
    section.number("yaw_rate", command.user.yaw_rate);
    section.number("height", command.user.height, kHeight);
    section.flag("calibrate", command.user.calibrate);
    section.finish();
    if (command.time < commands.back().time)
      section.fail("time", "must not be before the command above");
    commands.push_back(command);
  }
}

}  // namespace surefoot
