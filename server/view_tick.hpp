#pragma once

#include "server/frame_block.hpp"
#include "server/view_channels.hpp"
#include "surefoot/evaluation/alignment.hpp"
#include "surefoot/explain/commanded_force.hpp"
#include "surefoot/logging/hierarchy_namer.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <vector>

namespace surefoot::server {

/// Result of a level of a tick, a `SeenLevel`.
struct ToldLevel {
  std::string name;
  double state = 0.0;
};

/// What the program says of a tick in words, as indices into the `values` of their channels.
struct Told {
  double stop = 0.0, encoders = 0.0, joint_torques = 0.0, imu = 0.0;  ///< of `stop_texts`
  double unused = 0.0, because = 0.0;  ///< of `unused_texts` and `unused_reasons`
  PerLeg<double> beyond{};             ///< as `Beyond`
  std::vector<ToldLevel> levels;
};

}  // namespace surefoot::server

namespace surefoot::logged {

template <>
inline constexpr bool kIsByLevel<std::vector<server::ToldLevel>> = true;

template <typename Archive, Is<server::ToldLevel> T>
void fields(Archive& field, T& level) {
  field("state", level.state, "how the level came out, in words");
}

template <typename Archive, Is<server::Told> T>
void fields(Archive& field, T& told) {
  field("stop", told.stop, "why the controller has stopped for safety, in words");
  field("encoders", told.encoders, "what is wrong with the encoders, in words");
  field("joint_torques", told.joint_torques, "what is wrong with the joint torques, in words");
  field("imu", told.imu, "what is wrong with the IMU, in words");
  field("unused", told.unused, "that what was planned and solved commands nothing, in words");
  field("because", told.because, "why, in words");
  field("beyond", told.beyond,
        "the limit of a foot beyond which the solution asks for a force that no ground gives");
  field("levels", told.levels, "");
}

}  // namespace surefoot::logged

namespace surefoot::server {

/// The channels of a run: every field of the log, under its topic, and `commanded`, `told` and
/// `estimate`, which follow from them. `truth` has the sizes of MuJoCo's vectors.
[[nodiscard]] ViewChannels tick_channels(const logging::LogHeader& header,
                                         const simulation::GroundTruth& truth);

/// What is known of a tick; what is null becomes NaN in its frame.
struct KnownTick {
  std::uint32_t number = 0;
  const TickRecord& record;
  const logged::Hierarchy& hierarchy;              ///< the record's, with names
  const std::optional<tasks::FrictionCone>& cone;  ///< of its stack
  const simulation::GroundTruth* truth = nullptr;
  const logged::Timing* timing = nullptr;
  const evaluation::Alignment* alignment = nullptr;
  const evaluation::StartAlignment* start = nullptr;
};

/// Writes the tick into a frame. Levels are numbered as in the channels' level names, in any order.
void to_frame(const KnownTick& tick, const ViewChannels& channels, ViewFrame& frame);

}  // namespace surefoot::server
