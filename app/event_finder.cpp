#include "app/event_finder.hpp"

#include "app/stop_text.hpp"
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

std::string_view name_in(const auto& names, float number) {
  const auto index = static_cast<std::size_t>(std::max(number, 0.0F));
  return index < names.size() ? names[index] : std::string_view("unknown");
}

}  // namespace

std::optional<ForceMark> force_mark(const logged::Change& change, double given) {
  if (change.kind == "push")
    return ForceMark{.kind = "push", .body = change.body, .duration = change.duration};
  if (change.kind != "pull") return std::nullopt;
  const bool begins = !change.force.isZero();
  return ForceMark{
      .kind = "pull", .body = change.body, .begins = begins, .given = begins ? kNaN : given};
}

void force_member(JsonText& json, const std::optional<ForceMark>& force) {
  if (!force) return;
  json.key("force").object().member("kind", force->kind).member("body", force->body);
  json.member("begins", force->begins);
  if (!std::isnan(force->duration)) json.member("duration", force->duration);
  if (!std::isnan(force->given)) json.member("given", force->given);
  json.end_object();
}

std::string text_event(double time, std::string_view kind, std::string_view text,
                       const std::optional<ForceMark>& force) {
  std::string out;
  JsonText json(out);
  json.object().member("time", time).member("kind", kind).member("text", text);
  force_member(json, force);
  json.end_object();
  return out;
}

EventFinder::EventFinder(const ViewChannels& channels, std::vector<std::string> bodies)
    : mode_(offset_of(channels, "command.mode")),
      cause_(offset_of(channels, "command.cause")),
      then_{offset_of(channels, "command.fault"), offset_of(channels, "command.joint")},
      force_(offset_of(channels, "truth.xfrc_applied")),
      force_size_(size_of(channels, "truth.xfrc_applied")),
      rotation_(offset_of(channels, "truth.q_WB")),
      bodies_(std::move(bodies)),
      scenario_(bodies_) {
  for (std::size_t cause = 0; cause < faults_.size(); ++cause) {
    const std::string group = "health." + std::string(logged::kCauseNames[cause]);
    faults_[cause] = {offset_of(channels, group + ".fault"), offset_of(channels, group + ".joint")};
  }
}

const std::vector<FoundEvent>& EventFinder::see(const ViewFrame& frame) {
  events_.clear();
  const std::vector<float>& now = frame.floats;
  const bool has_last = last_.size() == now.size();
  for (const FrameEvent& event : frame.events) {
    JsonText json(events_.emplace_back().text);
    json.array().value(frame.time).value(event.kind);
    event.leg ? json.value(kLegNames[index(*event.leg)]) : json.null();
    json.end_array();
  }
  if (has_last && now[mode_] != last_[mode_]) {
    std::string text = "command mode: " + std::string(name_in(logged::kModeNames, now[mode_]));
    if (const std::string why = why_stopped(now); !why.empty()) text += ", as " + why;
    events_.push_back({text_event(frame.time, "mode", text), std::nullopt});
  }
  if (force_size_ > 0) see_forces(frame);
  last_ = now;
  return events_;
}

std::string EventFinder::why_stopped(const std::vector<float>& floats) const {
  const auto number = [&](std::size_t offset) { return static_cast<int>(floats[offset]); };
  const auto cause = static_cast<std::size_t>(std::max(floats[cause_], 0.0F));
  if (cause >= faults_.size()) return "unknown";
  const bool is_group = faults_[cause].fault != 0, is_told = floats[then_.fault] > 0.0F;
  const FaultOffsets& at = is_told ? then_ : faults_[cause];  // logs before 2.8 know only now
  return text_of_stop(static_cast<StopCause>(cause),
                      static_cast<SampleFault>(is_group ? number(at.fault) : 0),
                      is_group ? number(at.joint) : -1);
}

void EventFinder::see_forces(const ViewFrame& frame) {
  const auto begin = frame.floats.begin() + static_cast<std::ptrdiff_t>(force_);
  std::vector<double> xfrc(begin, begin + static_cast<std::ptrdiff_t>(force_size_));
  scenario_.leave(frame.time, xfrc);
  const float* q = &frame.floats[rotation_];
  const auto tell = [&](double time, const std::string& text, std::size_t body, bool begins) {
    const std::string_view name = body < bodies_.size() ? bodies_[body] : std::string_view();
    const ForceMark mark{.kind = "scenario", .body = name, .begins = begins};
    events_.push_back({text_event(time, "force", text, mark), mark});
  };
  const auto changes = forces_.see(frame.time, xfrc, Quat(q[0], q[1], q[2], q[3]));
  for (const AppliedForce& force : changes.begun)
    tell(force.from, "pushed by " + applied_force_text(force, bodies_), force.body, true);
  for (const AppliedForce& force : changes.ended)
    tell(force.to, "the push on " + body_text(force.body, bodies_) + " ends", force.body, false);
}

}  // namespace surefoot
