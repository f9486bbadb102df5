#include "surefoot/logging/log_header_reader.hpp"

#include "surefoot/base/error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace surefoot::logging {
namespace {

using nlohmann::json;

/// A missing member of the header, or one of the wrong kind.
struct BadMember {
  std::string name;
};

double number(const json& value) { return value.is_null() ? kNaN : value.get<double>(); }

/// Parses a member.
auto member(const json& object, const char* name, const auto& parse) {
  try {
    return parse(object.at(name));
  } catch (const json::exception&) {
    throw BadMember{name};
  }
}

template <typename T>
T member(const json& object, const char* name) {
  return member(object, name, [](const json& value) { return value.get<T>(); });
}

double number_member(const json& object, const char* name) { return member(object, name, number); }

/// The names are those of two, four or six legs; logs of four don't name them.
int parse_num_legs(const json& robot) {
  if (!robot.contains("legs")) return kNumLegs;
  const auto names = member<std::vector<std::string>>(robot, "legs");
  for (const int num_legs : {2, kNumLegs, kMaxLegs})
    if (std::ranges::equal(names, leg_names(num_legs))) return num_legs;
  throw BadMember{"robot.legs"};
}

LogRobot parse_robot(const json& robot) {
  LogRobot result;
  result.name = member<std::string>(robot, "name");
  result.num_legs = parse_num_legs(robot);
  const auto names = member<json>(robot, "joint_names");
  const auto limits = member<json>(robot, "torque_limit");
  if (std::ssize(names) < kJointsPerLeg * result.num_legs || names.size() > kMaxJoints)
    throw BadMember{"robot.joint_names"};
  result.joint_names = names.get<std::vector<std::string>>();
  result.torque_limit.resize(static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    result.torque_limit[static_cast<Eigen::Index>(i)] = number(limits.at(i));
  }
  result.mass = number_member(robot, "mass");
  result.foot_radius = number_member(robot, "foot_radius");
  result.frame_names =
      robot.value("frame_names", std::vector<std::string>());  // older logs lack it
  return result;
}

template <int n>
Eigen::Matrix<double, n, 1> parse_vector(const json& list) {
  Eigen::Matrix<double, n, 1> result;
  for (int i = 0; i < n; ++i) result[i] = number(list.at(static_cast<std::size_t>(i)));
  return result;
}

LogTerrain parse_terrain(const json& piece) {
  const Eigen::Vector4d q = parse_vector<4>(piece.at(piece.contains("q_SG") ? "q_SG" : "q_WT"));
  return {.shape = piece.at("shape").get<std::string>(),
          .position = parse_vector<3>(piece.at("position")),
          .q_SG = Quat(q[0], q[1], q[2], q[3]),
          .size = parse_vector<3>(piece.at("size")),
          .columns = piece.at("columns").get<int>(),
          .rows = piece.at("rows").get<int>(),
          .heights = piece.at("heights").get<std::vector<double>>()};
}

// Members that older logs lack.
void parse_newer(const json& header, LogHeader& result) {
  result.commit = header.value("commit", "");
  result.command = header.value("command", "");
  result.description = header.value("description", "");
  result.own_parts = header.value("own_parts", std::vector<std::string>());
  result.level_units = header.value("level_units", std::vector<std::string>());
  result.level_units.resize(result.level_names.size());
  for (const json& residual : header.value("level_visible", json::array()))
    result.level_visible.push_back(number(residual));
  const json drawn = header.value("drawn", json::array());
  for (const json& draw : drawn) {
    result.drawn.push_back({draw.at("path").get<std::string>(), number(draw.at("value"))});
  }
  const json terrain = header.value("terrain", json::array());
  for (const json& piece : terrain) {
    result.terrain.push_back(parse_terrain(piece));
  }
}

LogLimbLimits parse_limb(const json& limb) {
  return {member<int>(limb, "level"), member<std::string>(limb, "form"), number_member(limb, "min"),
          number_member(limb, "max")};
}

LogHeader parse_header(const json& header) {
  LogHeader result;
  result.version = member<std::string>(header, "version");
  result.scenario = member<std::string>(header, "scenario");
  result.stack = member<std::string>(header, "stack");
  result.estimation = member<std::string>(header, "estimation");
  const json options = member<json>(header, "options");
  if (!options.is_null()) result.options = options.dump();
  result.seed = member<std::uint64_t>(header, "seed");
  result.control_period = number_member(header, "control_period");
  result.level_names = member<std::vector<std::string>>(header, "level_names");
  result.event_names = member<std::vector<std::string>>(header, "event_names");
  result.robot = member(header, "robot", parse_robot);
  result.limb = member(header, "limb", parse_limb);
  result.notes = member<std::vector<std::string>>(header, "notes");
  parse_newer(header, result);
  return result;
}

/// The JSON library recurses at each bracket: a header deeper than any of ours would overflow the
/// stack.
json parse_flat(const std::string& text) {
  constexpr int kMaxDepth = 100;
  return json::parse(text, [](int depth, json::parse_event_t, const json&) {
    if (depth > kMaxDepth) throw BadMember{"an end of its brackets"};
    return true;
  });
}

std::string_view major_of(std::string_view version) { return version.substr(0, version.find('.')); }

}  // namespace

LogHeader read_log_header(const std::string& path, const std::string& text) {
  const auto refuse = [&](const std::string& what) -> LogHeader {
    throw FileError(path + ": its header.json, which says what run it is, " + what +
                    "; the messages in it can be read by other readers of MCAP, but not by "
                    "surefoot: record the run anew");
  };
  try {
    const json header = parse_flat(text);
    const auto version = member<std::string>(header, "log_version");
    const std::string_view major = major_of(version);
    if (major != "2" && major != major_of(kLogVersion)) {
      throw FileError(path + ": log version " + version +
                      "; this program reads 2.x and 3.x. Read it with the version of surefoot that "
                      "made it, or record the run anew");
    }
    LogHeader result = parse_header(header);
    result.log_version = version;
    return result;
  } catch (const json::parse_error& error) {
    return refuse("is damaged at its byte " + std::to_string(error.byte) + " of " +
                  std::to_string(text.size()));
  } catch (const BadMember& member) {
    return refuse("lacks " + member.name + ", or has something else in its place");
  } catch (const json::exception&) {
    return refuse("has something else in the place of a part of it");
  }
}

}  // namespace surefoot::logging
