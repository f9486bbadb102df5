#include "surefoot/logging/log_header.hpp"

#include "surefoot/logging/json_text.hpp"
#include "surefoot/logging/visible_residual.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace surefoot::logging {
namespace {

void robot_member(JsonText& json, const LogRobot& robot) {
  json.key("robot").object().member("name", std::string_view(robot.name));
  if (robot.num_legs != kNumLegs) {
    json.key("legs").array();
    for (const std::string_view leg : leg_names(robot.num_legs)) json.value(leg);
    json.end_array();
  }
  json.member("joint_names", robot.joint_names).key("torque_limit").array();
  for (const double limit : robot.torque_limit) json.value(limit);
  json.end_array();
  json.member("mass", robot.mass).member("foot_radius", robot.foot_radius);
  json.member("frame_names", robot.frame_names).end_object();
}

void numbers(JsonText& json, std::string_view name, const double* first, std::size_t count) {
  json.key(name).array();
  for (std::size_t i = 0; i < count; ++i) json.value(first[i]);
  json.end_array();
}

void drawn_member(JsonText& json, const std::vector<LogDraw>& drawn) {
  json.key("drawn").array();
  for (const LogDraw& draw : drawn) {
    json.object().member("path", std::string_view(draw.path)).member("value", draw.value);
    json.end_object();
  }
  json.end_array();
}

void terrain_member(JsonText& json, const std::vector<LogTerrain>& terrain) {
  json.key("terrain").array();
  for (const LogTerrain& piece : terrain) {
    const Quat& q = piece.q_SG;
    const std::array<double, 4> wxyz{q.w(), q.x(), q.y(), q.z()};
    json.object().member("shape", std::string_view(piece.shape));
    numbers(json, "position", piece.position.data(), 3);
    numbers(json, "q_SG", wxyz.data(), wxyz.size());
    numbers(json, "size", piece.size.data(), 3);
    json.member("columns", piece.columns).member("rows", piece.rows);
    numbers(json, "heights", piece.heights.data(), piece.heights.size());
    json.end_object();
  }
  json.end_array();
}

/// Major and minor number of a version.
std::pair<int, int> numbers_of(std::string_view version) {
  const std::size_t point = std::min(version.find('.'), version.size() - 1);
  return {std::atoi(std::string(version.substr(0, point)).c_str()),
          std::atoi(std::string(version.substr(point + 1)).c_str())};
}

constexpr double kLoadShare = 1.0 / 300.0;  // of the weight, on a loaded foot

}  // namespace

double LogRobot::least_load() const { return kLoadShare * assumed_mass() * kGravity; }

std::string LogRobot::frame_name(int number) const {
  const auto place = static_cast<std::size_t>(number);
  return number >= 0 && place < frame_names.size() ? frame_names[place]
                                                   : "frame " + std::to_string(number);
}

std::string level_name(const std::vector<std::string>& names, std::ptrdiff_t number) {
  const bool is_known = number >= 0 && number < std::ssize(names);
  return is_known ? names[static_cast<std::size_t>(number)] : "level " + std::to_string(number + 1);
}

bool LogHeader::is_older() const { return numbers_of(log_version) < numbers_of(kLogVersion); }

bool LogHeader::is_newer() const { return numbers_of(log_version) > numbers_of(kLogVersion); }

std::string LogHeader::level_name(std::ptrdiff_t number) const {
  return logging::level_name(level_names, number);
}

std::string LogHeader::level_unit(std::ptrdiff_t number) const {
  const bool is_known = number >= 0 && number < std::ssize(level_units);
  return is_known ? level_units[static_cast<std::size_t>(number)] : "";
}

double LogHeader::visible(std::ptrdiff_t number) const {
  const bool is_known = number >= 0 && number < std::ssize(level_visible);
  return is_known ? level_visible[static_cast<std::size_t>(number)]
                  : visible_residual(level_name(number), level_unit(number), Scale());
}

const std::string* LogHeader::attachment(std::string_view name) const {
  const auto found = std::ranges::find(attachments, name, &LogAttachment::name);
  return found == attachments.end() ? nullptr : &found->data;
}

std::string to_json(const LogHeader& header) {
  std::string out;
  JsonText json(out);
  json.object()
      .member("log_version", kLogVersion)
      .member("version", std::string_view(header.version))
      .member("commit", std::string_view(header.commit))
      .member("command", std::string_view(header.command))
      .member("scenario", std::string_view(header.scenario))
      .member("stack", std::string_view(header.stack))
      .member("description", std::string_view(header.description))
      .member("estimation", std::string_view(header.estimation))
      .member("seed", header.seed)
      .member("control_period", header.control_period);
  drawn_member(json, header.drawn);
  json.member("level_names", header.level_names).member("level_units", header.level_units);
  json.key("level_visible").array();
  for (std::ptrdiff_t k = 0; k < std::ssize(header.level_names); ++k) json.value(header.visible(k));
  json.end_array();
  json.member("event_names", header.event_names).member("own_parts", header.own_parts);
  robot_member(json, header.robot);
  json.key("limb")
      .object()
      .member("level", header.limb.level)
      .member("form", std::string_view(header.limb.form));
  json.member("min", header.limb.min).member("max", header.limb.max).end_object();
  terrain_member(json, header.terrain);
  json.member("notes", header.notes);
  json.key("options");
  if (header.options.empty()) {
    json.null();
  } else {
    json.raw(header.options);
  }
  json.end_object();
  return out;
}

}  // namespace surefoot::logging
