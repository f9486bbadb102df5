#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace surefoot::server {

/// Least and greatest of each channel over some frames. Values that are NaN are skipped.
struct FrameRange {
  std::vector<float> least, greatest;

  /// Of no frame yet: each least is above its greatest.
  void clear(std::size_t num_floats);
  void add(std::span<const float> floats);
  void add(const FrameRange& range);
  /// Appends two frames without rows, at a tick's time [s]. A channel without values is NaN.
  void pack(std::uint32_t tick, double time, std::string& out) const;
};

}  // namespace surefoot::server
