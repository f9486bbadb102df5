#include "app/log_verification.hpp"

#include "app/interrupt.hpp"
#include "app/log_replay.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/logging/message_codec.hpp"

#include <cmath>

namespace surefoot {
namespace {

template <typename Signal>
bool same_message(const Signal& a, const Signal& b) {
  std::string first, second;
  logged::encode(a, first);
  logged::encode(b, second);
  return first == second;
}

void compare_torques(const TickRecord& logged, const TickRecord& computed, Verification& result) {
  for (int joint = 0; joint < kNumJoints; ++joint) {
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

void compare_messages(const TickRecord& logged, const TickRecord& computed, Verification& result) {
  const std::array same{
      same_message(logged.state, computed.state), same_message(logged.plan, computed.plan),
      same_message(logged.model, computed.model), same_message(logged.command, computed.command)};
  for (std::size_t i = 0; i < same.size(); ++i) {
    if (same[i]) continue;
    MessageDifferences& topic = result.messages[i];
    if (topic.ticks++ == 0) topic.first = logged.reading.time;
  }
}

}  // namespace

Verification verify_log(const std::string& path) {
  LogReplay replay(path, {.state = ReplayedState::estimated, .stack = {}});
  Verification result;
  result.header = replay.header();
  result.header.attachments.clear();
  result.estimated = replay.estimates();
  while (replay.step()) {
    if (interrupted()) throw Error("interrupted: nothing is said of the log");
    const TickRecord& logged = replay.logged();
    if (result.ticks == 0) result.first_time = logged.reading.time;
    result.last_time = logged.reading.time;
    if (!replay.is_same()) ++result.different_ticks;
    compare_torques(logged, replay.controller().record(), result);
    compare_messages(logged, replay.controller().record(), result);
    ++result.ticks;
  }
  result.problem = replay.problem();
  result.gap = replay.gap();
  result.may_go_on = replay.may_go_on();
  result.clock = replay.clock_skips();
  if (result.ticks == 0 && !result.gap)
    throw FileError(path + ": the log holds no tick, so there is nothing to run again" +
                    (result.problem.empty() ? "" : "; " + result.problem));
  return result;
}

}  // namespace surefoot
