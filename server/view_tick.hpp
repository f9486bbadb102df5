#pragma once

#include "server/frame_block.hpp"
#include "server/view_channels.hpp"
#include "surefoot/evaluation/start_alignment.hpp"
#include "surefoot/explain/commanded_force.hpp"
#include "surefoot/logging/hierarchy_namer.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <vector>

namespace surefoot {

/// Why the controller stopped and what is wrong with the sensors, as numbers of `stop_texts`.
struct ToldFaults {
  double stop = 0.0, encoders = 0.0, joint_torques = 0.0, imu = 0.0;
};

namespace logged {

template <typename Archive, Is<ToldFaults> T>
void fields(Archive& field, T& told) {
  field("stop", told.stop, "why the controller has stopped for safety, in words");
  field("encoders", told.encoders, "what is wrong with the encoders, in words");
  field("joint_torques", told.joint_torques, "what is wrong with the joint torques, in words");
  field("imu", told.imu, "what is wrong with the IMU, in words");
}

}  // namespace logged

/// The channels of a run: every field of the log, under its topic, and `commanded`, `told` and
/// `estimate`, which follow from them. `truth` has the sizes of MuJoCo's vectors.
[[nodiscard]] ViewChannels tick_channels(const std::vector<std::string>& level_names,
                                         const GroundTruth& truth);

/// What is known of a tick; what is null is not a number in its frame.
struct KnownTick {
  std::uint32_t number = 0;
  const TickRecord& record;
  const logged::Hierarchy& hierarchy;       ///< of the record, with names
  const std::optional<FrictionCone>& cone;  ///< of its stack
  const GroundTruth* truth = nullptr;
  const logged::Timing* timing = nullptr;
  const StartAlignment* start = nullptr;
};

/// The tick as the page gets it. Levels and rows are numbered as in the channels' level names,
/// whatever their order was.
void to_frame(const KnownTick& tick, const ViewChannels& channels, ViewFrame& frame);

}  // namespace surefoot
