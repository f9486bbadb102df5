#pragma once

#include "surefoot/signals/user_command.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

enum class ViewCommandType {
  pause,
  resume,
  step,
  speed,
  reset,
  push,
  walk,
  gain,
  order,
  friction,
};

/// What a page asks for, docs/view_protocol.md. Members that its type does not have keep their
/// defaults; numbers are finite, and not checked otherwise.
struct ViewCommand {
  ViewCommandType type = ViewCommandType::pause;
  int ticks = 1;                      ///< of step
  double factor = 1.0;                ///< of speed, to real time
  std::string body{};                 ///< of push
  Vec3 impulse{0, 0, 0};              ///< of push, in W [N·s]
  double duration = 0.0;              ///< of push [s]
  bool by_scenario = false;           ///< of walk: the operator gives the command back
  bool walk = false;                  ///< of walk: the operator's command
  Vec2 velocity{0, 0};                ///< forward and lateral, in C [m/s]
  double yaw_rate = 0.0;              ///< [rad/s]
  double height = 0.0;                ///< [m]
  std::string level{};                ///< of gain
  std::string task{}, name{};         ///< of gain
  double value = 0.0;                 ///< of gain and friction
  std::vector<std::string> levels{};  ///< of order
};

/// A message of a page, with what its sender must know.
struct ViewMessage {
  std::int64_t id = 0;
  bool is_object = true;  ///< otherwise nothing else of it is known than `error`
  std::string token;
  bool is_hello = false;  ///< it asks only whether its token is known; without a command
  bool is_drawn = false;  ///< the page has drawn the robot; without a command, token or reply
  std::string error;      ///< what is wrong with the rest of it; empty: nothing
  ViewCommand command;
};

/// Reads a message. Throws nothing: what is wrong is in `error`.
[[nodiscard]] ViewMessage read_message(std::string_view text);

}  // namespace surefoot::server
