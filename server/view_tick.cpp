#include "server/view_tick.hpp"

#include "surefoot/evaluation/estimate_fields.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/explain/stop_text.hpp"
#include "surefoot/logging/logged_model.hpp"

#include <algorithm>
#include <limits>

namespace surefoot {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

const logged::Timing& no_timing() {
  static const logged::Timing none{
      .stages = {kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNoLevelTimes}, .levels = {}};
  return none;
}

/// 255 for a level that has no channels.
std::uint8_t number_of(const std::string& level, const ViewChannels& channels) {
  const auto found = std::ranges::find(channels.level_names, level);
  return found == channels.level_names.end()
             ? std::uint8_t{255}
             : static_cast<std::uint8_t>(found - channels.level_names.begin());
}

double number_of(const std::string& text) {
  if (text.empty()) return 0.0;
  return static_cast<double>(std::ranges::find(stop_texts(), text) - stop_texts().begin());
}

ToldFaults told_faults(const TickRecord& tick) {
  const auto wrong = [&](StopCause group) {
    const GroupHealth& now = *group_of(tick.health, group);
    const bool is_wrong = now.fault != SampleFault::none;
    return is_wrong ? number_of(text_of_stop(group, now.fault, now.joint)) : 0.0;
  };
  return {.stop = number_of(text_of_stop(tick)),
          .encoders = wrong(StopCause::encoders),
          .joint_torques = wrong(StopCause::joint_torques),
          .imu = wrong(StopCause::imu)};
}

void add_rows(const logged::Hierarchy& hierarchy, const ViewChannels& channels, ViewFrame& frame) {
  frame.active.clear();
  for (const logged::Row& row : hierarchy.active) {
    frame.active.push_back({.level = number_of(row.level, channels),
                            .state = static_cast<std::int8_t>(row.state),
                            .row = static_cast<std::uint16_t>(row.id),
                            .by = static_cast<float>(row.by)});
  }
  for (const logged::MissedRow& row : hierarchy.missed) {
    frame.active.push_back({.level = number_of(row.level, channels),
                            .state = kMissedEquality,
                            .row = static_cast<std::uint16_t>(row.id),
                            .by = static_cast<float>(row.by)});
  }
  frame.blocking.clear();
  for (const logged::BlockingRow& row : hierarchy.blocked_by) {
    frame.blocking.push_back({.level = number_of(row.level, channels),
                              .by_level = number_of(row.by, channels),
                              .row = static_cast<std::uint16_t>(row.report.id),
                              .cost = static_cast<float>(row.report.cost)});
  }
}

}  // namespace

ViewChannels tick_channels(const std::vector<std::string>& level_names, const GroundTruth& truth) {
  ViewChannels channels;
  channels.level_names = level_names;
  const TickRecord tick;
  logged::ChannelLister lister(channels);
  lister.add("readings", tick.reading);
  lister.add("health", tick.health);
  lister.add("user", tick.user);
  lister.add("state", tick.state);
  lister.add("plan", tick.plan);
  lister.add("model", logged::Model());
  lister.add("hierarchy", logged::Hierarchy());
  lister.add("command", tick.command);
  lister.add("commanded", CommandedForces());
  lister.add("told", ToldFaults());
  for (ViewChannel& channel : channels.channels)
    if (channel.name.starts_with("told.")) channel.values = stop_texts();
  lister.add("timings", logged::Timing());
  lister.add("truth", truth);
  lister.add("estimate", AlignedEstimate());
  return channels;
}

void to_frame(const KnownTick& tick, const ViewChannels& channels, ViewFrame& frame) {
  frame.tick = tick.number;
  frame.time = tick.record.reading.time;
  frame.floats.assign(channels.floats, kNone);
  logged::ChannelWriter writer(channels, frame.floats);
  writer.add(tick.record.reading);
  writer.add(tick.record.health);
  writer.add(tick.record.user);
  writer.add(tick.record.state);
  writer.add(tick.record.plan);
  writer.add(logged::model_of(tick.record));
  writer.add(tick.hierarchy);
  writer.add(tick.record.command);
  writer.add(commanded_forces(tick.cone, tick.record));
  writer.add(told_faults(tick.record));
  writer.add(tick.timing == nullptr ? no_timing() : *tick.timing);
  if (tick.truth != nullptr) writer.add(*tick.truth);
  if (tick.truth != nullptr && tick.start != nullptr)
    writer.add(aligned(*tick.start, *tick.truth, tick.record.state));
  add_rows(tick.hierarchy, channels, frame);
  frame.events.clear();
  for (const GaitEvent& event : tick.record.plan.events)
    frame.events.push_back({.kind = static_cast<int>(event.kind), .leg = event.leg});
}

}  // namespace surefoot
