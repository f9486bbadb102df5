#include "app/event_finder.hpp"

#include "surefoot/evaluation/event_counter.hpp"
#include "surefoot/logging/json_text.hpp"

#include <algorithm>

namespace surefoot {
namespace {

std::size_t offset_of(const ViewChannels& channels, std::string_view name) {
  const auto found = std::ranges::find(channels.channels, name, &ViewChannel::name);
  return found == channels.channels.end() ? 0 : found->offset;
}

std::string_view name_in(const auto& names, float number) {
  const auto index = static_cast<std::size_t>(std::max(number, 0.0F));
  return index < names.size() ? names[index] : std::string_view("unknown");
}

}  // namespace

std::string text_event(double time, std::string_view kind, std::string_view text) {
  std::string out;
  JsonText(out)
      .object()
      .member("time", time)
      .member("kind", kind)
      .member("text", text)
      .end_object();
  return out;
}

EventFinder::EventFinder(const ViewChannels& channels)
    : event_(offset_of(channels, "plan.event")),
      mode_(offset_of(channels, "command.mode")),
      cause_(offset_of(channels, "command.cause")) {
  for (const Leg leg : kLegs) {
    const std::string name(kLegNames[index(leg)]);
    phases_[index(leg)] = offset_of(channels, "plan.feet." + name + ".phase");
  }
}

PerLeg<LegPhase> EventFinder::phases(const std::vector<float>& floats) const {
  PerLeg<LegPhase> phases{};
  for (std::size_t k = 0; k < phases_.size(); ++k)
    phases[k] = static_cast<LegPhase>(std::max(floats[phases_[k]], 0.0F));
  return phases;
}

void EventFinder::see(const ViewFrame& frame, std::vector<std::string>& events) {
  const std::vector<float>& now = frame.floats;
  const bool has_last = last_.size() == now.size();
  if (now[event_] != 0.0F) {
    const auto event = static_cast<PlanEvent>(now[event_]);
    const std::optional<Leg> leg =
        has_last ? leg_of(event, phases(last_), phases(now)) : std::nullopt;
    std::string& text = events.emplace_back();
    JsonText json(text);
    json.array().value(frame.time).value(static_cast<int>(event));
    leg ? json.value(kLegNames[index(*leg)]) : json.null();
    json.end_array();
  }
  if (has_last && now[mode_] != last_[mode_]) {
    std::string text = "command mode: " + std::string(name_in(logged::kModeNames, now[mode_]));
    if (now[cause_] != 0.0F) {
      text += ", cause: " + std::string(name_in(logged::kCauseNames, now[cause_]));
    }
    events.push_back(text_event(frame.time, "mode", text));
  }
  last_ = now;
}

}  // namespace surefoot
