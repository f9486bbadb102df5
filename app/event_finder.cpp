#include "app/event_finder.hpp"

#include "surefoot/evaluation/event_counter.hpp"
#include "surefoot/logging/json_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot {
namespace {

std::size_t offset_of(const ViewChannels& channels, std::string_view name) {
  const auto found = std::ranges::find(channels.channels, name, &ViewChannel::name);
  return found == channels.channels.end() ? 0 : found->offset;
}

std::size_t size_of(const ViewChannels& channels, std::string_view name) {
  const auto found = std::ranges::find(channels.channels, name, &ViewChannel::name);
  return found == channels.channels.end() ? 0 : found->size;
}

constexpr double kSameTime = 0.01;  // a force acts from the tick behind the change on [s]

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

EventFinder::EventFinder(const ViewChannels& channels, std::vector<std::string> bodies)
    : event_(offset_of(channels, "plan.event")),
      mode_(offset_of(channels, "command.mode")),
      cause_(offset_of(channels, "command.cause")),
      force_(offset_of(channels, "truth.xfrc_applied")),
      force_size_(size_of(channels, "truth.xfrc_applied")),
      rotation_(offset_of(channels, "truth.q_WB")),
      bodies_(std::move(bodies)) {
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
  if (force_size_ > 0) see_forces(frame, events);
  last_ = now;
}

void EventFinder::acts(const logged::Change& change) {
  if (change.kind != "push" && change.kind != "pull") return;
  told_.push_back(change.time);
  if (change.kind == "push") told_.push_back(change.time + change.duration);
}

bool EventFinder::is_told(double time) const {
  return std::ranges::any_of(told_, [&](double told) { return std::abs(told - time) < kSameTime; });
}

void EventFinder::see_forces(const ViewFrame& frame, std::vector<std::string>& events) {
  const auto begin = frame.floats.begin() + static_cast<std::ptrdiff_t>(force_);
  const std::vector<double> xfrc(begin, begin + static_cast<std::ptrdiff_t>(force_size_));
  const float* q = &frame.floats[rotation_];
  const auto changes = forces_.see(frame.time, xfrc, Quat(q[0], q[1], q[2], q[3]));
  for (const AppliedForce& force : changes.begun) {
    if (is_told(force.from)) continue;
    events.push_back(
        text_event(force.from, "force", "pushed by " + applied_force_text(force, bodies_)));
  }
  for (const AppliedForce& force : changes.ended) {
    if (is_told(force.to)) continue;
    events.push_back(
        text_event(force.to, "force", "the push on " + body_text(force.body, bodies_) + " ends"));
  }
  std::erase_if(told_, [&](double told) { return told < frame.time - 1.0; });
}

}  // namespace surefoot
