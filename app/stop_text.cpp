#include "app/stop_text.hpp"

namespace surefoot {
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
      return "repeated itself";
  }
  return "";
}

std::string joint_name(int joint) {
  const auto leg = static_cast<std::size_t>(joint / kJointsPerLeg);
  const auto one = static_cast<std::size_t>(joint % kJointsPerLeg);
  return std::string(kLegNames[leg]) + "_" + std::string(kJointNames[one]);
}

std::string text(const std::string& one, const std::string& all, const GroupHealth& group) {
  return (group.joint < 0 ? all : one + " " + joint_name(group.joint)) + " " + verb(group.fault);
}

}  // namespace

std::string text_of_stop(const TickRecord& tick) {
  switch (tick.command.cause) {
    case StopCause::none:
      return "";
    case StopCause::tilt:
      return "the torso tilted too far";
    case StopCause::failures:
      return "too many ticks without a solution";
    case StopCause::encoders:
      return text("encoder", "encoders", tick.health.encoders);
    case StopCause::joint_torques:
      return text("joint torque", "joint torques", tick.health.joint_torques);
    case StopCause::imu:
      return text("IMU", "IMU", tick.health.imu);
  }
  return "";
}

}  // namespace surefoot
