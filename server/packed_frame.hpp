#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace surefoot::server {

/// A frame in the bytes in which `pack` puts it into a block.
struct PackedFrame {
  std::uint32_t tick = 0;
  double time = 0.0;  ///< [s]
  std::string_view bytes;
};

/// Of packed frames, the first. They must be ours and whole.
[[nodiscard]] PackedFrame first_frame(std::string_view frames);

/// Copies the first floats of a frame, as many as there is room for.
void read_floats(const PackedFrame& frame, std::span<float> floats);

}  // namespace surefoot::server
