#include "surefoot/closed_loop/trouble_counter.hpp"

#include "surefoot/logging/message_fields.hpp"
#include "surefoot/logging/stop_text.hpp"
#include "surefoot/signals/joint_name.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::closed_loop {

namespace {

/// Of the plan's or the command's place in W or B.
Vec3 in_base(const Vec3& place, bool in_world, const RobotState& state) {
  return in_world ? Vec3(state.q_WB.conjugate() * (place - state.p_WB)) : place;
}

/// W is B.
RobotState with_base_at_rest(const JointVector& q) {
  RobotState state;
  state.p_WB = state.v_WB = state.w_WB_B = Vec3::Zero();
  state.q_WB = Quat::Identity();
  state.q = q;
  state.qd = JointVector::Zero(q.size());
  return state;
}

}  // namespace

TroubleCounter::TroubleCounter(const model::RobotDescription& robot)
    : joints_(told_joints(robot.joint_names(), robot.num_legs())),
      scale_(robot.scale),
      model_(robot),
      frames_(robot) {}

TroubleCounter::Reach TroubleCounter::arm_reach(const TickRecord& record,
                                                const simulation::GroundTruth& truth) const {
  const int number = record.user.reach.arm;
  const auto arm = static_cast<std::size_t>(number);
  Reach reach{.name = "arm " + std::to_string(number)};
  if (arm >= truth.p_ST.size()) {
    reach.why_not = "which there is not";
  } else if (record.plan.arm.arm == number) {
    reach.planned = in_base(record.plan.arm.p_WT, true, record.state);
    reach.is = truth.q_SB.conjugate() * (truth.p_ST[arm] - truth.p_SB);
  }
  return reach;
}

TroubleCounter::Reach TroubleCounter::frame_reach(const TickRecord& record,
                                                  const simulation::GroundTruth& truth) {
  const int number = record.user.reach.frame;
  if (number >= std::ssize(frames_.names()))
    return {.name = "frame " + std::to_string(number), .why_not = "which there is not"};
  Reach reach{.name = frames_.names()[static_cast<std::size_t>(number)]};
  const FramePlan* plan = record.plan.frames.find(number);
  if (plan == nullptr) {
    reach.why_not = "which no task follows";
    return reach;
  }
  reach.planned = in_base(plan->p_XF, plan->in_world, record.state);
  const model::Dynamics& dynamics = model_.update(with_base_at_rest(truth.q), Vec3::UnitZ());
  reach.is = frame_kinematics(frames_[number], dynamics).point.p;
  return reach;
}

/// Empty if what is told to reach follows, or nothing is.
std::string TroubleCounter::vain_reach(const TickRecord& record,
                                       const simulation::GroundTruth& truth) {
  constexpr double kArrived = 0.005, kAhead = 0.015, kOff = 0.03;  // [m]
  constexpr double kPatience = 1.0;                                // [s]
  const ReachCommand& command = record.user.reach;
  if (command.arm < 0 && command.frame < 0) {
    off_since_ = kNaN;
    return "";
  }
  const Reach reach = command.arm >= 0 ? arm_reach(record, truth) : frame_reach(record, truth);
  if (!reach.why_not.empty()) return "told to reach with " + reach.name + ", " + reach.why_not;
  const Vec3 target = in_base(command.position, command.in_world, record.state);
  const bool is_at_end = (reach.planned - target).norm() < scale_.length * kArrived;
  const bool waits = (reach.planned - reach.is).norm() > scale_.length * kAhead;  // for the tip
  const bool is_off = (is_at_end || waits) && (reach.is - target).norm() > scale_.length * kOff;
  if (!is_off) off_since_ = kNaN;
  if (is_off && std::isnan(off_since_)) off_since_ = truth.time;
  return truth.time - off_since_ > scale_.time() * kPatience
             ? reach.name + ": can't get to its target"
             : "";
}

void TroubleCounter::add(double time, const TickRecord& record,
                         const simulation::GroundTruth& truth) {
  std::vector<std::string> now;
  for (logging::FaultText& fault : logging::faults_of(record.health, joints_)) {
    if (std::isfinite(fault.age)) now.push_back(std::move(fault.text));
  }
  const CommandMode mode = record.command.mode;
  if (mode == CommandMode::sit || mode == CommandMode::damping) {
    now.push_back("command mode: " +
                  std::string(logged::kModeNames[static_cast<std::size_t>(mode)]));
  }
  std::string reach = vain_reach(record, truth);
  if (!reach.empty()) now.push_back(std::move(reach));
  for (const std::string& what : now) {
    if (std::ranges::find(before_, what) != before_.end()) continue;
    auto entry = std::ranges::find(counts_, what, &TroubleCount::what);
    if (entry == counts_.end()) {
      entry = counts_.insert(counts_.end(), {.what = what, .first = time});
    }
    ++entry->count;
  }
  before_ = std::move(now);
}

}  // namespace surefoot::closed_loop
