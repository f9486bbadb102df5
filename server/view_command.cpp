#include "server/view_command.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace surefoot::server {
namespace {

using Type = ViewCommandType;

/// What is wrong with a message.
struct BadMessage {
  std::string what;
};

constexpr std::array<std::pair<const char*, Type>, 10> kTypes{{{"pause", Type::pause},
                                                               {"resume", Type::resume},
                                                               {"step", Type::step},
                                                               {"speed", Type::speed},
                                                               {"reset", Type::reset},
                                                               {"push", Type::push},
                                                               {"walk", Type::walk},
                                                               {"gain", Type::gain},
                                                               {"order", Type::order},
                                                               {"friction", Type::friction}}};

template <typename T>
void read(const nlohmann::json& message, const char* key, T& value) {
  try {
    message.at(key).get_to(value);
  } catch (const nlohmann::json::exception&) {
    throw BadMessage{"\"" + std::string(key) + "\" is missing, or no value of its kind"};
  }
}

template <int n>
void read(const nlohmann::json& message, const char* key, Eigen::Matrix<double, n, 1>& vector) {
  std::array<double, n> numbers{};
  read(message, key, numbers);
  vector = Eigen::Map<const Eigen::Matrix<double, n, 1>>(numbers.data());
}

void read_ticks(const nlohmann::json& message, int& ticks) {
  double value = 0.0;
  read(message, "ticks", value);
  if (value < 1.0 || value > 1e6 || value != std::floor(value)) {
    throw BadMessage{"\"ticks\" must be a whole number from 1 to 1000000"};
  }
  ticks = static_cast<int>(value);
}

Type type_of(const nlohmann::json& message) {
  std::string given, valid;
  read(message, "type", given);
  for (const auto& [name, type] : kTypes) {
    if (given == name) return type;
    valid += " " + std::string(name);
  }
  throw BadMessage{"unknown type \"" + given.substr(0, 200) + "\"; valid are:" + valid};
}

void read_walk(const nlohmann::json& message, ViewCommand& command) {
  command.by_scenario = message.value("by", nlohmann::json()) == "scenario";
  if (command.by_scenario) return;
  read(message, "walk", command.walk);
  read(message, "velocity", command.velocity);
  read(message, "yaw_rate", command.yaw_rate);
  read(message, "height", command.height);
  if (message.contains("gait")) read(message, "gait", command.gait);
}

ViewCommand read_command(const nlohmann::json& message) {
  ViewCommand command;
  command.type = type_of(message);
  switch (command.type) {
    case Type::step:
      read_ticks(message, command.ticks);
      break;
    case Type::speed:
      read(message, "factor", command.factor);
      break;
    case Type::push:
      read(message, "body", command.body);
      read(message, "impulse", command.impulse);
      read(message, "duration", command.duration);
      break;
    case Type::walk:
      read_walk(message, command);
      break;
    case Type::gain:
      read(message, "level", command.level);
      read(message, "task", command.task);
      read(message, "name", command.name);
      read(message, "value", command.value);
      break;
    case Type::order:
      read(message, "levels", command.levels);
      break;
    case Type::friction:
      read(message, "value", command.value);
      break;
    case Type::pause:
    case Type::resume:
    case Type::reset:
      break;
  }
  return command;
}

}  // namespace

ViewMessage read_message(std::string_view text) {
  ViewMessage result;
  const nlohmann::json message = nlohmann::json::parse(text, nullptr, false);
  if (!message.is_object()) {
    result.is_object = false;
    result.error = "a message must be one JSON object, as text";
    return result;
  }
  const auto id = message.find("id");
  const bool has_id = id != message.end();
  if (has_id && id->is_number_integer()) result.id = id->get<std::int64_t>();
  const auto token = message.find("token");
  if (token != message.end() && token->is_string()) result.token = token->get<std::string>();
  try {
    if (has_id && !id->is_number_integer()) throw BadMessage{"`id` must be a whole number"};
    const nlohmann::json type = message.value("type", nlohmann::json());
    result.is_hello = type == "hello";
    result.is_drawn = type == "drawn";
    if (!result.is_hello && !result.is_drawn) result.command = read_command(message);
  } catch (const BadMessage& bad) {
    result.error = bad.what;
  }
  return result;
}

}  // namespace surefoot::server
