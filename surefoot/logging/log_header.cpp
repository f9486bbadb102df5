#include "surefoot/logging/log_header.hpp"

#include "surefoot/logging/json_text.hpp"

namespace surefoot {
namespace {

template <typename Texts>
void list(JsonText& json, std::string_view name, const Texts& texts) {
  json.key(name).array();
  for (const std::string& text : texts) json.value(std::string_view(text));
  json.end_array();
}

void robot_member(JsonText& json, const LogRobot& robot) {
  json.key("robot").object().member("name", std::string_view(robot.name));
  list(json, "joint_names", robot.joint_names);
  json.key("torque_limit").array();
  for (const double limit : robot.torque_limit) json.value(limit);
  json.end_array();
  json.member("mass", robot.mass).member("foot_radius", robot.foot_radius).end_object();
}

}  // namespace

std::string to_json(const LogHeader& header) {
  std::string out;
  JsonText json(out);
  json.object()
      .member("log_version", kLogVersion)
      .member("version", std::string_view(header.version))
      .member("scenario", std::string_view(header.scenario))
      .member("stack", std::string_view(header.stack))
      .member("estimation", std::string_view(header.estimation))
      .member("seed", header.seed)
      .member("control_period", header.control_period);
  list(json, "level_names", header.level_names);
  list(json, "event_names", header.event_names);
  robot_member(json, header.robot);
  json.key("limb")
      .object()
      .member("level", header.limb.level)
      .member("form", std::string_view(header.limb.form));
  json.member("min", header.limb.min).member("max", header.limb.max).end_object();
  list(json, "notes", header.notes);
  json.key("options");
  if (header.options.empty()) {
    json.null();
  } else {
    json.raw(header.options);
  }
  json.end_object();
  return out;
}

}  // namespace surefoot
