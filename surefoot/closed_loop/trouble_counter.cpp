#include "surefoot/closed_loop/trouble_counter.hpp"

#include "surefoot/logging/message_fields.hpp"
#include "surefoot/logging/stop_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::closed_loop {

/// Empty if an arm follows, or none is asked to.
std::string TroubleCounter::vain_reach(const TickRecord& record,
                                       const simulation::GroundTruth& truth) {
  constexpr double kArrived = 0.005, kAhead = 0.015, kOff = 0.03;  // [m]
  constexpr double kPatience = 1.0;                                // [s]
  const ReachCommand& command = record.user.reach;
  const auto arm = static_cast<std::size_t>(std::max(command.arm, 0));
  if (command.arm < 0) return "";
  const std::string name = "arm " + std::to_string(command.arm);
  if (arm >= truth.p_ST.size()) return "told to reach with " + name + ", which there is not";
  if (record.plan.arm.arm != command.arm) return "";
  const Quat to_base = record.state.q_WB.conjugate();
  const Vec3 target =
      command.in_world ? to_base * (command.position - record.state.p_WB) : command.position;
  const Vec3 planned = to_base * (record.plan.arm.p_WT - record.state.p_WB);
  const Vec3 tip = truth.q_SB.conjugate() * (truth.p_ST[arm] - truth.p_SB);
  const bool is_at_end = (planned - target).norm() < scale_.length * kArrived;
  const bool waits = (planned - tip).norm() > scale_.length * kAhead;  // for the tip
  const bool is_off = (is_at_end || waits) && (tip - target).norm() > scale_.length * kOff;
  if (!is_off) tip_since_ = kNaN;
  if (is_off && std::isnan(tip_since_)) tip_since_ = truth.time;
  return truth.time - tip_since_ > scale_.time() * kPatience ? name + ": can't get to its target"
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
