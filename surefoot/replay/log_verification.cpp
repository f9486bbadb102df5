#include "surefoot/replay/log_verification.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/mcap_reader.hpp"
#include "surefoot/logging/message_codec.hpp"
#include "surefoot/replay/log_replay.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace surefoot::replay {
namespace {

using Json = nlohmann::json;

template <typename Signal>
std::string message_of(const Signal& signal) {
  std::string text;
  logged::encode(signal, text);
  return text;
}

/// A message without the members that `kind` lacks.
Json reduced(const Json& message, const Json& kind) {
  if (!message.is_object() || !kind.is_object()) return message;
  Json result = Json::object();
  for (const auto& [name, value] : message.items())
    if (kind.contains(name)) result[name] = reduced(value, kind.at(name));
  return result;
}

/// Compares messages; those of an older log only in the members that it has.
class MessageComparison {
 public:
  MessageComparison(const std::string& path, bool is_older) {
    if (!is_older) return;
    const TickRecord ours;
    logging::McapReader log(path);
    logging::McapMessage message;
    while (kinds_.size() < 4 && log.next(message)) {
      const std::string& topic = message.channel->topic;
      if (topic == "/state") learn(message, ours.state);
      if (topic == "/plan") learn(message, ours.plan);
      if (topic == "/model") learn(message, ours.model);
      if (topic == "/command") learn(message, ours.command);
    }
  }

  template <typename Signal>
  [[nodiscard]] bool is_same(const char* topic, const Signal& logged,
                             const Signal& computed) const {
    const std::string first = message_of(logged), second = message_of(computed);
    if (first == second) return true;
    const auto kind = kinds_.find(topic);
    if (kind == kinds_.end() || kind->second.is_null()) return false;
    return reduced(Json::parse(first), kind->second) == reduced(Json::parse(second), kind->second);
  }

 private:
  /// Keeps the first message of a topic; null if it lacks no member.
  template <typename Signal>
  void learn(const logging::McapMessage& message, const Signal& signal) {
    Json kind = Json::parse(message.data, nullptr, false);
    const Json ours = Json::parse(message_of(signal));
    if (reduced(ours, kind) == ours) kind = nullptr;
    kinds_.try_emplace(message.channel->topic, std::move(kind));
  }

  std::map<std::string, Json, std::less<>> kinds_;
};

void compare_torques(const TickRecord& logged, const TickRecord& computed, Verification& result) {
  for (int joint = 0;
       joint < std::min(logged.command.torque.size(), computed.command.torque.size()); ++joint) {
    const TorqueDifference found{result.ticks, logged.reading.time, joint,
                                 logged.command.torque[joint], computed.command.torque[joint]};
    if (same_bits(found.logged, found.computed)) continue;
    if (!result.first) result.first = found;
    const auto size = [](const TorqueDifference& one) {
      return std::abs(one.logged - one.computed);
    };
    if (!result.largest || size(found) > size(*result.largest)) result.largest = found;
  }
}

void compare_messages(const MessageComparison& comparison, const TickRecord& logged,
                      const TickRecord& computed, Verification& result) {
  const std::array same{comparison.is_same("/state", logged.state, computed.state),
                        comparison.is_same("/plan", logged.plan, computed.plan),
                        comparison.is_same("/model", logged.model, computed.model),
                        comparison.is_same("/command", logged.command, computed.command)};
  for (std::size_t i = 0; i < same.size(); ++i) {
    if (same[i]) continue;
    MessageDifferences& topic = result.messages[i];
    if (topic.ticks++ == 0) topic.first = logged.reading.time;
  }
}

}  // namespace

Verification verify_log(const std::string& path, const ReplayOptions& options,
                        const std::function<bool()>& stops) {
  LogReplay replay(path, options);
  const MessageComparison comparison(path, replay.header().is_older());
  Verification result;
  result.header = replay.header();
  result.header.attachments.clear();
  result.estimated = replay.estimates();
  result.played_back = replay.played_back();
  while (replay.step()) {
    if (stops()) throw Error("interrupted: nothing is said of the log");
    const TickRecord& logged = replay.logged();
    if (result.ticks == 0) result.first_time = logged.reading.time;
    result.last_time = logged.reading.time;
    if (!replay.is_same()) ++result.different_ticks;
    compare_torques(logged, replay.controller().record(), result);
    compare_messages(comparison, logged, replay.controller().record(), result);
    ++result.ticks;
  }
  result.fault = replay.controller().fault();
  result.problem = replay.problem();
  result.gap = replay.gap();
  result.may_go_on = replay.may_go_on();
  result.clock = replay.clock_skips();
  if (result.ticks == 0 && !result.gap)
    throw FileError(path + ": the log holds no tick, so there is nothing to run again" +
                    (result.problem.empty() ? "" : "; " + result.problem));
  return result;
}

}  // namespace surefoot::replay
