#include "server/view_tick.hpp"

#include "surefoot/evaluation/alignment_fields.hpp"
#include "surefoot/evaluation/estimate_fields.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/explain/seen_level.hpp"
#include "surefoot/explain/unused_text.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/logged_model.hpp"
#include "surefoot/logging/stop_text.hpp"

#include <algorithm>
#include <limits>

namespace surefoot::server {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

const logged::Timing& no_timing() {
  static const logged::Timing none{
      .stages = {kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNoLevelTimes}, .levels = {}};
  return none;
}

/// Number of a level; 255: it has no channels.
std::uint8_t number_of(const std::string& level, const ViewChannels& channels) {
  const auto found = std::ranges::find(channels.level_names, level);
  return found == channels.level_names.end()
             ? std::uint8_t{255}
             : static_cast<std::uint8_t>(found - channels.level_names.begin());
}

double number_of(const std::string& text, const std::vector<std::string>& texts) {
  if (text.empty()) return 0.0;
  return static_cast<double>(std::ranges::find(texts, text) - texts.begin());
}

std::vector<ToldLevel> told_levels(const KnownTick& tick, const ViewChannels& channels) {
  const logged::Hierarchy& hierarchy = tick.hierarchy;
  const bool is_cut_off = hierarchy.status == logging::kIterationCap && hierarchy.failed_level >= 0;
  std::size_t solved = logging::was_used(tick.record) ? hierarchy.levels.size() : 0;
  if (std::ranges::all_of(hierarchy.levels,
                          [](const auto& one) { return one.report.num_rows == 0; }))
    solved = 0;
  if (is_cut_off) solved = std::min(solved, static_cast<std::size_t>(hierarchy.failed_level));
  std::vector<ToldLevel> levels;
  for (std::size_t place = 0; place < solved; ++place) {
    const logged::Level& level = hierarchy.levels[place];
    const std::size_t number = number_of(level.name, channels);
    if (number >= channels.level_visible.size()) continue;
    const bool is_at_bound = std::ranges::find(hierarchy.active, level.name, &logged::Row::level) !=
                             hierarchy.active.end();
    const explain::SeenLevel state =
        explain::seen_level(static_cast<std::size_t>(level.report.num_rows), level.report.residual,
                            channels.level_visible[number], is_at_bound);
    levels.push_back({level.name, static_cast<double>(state)});
  }
  return levels;
}

/// The texts that a channel's number stands for.
const std::vector<std::string>& values_of(std::string_view name, const ViewChannels& channels) {
  return std::ranges::find(channels.channels, name, &ViewChannel::name)->values;
}

Told told(const KnownTick& tick, const explain::CommandedForces& forces,
          const ViewChannels& channels) {
  const TickRecord& record = tick.record;
  const std::vector<std::string>& joints = channels.joint_names;
  const std::vector<std::string>& stops = values_of("told.stop", channels);
  const auto wrong = [&](StopCause group) {
    const GroupHealth& now = *group_of(record.health, group);
    const bool is_wrong = now.fault != SampleFault::none;
    return is_wrong ? number_of(logging::text_of_stop(group, now.fault, now.joint, joints), stops)
                    : 0.0;
  };
  const explain::UnusedText unused = explain::unused_text(record, joints);
  Told result{.stop = number_of(logging::text_of_stop(record, joints), stops),
              .encoders = wrong(StopCause::encoders),
              .joint_torques = wrong(StopCause::joint_torques),
              .imu = wrong(StopCause::imu),
              .unused = number_of(unused.what, explain::unused_texts()),
              .because = number_of(unused.why, values_of("told.because", channels)),
              .levels = told_levels(tick, channels)};
  for (const Leg leg : first_legs(channels.num_legs))
    result.beyond[index(leg)] =
        static_cast<double>(explain::beyond_limits(forces, record.plan, leg));
  return result;
}

/// The texts of a channel of `Told`.
std::vector<std::string> texts_of(std::string_view name, const std::vector<std::string>& joints) {
  if (name == "told.unused") return explain::unused_texts();
  if (name == "told.because") return explain::unused_reasons(joints);
  if (name.starts_with("told.beyond.")) return {"", "force", "friction"};
  if (name.starts_with("told.level."))
    return {explain::kSeenLevelNames.begin(), explain::kSeenLevelNames.end()};
  return logging::stop_texts(joints);
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

/// What a run without truth lacks: the last channels.
void add_truth(const KnownTick& tick, const simulation::GroundTruth& truth,
               logged::ChannelWriter& writer) {
  writer.add(truth);
  writer.add(tick.alignment == nullptr ? evaluation::Alignment() : *tick.alignment);
  if (tick.start != nullptr) writer.add(evaluation::aligned(*tick.start, truth, tick.record.state));
}

}  // namespace

ViewChannels tick_channels(const logging::LogHeader& header, const simulation::GroundTruth& truth) {
  ViewChannels channels;
  channels.num_legs = header.robot.num_legs;
  channels.level_names = header.level_names;
  for (std::ptrdiff_t k = 0; k < std::ssize(header.level_names); ++k)
    channels.level_visible.push_back(header.visible(k));
  channels.least_load = header.robot.least_load();
  channels.joint_names = header.robot.joints();
  TickRecord tick;
  size_joints(tick, std::ssize(header.robot.joint_names), header.robot.num_legs);
  logged::ChannelLister lister(channels);
  lister.add("readings", tick.reading);
  lister.add("health", tick.health);
  lister.add("user", tick.user);
  lister.add("state", tick.state);
  lister.add("plan", tick.plan);
  lister.add("model", logged::Model());
  lister.add("hierarchy", logged::Hierarchy());
  lister.add("command", tick.command);
  lister.add("commanded", explain::CommandedForces());
  lister.add("told", Told());
  for (ViewChannel& channel : channels.channels)
    if (channel.name.starts_with("told."))
      channel.values = texts_of(channel.name, channels.joint_names);
  lister.add("timings", logged::Timing());
  lister.add("truth", truth);
  lister.add("alignment", evaluation::Alignment());
  lister.add("estimate", evaluation::AlignedEstimate());
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
  writer.add(logged::model_of(tick.record, channels.least_load));
  writer.add(tick.hierarchy);
  writer.add(tick.record.command);
  const explain::CommandedForces forces =
      explain::commanded_forces(tick.cone, tick.record, channels.least_load);
  writer.add(forces);
  writer.add(told(tick, forces, channels));
  writer.add(tick.timing == nullptr ? no_timing() : *tick.timing);
  if (tick.truth != nullptr) add_truth(tick, *tick.truth, writer);
  add_rows(tick.hierarchy, channels, frame);
  frame.events.clear();
  for (const GaitEvent& event : tick.record.plan.events)
    frame.events.push_back({.kind = static_cast<int>(event.kind), .leg = event.leg});
}

}  // namespace surefoot::server
