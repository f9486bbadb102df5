#include "surefoot/logging/stop_text.hpp"

#include "surefoot/logging/message_fields.hpp"

#include <algorithm>
#include <array>

namespace surefoot::logging {
namespace {

std::string verb(SampleFault fault) {
  switch (fault) {
    case SampleFault::none:
      return "failed";
    case SampleFault::silent:
      return "stopped";
    case SampleFault::late:
      return "came late";
    case SampleFault::not_a_number:
      return "gave no numbers";
    case SampleFault::out_of_range:
      return "left the range";
    case SampleFault::jump:
      return "changed too fast";
    case SampleFault::repeats:
      return "repeated";
    case SampleFault::contradicts:
      return "did not fit the rest";
  }
  return "";
}

/// A group is silent or late as a whole; other faults are of single values.
bool is_of_one_value(SampleFault fault) {
  return fault != SampleFault::none && fault != SampleFault::silent && fault != SampleFault::late;
}

std::string of_joint(const char* one, const char* all, SampleFault fault, int joint,
                     const std::vector<std::string>& joints) {
  if (joint >= 0 && joint < std::ssize(joints))
    return one + (" " + joints[static_cast<std::size_t>(joint)]);
  return all + std::string(is_of_one_value(fault) ? " of several joints" : "");
}

}  // namespace

std::string text_of_stop(StopCause cause, SampleFault fault, int joint,
                         const std::vector<std::string>& joints) {
  switch (cause) {
    case StopCause::none:
      return "";
    case StopCause::tilt:
      return "the torso tilted too far";
    case StopCause::failures:
      return "too many ticks without a solution";
    case StopCause::encoders:
      return of_joint("encoder", "encoders", fault, joint, joints) + " " + verb(fault);
    case StopCause::joint_torques:
      return of_joint("joint torque", "joint torques", fault, joint, joints) + " " + verb(fault);
    case StopCause::imu:
      return "IMU " + verb(fault);
    case StopCause::cannot_stand:
      return "it could not stand up";
    case StopCause::fallen:
      return "it fell";
    case StopCause::own_part:
      return "a part of your own failed";
  }
  return "";
}

std::string text_of_stop(const TickRecord& tick, const std::vector<std::string>& joints) {
  const JointCommand& command = tick.command;
  const GroupHealth* now = group_of(tick.health, command.cause);
  if (now == nullptr || command.fault != SampleFault::none)
    return text_of_stop(command.cause, command.fault, command.joint, joints);
  return text_of_stop(command.cause, now->fault, now->joint, joints);
}

std::string mode_text(CommandMode mode, std::string_view why) {
  const std::string name(logged::kModeNames[static_cast<std::size_t>(mode)]);
  return "command mode: " + name + (why.empty() ? "" : ", as " + std::string(why));
}

std::vector<std::string> stop_texts(const std::vector<std::string>& joints) {
  std::vector<std::string> all;
  const auto add = [&](const std::string& text) {
    if (std::ranges::find(all, text) == all.end()) all.push_back(text);
  };
  for (std::size_t cause = 0; cause < logged::kCauseNames.size(); ++cause)
    for (std::size_t fault = 0; fault < logged::kFaultNames.size(); ++fault)
      for (int joint = -1; joint < static_cast<int>(joints.size()); ++joint)
        add(text_of_stop(static_cast<StopCause>(cause), static_cast<SampleFault>(fault), joint,
                         joints));
  return all;
}

std::vector<FaultText> faults_of(const SensorHealth& health,
                                 const std::vector<std::string>& joints) {
  std::vector<FaultText> faults;
  for (const StopCause group : {StopCause::encoders, StopCause::joint_torques, StopCause::imu}) {
    const GroupHealth& now = *group_of(health, group);
    if (now.fault != SampleFault::none)
      faults.push_back({text_of_stop(group, now.fault, now.joint, joints), now.age});
  }
  return faults;
}

}  // namespace surefoot::logging
