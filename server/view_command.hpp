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

/// A command of a page, viewer/README.md. Members that its type lacks keep their defaults.
/// Numbers are finite, but otherwise unchecked.
struct ViewCommand {
  ViewCommandType type = ViewCommandType::pause;
  int ticks = 1;                      ///< of step
  double factor = 1.0;                ///< of speed, to real time
  std::string body{};                 ///< of push
  Vec3 impulse{0, 0, 0};              ///< of push, in S [N·s]
  double duration = 0.0;              ///< of push [s]
  bool by_scenario = false;           ///< of walk: the operator gives the command back
  bool walk = false;                  ///< of walk: the operator's command
  Vec2 velocity{0, 0};                ///< forward and lateral, in C [m/s]
  double yaw_rate = 0.0;              ///< [rad/s]
  double height = 0.0;                ///< [m]
  std::string gait{};                 ///< of walk: a name; empty: as before
  std::string level{};                ///< of gain
  std::string task{}, name{};         ///< of gain
  double value = 0.0;                 ///< of gain and friction
  std::vector<std::string> levels{};  ///< of order
};

/// A message of a page.
struct ViewMessage {
  std::int64_t id = 0;
  bool is_object = true;  ///< otherwise only `error` is set
  std::string token;
  bool is_hello = false;  ///< asks whether its token is known; no command
  bool is_drawn = false;  ///< the page has drawn the robot; no command, token or reply
  std::string error;      ///< what is wrong with it; empty: nothing
  ViewCommand command;
};

/// Reads a message. Does not throw: errors are in `error`.
[[nodiscard]] ViewMessage read_message(std::string_view text);

}  // namespace surefoot::server
