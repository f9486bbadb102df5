#include "surefoot/replay/walk_end.hpp"

#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/message_decoder.hpp"
#include "surefoot/logging/stop_text.hpp"

#include <algorithm>

namespace surefoot::replay {

void WalkEndWatch::see(const logging::McapMessage& message) {
  if (message.channel->topic != "/truth") return;
  simulation::GroundTruth truth;
  logged::Decoder::decode(message.data, truth, kMaxLegs);  // any that touches
  if (!torso_down_ && was_torso_up_ && truth.torso_contact) torso_down_ = truth.time;
  was_torso_up_ = !truth.torso_contact;
  if (std::ranges::any_of(truth.feet, &simulation::TrueContact::touching))
    feet_up_.reset();
  else if (!feet_up_)
    feet_up_ = truth.time;
}

void WalkEndWatch::see(const TickRecord& tick, const std::vector<std::string>& joints) {
  if (stop_ || tick.command.cause == StopCause::none) return;
  stop_ = {tick.reading.time,
           "its controller stopped for safety: " + logging::text_of_stop(tick, joints)};
}

std::optional<WalkEnd> WalkEndWatch::end() const {
  std::optional<WalkEnd> first = stop_;
  const auto ends = [&first](const std::optional<double>& time, const char* why) {
    if (time && !(first && first->time <= *time)) first = {*time, why};
  };
  ends(torso_down_, "its torso came to the ground");
  ends(feet_up_, "no foot touched the ground any more");
  return first;
}

}  // namespace surefoot::replay
