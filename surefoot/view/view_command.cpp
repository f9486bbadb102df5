#include "surefoot/view/view_command.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace surefoot {
namespace {

using nlohmann::json;
using Type = ViewCommandType;

/// What is wrong with a message.
struct BadMessage {
  std::string what;
};

constexpr std::array<std::pair<const char*, Type>, 12> kTypes{{{"pause", Type::pause},
                                                               {"resume", Type::resume},
                                                               {"step", Type::step},
                                                               {"speed", Type::speed},
                                                               {"reset", Type::reset},
                                                               {"push", Type::push},
                                                               {"pull", Type::pull},
                                                               {"walk", Type::walk},
                                                               {"gain", Type::gain},
                                                               {"order", Type::order},
                                                               {"friction", Type::friction},
                                                               {"undo", Type::undo}}};
constexpr std::size_t kLongestName = 200;
constexpr std::size_t kMostNames = 64;

const json& member(const json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end()) throw BadMessage{"\"" + std::string(key) + "\" is missing"};
  return *found;
}

double number(const json& value, const char* key) {
  const double result = value.is_number() ? value.get<double>() : std::nan("");
  if (!std::isfinite(result)) throw BadMessage{"\"" + std::string(key) + "\" must be a number"};
  return result;
}

double number_of(const json& message, const char* key) { return number(member(message, key), key); }

std::string text(const json& value, const char* key) {
  if (!value.is_string() || value.get_ref<const std::string&>().size() > kLongestName) {
    throw BadMessage{"\"" + std::string(key) + "\" must be a text of at most 200 letters"};
  }
  return value.get<std::string>();
}

std::string text_of(const json& message, const char* key) {
  return text(member(message, key), key);
}

template <int n>
Eigen::Matrix<double, n, 1> vector_of(const json& message, const char* key) {
  const json& list = member(message, key);
  if (!list.is_array() || list.size() != static_cast<std::size_t>(n)) {
    throw BadMessage{"\"" + std::string(key) + "\" must be a list of " + std::to_string(n) +
                     " numbers"};
  }
  Eigen::Matrix<double, n, 1> result;
  for (int i = 0; i < n; ++i) result[i] = number(list[static_cast<std::size_t>(i)], key);
  return result;
}

bool truth_of(const json& message, const char* key) {
  const json& value = member(message, key);
  if (!value.is_boolean()) throw BadMessage{"\"" + std::string(key) + "\" must be true or false"};
  return value.get<bool>();
}

int count_of(const json& message, const char* key) {
  const double value = number_of(message, key);
  if (value < 1.0 || value > 1e6 || value != std::floor(value)) {
    throw BadMessage{"\"" + std::string(key) + "\" must be a whole number from 1 to 1000000"};
  }
  return static_cast<int>(value);
}

Type type_of(const json& message) {
  const std::string given = text_of(message, "type");
  std::string valid;
  for (const auto& [name, type] : kTypes) {
    if (given == name) return type;
    valid += " " + std::string(name);
  }
  throw BadMessage{"unknown type \"" + given + "\"; valid are:" + valid};
}

void read_walk(const json& message, ViewCommand& command) {
  command.by_scenario = message.contains("by") && text_of(message, "by") == "scenario";
  if (command.by_scenario) return;
  command.walk = truth_of(message, "walk");
  command.velocity = vector_of<2>(message, "velocity");
  command.yaw_rate = number_of(message, "yaw_rate");
  command.height = number_of(message, "height");
}

void read_order(const json& message, ViewCommand& command) {
  const json& levels = member(message, "levels");
  if (!levels.is_array() || levels.size() > kMostNames) {
    throw BadMessage{"\"levels\" must be a list of names"};
  }
  for (const json& level : levels) command.levels.push_back(text(level, "levels"));
  if (message.contains("level")) command.level = text_of(message, "level");
}

void read_push(const json& message, ViewCommand& command) {
  command.body = text_of(message, "body");
  command.impulse = vector_of<3>(message, "impulse");
  command.duration = number_of(message, "duration");
}

void read_pull(const json& message, ViewCommand& command) {
  command.body = text_of(message, "body");
  command.point = vector_of<3>(message, "point");
  command.force = vector_of<3>(message, "force");
}

void read_gain(const json& message, ViewCommand& command) {
  command.level = text_of(message, "level");
  command.task = text_of(message, "task");
  command.name = text_of(message, "name");
  command.value = number_of(message, "value");
}

ViewCommand read_command(const json& message) {
  ViewCommand command;
  command.type = type_of(message);
  switch (command.type) {
    case Type::step:
      command.ticks = count_of(message, "ticks");
      break;
    case Type::speed:
      command.factor = number_of(message, "factor");
      break;
    case Type::push:
      read_push(message, command);
      break;
    case Type::pull:
      read_pull(message, command);
      break;
    case Type::walk:
      read_walk(message, command);
      break;
    case Type::gain:
      read_gain(message, command);
      break;
    case Type::order:
      read_order(message, command);
      break;
    case Type::friction:
      command.value = number_of(message, "value");
      break;
    case Type::pause:
    case Type::resume:
    case Type::reset:
    case Type::undo:
      break;
  }
  return command;
}

}  // namespace

ViewMessage read_message(std::string_view text) {
  ViewMessage result;
  const json message = json::parse(text, nullptr, false);
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
    const json type = message.value("type", json());
    result.is_hello = type == "hello";
    result.is_drawn = type == "drawn";
    if (!result.is_hello && !result.is_drawn) result.command = read_command(message);
  } catch (const BadMessage& bad) {
    result.error = bad.what;
  }
  return result;
}

}  // namespace surefoot
