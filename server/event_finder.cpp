#include "server/event_finder.hpp"

#include "surefoot/logging/json_text.hpp"
#include "surefoot/logging/stop_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::server {
namespace {

/// The channel of this name; of size 0 where there is none.
ViewChannel find_channel(const ViewChannels& channels, std::string_view name) {
  const auto found = std::ranges::find(channels.channels, name, &ViewChannel::name);
  if (found != channels.channels.end()) return *found;
  ViewChannel none;
  none.size = 0;
  return none;
}

std::string_view name_in(const auto& names, float number) {
  const auto index = static_cast<std::size_t>(std::max(number, 0.0F));
  return index < names.size() ? names[index] : std::string_view("unknown");
}

}  // namespace

std::string text_event(double time, std::string_view kind, std::string_view text) {
  std::string out;
  logging::JsonText json(out);
  json.object().member("time", time).member("kind", kind).member("text", text).end_object();
  return out;
}

EventFinder::EventFinder(const ViewChannels& channels, std::vector<std::string> bodies)
    : num_legs_(channels.num_legs),
      mode_(find_channel(channels, "command.mode").offset),
      rotation_(find_channel(channels, "truth.q_SB").offset),
      stop_(find_channel(channels, "told.stop")),
      force_(find_channel(channels, "truth.xfrc_applied")),
      bodies_(std::move(bodies)),
      scenario_(bodies_) {}

const std::vector<std::string>& EventFinder::see(const ViewFrame& frame) {
  events_.clear();
  const std::vector<float>& now = frame.floats;
  const bool has_last = last_.size() == now.size();
  for (const FrameEvent& event : frame.events) {
    logging::JsonText json(events_.emplace_back());
    json.array().value(frame.time).value(event.kind);
    event.leg ? json.value(leg_name(*event.leg, num_legs_)) : json.null();
    json.end_array();
  }
  if (has_last && now[mode_] != last_[mode_]) {
    const auto mode = static_cast<CommandMode>(now[mode_]);
    events_.push_back(text_event(
        frame.time, "mode", logging::mode_text(mode, name_in(stop_.values, now[stop_.offset]))));
  }
  if (force_.size > 0) see_forces(frame);
  last_ = now;
  return events_;
}

void EventFinder::see_forces(const ViewFrame& frame) {
  const auto begin = frame.floats.begin() + static_cast<std::ptrdiff_t>(force_.offset);
  std::vector<double> xfrc(begin, begin + static_cast<std::ptrdiff_t>(force_.size));
  scenario_.leave(frame.time, xfrc);
  const float* q = &frame.floats[rotation_];
  const auto tell = [&](double time, const std::string& text) {
    events_.push_back(text_event(time, "force", text));
  };
  const auto changes = forces_.see(frame.time, xfrc, Quat(q[0], q[1], q[2], q[3]));
  for (const logging::AppliedForce& force : changes.begun)
    tell(force.from, logging::push_text(force, bodies_));
  for (const logging::AppliedForce& force : changes.ended)
    tell(force.to, logging::push_end_text(force, bodies_));
}

}  // namespace surefoot::server
