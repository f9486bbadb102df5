#include "surefoot/replay/replay_json.hpp"

#include "surefoot/logging/clock_text.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <utility>

namespace surefoot::replay {
namespace {

using OrderedJson = nlohmann::ordered_json;
using logging::to_nanosecond;

OrderedJson joint_json(const logging::LogHeader& header, const TorqueDifference& difference) {
  return {{"tick", difference.tick},
          {"time", difference.time},
          {"joint", header.robot.joint_names[static_cast<std::size_t>(difference.joint)]},
          {"logged", difference.logged},
          {"computed", difference.computed}};
}

OrderedJson gap_json(const LogGap& gap) {
  return {{"from", gap.from ? OrderedJson(to_nanosecond(*gap.from)) : OrderedJson(nullptr)},
          {"to", to_nanosecond(gap.to)},
          {"ticks_behind", gap.ticks_behind}};
}

OrderedJson log_json(const std::string& path, const logging::LogHeader& header) {
  return {{"log", path},           {"scenario", header.scenario}, {"seed", header.seed},
          {"stack", header.stack}, {"version", header.version},   {"commit", header.commit}};
}

/// `time`: of the largest; null without one.
OrderedJson difference_json(double rms, double largest, double time) {
  return {{"rms", rms},
          {"largest", largest},
          {"time", largest == 0.0 ? OrderedJson() : OrderedJson(to_nanosecond(time))}};
}

OrderedJson count_json(const TickCount& count) {
  OrderedJson json = {{"ticks", count.ticks}};
  if (count.ticks > 0) json["first"] = to_nanosecond(count.first);
  if (!count.why.empty()) json["why"] = count.why;
  return json;
}

}  // namespace

std::string json_of(const std::string& path, const Verification& result) {
  OrderedJson json = log_json(path, result.header);
  json["estimated"] = result.estimated;
  if (!result.played_back.empty()) json["played_back"] = result.played_back;
  json["ticks"] = result.ticks;
  json["first_time"] = result.first_time;
  json["last_time"] = result.last_time;
  if (result.is_same() && !result.is_all()) {
    json["same"] = nullptr;
  } else {
    json["same"] = result.is_same();
  }
  json["different_ticks"] = result.different_ticks;
  if (result.first) json["first"] = joint_json(result.header, *result.first);
  if (result.largest) json["largest"] = joint_json(result.header, *result.largest);
  json["different_messages"] = OrderedJson::object();
  for (const MessageDifferences& topic : result.messages)
    if (topic.ticks > 0)
      json["different_messages"][topic.topic] = {{"ticks", topic.ticks}, {"first", topic.first}};
  json["all_compared"] = result.is_all();
  logging::add_clock(result.clock, json);
  if (!result.fault.empty()) json["fault"] = result.fault;
  if (result.gap) json["gap"] = gap_json(*result.gap);
  if (!result.problem.empty()) json["problem"] = result.problem;
  return json.dump();
}

std::string json_of(const std::string& path, const StackComparison& result) {
  OrderedJson json = log_json(path, result.header);
  json["other"] = result.other;
  json["ticks"] = result.ticks;
  json["first_time"] = to_nanosecond(result.first_time);
  json["last_time"] = to_nanosecond(result.last_time);
  json["compared"] = result.compared;
  for (std::size_t i = 0; i < result.joints.size(); ++i) {
    const JointComparison& joint = result.joints[i];
    json["torque_difference"][result.header.robot.joint_names[i]] =
        difference_json(joint.rms, joint.largest, joint.time);
  }
  json["levels"] = OrderedJson::array();
  for (const LevelComparison& level : result.levels) {
    OrderedJson one = {{"name", level.name}, {"unit", level.unit}};
    if (level.in_log)
      one["logged"] = difference_json(level.logged_rms, level.logged_max, level.logged_time);
    if (level.in_other)
      one["other"] = difference_json(level.other_rms, level.other_max, level.other_time);
    json["levels"].push_back(std::move(one));
  }
  json["not_optimal"] = {{"logged", result.logged_not_optimal.ticks},
                         {"other", result.other_not_optimal.ticks}};
  json["unanswered"] = {{"logged", count_json(result.logged_unanswered)},
                        {"other", count_json(result.other_unanswered)}};
  json["not_asked"] = count_json(result.not_asked);
  json["other_stopped"] = count_json(result.other_stopped);
  json["not_reproduced"] = count_json(result.not_reproduced);
  if (result.walk_end)
    json["walk_end"] = {{"time", to_nanosecond(result.walk_end->time)},
                        {"why", result.walk_end->why}};
  json["logged_switches"] = result.logged_switches;
  if (result.gap) json["gap"] = gap_json(*result.gap);
  if (!result.problem.empty()) json["problem"] = result.problem;
  return json.dump();
}

}  // namespace surefoot::replay
