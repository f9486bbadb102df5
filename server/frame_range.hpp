#pragma once

#include "server/frame_block.hpp"

#include <span>
#include <string>

namespace surefoot::server {

/// Least and greatest of each channel over some frames, as two frames without rows. What is not a
/// number is passed over; a channel that has none is NaN.
struct FrameRange {
  ViewFrame least, greatest;

  /// Of no frame yet: until something is added, each least is above its greatest.
  void clear(std::size_t num_floats);
  void add(std::span<const float> floats);
  /// Appends both frames, at a tick's time [s].
  void pack(std::uint32_t tick, double time, std::string& out);
};

}  // namespace surefoot::server
