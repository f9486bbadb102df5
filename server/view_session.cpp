#include "server/view_session.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/logging/json_text.hpp"

#include <cstdlib>

namespace surefoot::server {
namespace {

constexpr int kProtocol = 2;

void limits_member(logging::JsonText& json, const ViewLimits& limits) {
  json.key("limits")
      .object()
      .member("push_newton_seconds", limits.push_impulse)
      .member("push_newtons", limits.push_force)
      .member("push_seconds", limits.push_duration)
      .member("walk_velocity", limits.walk_velocity)
      .member("walk_yaw_rate", limits.walk_yaw_rate)
      .member("walk_height", limits.walk_height)
      .member("friction_min", limits.friction_min)
      .member("friction_max", limits.friction_max);
  json.key("speeds").array();
  for (double speed = limits.slowest; speed <= limits.fastest; speed *= 2.0) json.value(speed);
  json.end_array().end_object();
}

void task_member(logging::JsonText& json, const ViewTask& task) {
  json.object()
      .member("level", task.level)
      .member("level_name", std::string_view(task.level_name))
      .member("task", std::string_view(task.task));
  json.key("numbers").array();
  for (const ViewNumber& number : task.numbers) {
    json.object()
        .member("name", std::string_view(number.name))
        .member("value", number.value)
        .member("unit", std::string_view(number.unit))
        .member("about", std::string_view(number.about))
        .member("min", number.min)
        .member("max", number.max)
        .end_object();
  }
  json.end_array().end_object();
}

void meshes_member(logging::JsonText& json, const std::vector<model::MeshFile>& meshes) {
  json.key("meshes").array();
  for (std::size_t id = 0; id < meshes.size(); ++id) {
    json.object()
        .member("id", id)
        .member("uri", std::string_view(meshes[id].uri))
        .member("found", !meshes[id].path.empty())
        .end_object();
  }
  json.end_array();
}

void levels_members(logging::JsonText& json, const ViewSession& session) {
  json.key("rows").array();
  for (const std::vector<std::string>& level : session.rows) json.value(level);
  json.end_array().key("orders").array();
  for (const ViewOrder& order : session.orders) {
    json.object().member("tick", order.tick).member("levels", order.levels).end_object();
  }
  json.end_array().key("tasks").array();
  for (const ViewTask& task : session.tasks) task_member(json, task);
  json.end_array();
}

}  // namespace

ViewLimits limits_for(const Scale& scale, double speed) {
  const auto in_two_digits = [](double number) {
    return std::strtod(formatted("%.2g", number).c_str(), nullptr);
  };
  constexpr double kFastTurn = 2.0;  // of a fast gait [rad/s]
  ViewLimits limits;
  limits.push_impulse = in_two_digits(limits.push_impulse * scale.of("N·s"));
  limits.push_force = in_two_digits(limits.push_force * scale.force());
  limits.walk_velocity = in_two_digits(limits.walk_velocity * scale.speed());
  limits.walk_yaw_rate = in_two_digits(limits.walk_yaw_rate * scale.rate());
  if (speed > limits.walk_velocity) {
    limits.walk_velocity = in_two_digits(speed);
    limits.walk_yaw_rate = in_two_digits(kFastTurn * scale.rate());
  }
  limits.walk_height = in_two_digits(limits.walk_height * scale.length);
  return limits;
}

std::string to_json(const ViewSession& session) {
  std::string out;
  logging::JsonText json(out);
  json.object()
      .member("protocol", kProtocol)
      .member("start", std::string_view(session.start))
      .member("mode", std::string_view(session.mode))
      .member("version", std::string_view(session.version))
      .member("title", std::string_view(session.title))
      .member("source", std::string_view(session.source))
      .member("cut", session.cut)
      .member("ended", session.ended)
      .member("period", session.period)
      .member("first_tick", session.first_tick)
      .member("ticks", session.ticks)
      .member("summarised", session.summarised)
      .member("generation", session.generation)
      .member("begun", session.begun)
      .member("frame_floats", session.channels.floats)
      .member("friction", session.friction);
  json.key("header").raw(session.header);
  json.key("channels").raw(to_json(session.channels.channels));
  levels_members(json, session);
  meshes_member(json, session.meshes);
  limits_member(json, session.limits);
  json.member("gaits", session.gaits);
  json.member("bodies", session.bodies).member("damage", session.damage).end_object();
  return out;
}

}  // namespace surefoot::server
