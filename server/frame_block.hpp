#pragma once

#include "surefoot/signals/leg.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// State of an equality row that was missed.
inline constexpr std::int8_t kMissedEquality = 2;

/// An inequality row at or beyond a bound, or an equality row that was missed; levels by their
/// number in `header.level_names`.
struct FrameActive {
  std::uint8_t level = 0;
  std::int8_t state = 0;  ///< ±1 at a bound, ±3 beyond it, or kMissedEquality
  std::uint16_t row = 0;  ///< in the session's `rows[level]`
  float by = 0.0F;        ///< beyond the bound: above the upper one, negative below the lower one
};

/// A row that keeps a level from a smaller residual.
struct FrameBlocking {
  std::uint8_t level = 0, by_level = 0;
  std::uint16_t row = 0;  ///< in the session's `rows[by_level]`
  float cost = 0.0F;
};

/// An event of a tick; pages get it by `/api/events`, not in blocks.
struct FrameEvent {
  int kind = 0;  ///< number in `header.event_names`
  std::optional<Leg> leg;
};

/// One tick as the page gets it.
struct ViewFrame {
  std::uint32_t tick = 0;
  double time = 0.0;  ///< [s]
  std::vector<float> floats;
  std::vector<FrameActive> active;
  std::vector<FrameBlocking> blocking;
  std::vector<FrameEvent> events;
};

/// The head of a block, viewer/README.md.
struct BlockHead {
  std::uint32_t frames = 0, dropped = 0, generation = 0;
};

inline constexpr std::size_t kBlockHeadBytes = 16;

[[nodiscard]] std::array<char, kBlockHeadBytes> packed(const BlockHead& head);
/// Appends the frame's bytes.
void pack(const ViewFrame& frame, std::string& out);

/// The bytes of a frame in a block.
struct PackedFrame {
  std::uint32_t tick = 0;
  double time = 0.0;  ///< [s]
  std::string_view bytes;
};

/// The first of some packed frames, which must be whole.
[[nodiscard]] PackedFrame first_frame(std::string_view frames);

/// Copies the first floats of a frame into `floats`.
void read_floats(const PackedFrame& frame, std::span<float> floats);

}  // namespace surefoot::server
