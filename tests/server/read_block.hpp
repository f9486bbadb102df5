#pragma once

#include "server/frame_block.hpp"
#include "surefoot/base/error.hpp"

#include <cstring>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// Takes numbers from the front of some bytes.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}

  std::string_view take(std::size_t count) {
    if (count > rest_.size()) throw Error("a block of frames is shorter than it says");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  template <typename Number>
  Number number() {
    Number result{};
    std::memcpy(&result, take(sizeof(Number)).data(), sizeof(Number));
    return result;
  }

  [[nodiscard]] bool is_empty() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

inline ViewFrame read_frame(Bytes& block, std::size_t frame_floats) {
  const auto size = block.number<std::uint32_t>();
  if (size < 16) throw Error("a frame is shorter than its head");
  Bytes bytes(block.take(size - sizeof(size)));
  ViewFrame frame;
  frame.tick = bytes.number<std::uint32_t>();
  frame.time = bytes.number<double>();
  for (std::size_t i = 0; i < frame_floats; ++i) frame.floats.push_back(bytes.number<float>());
  frame.active.resize(bytes.number<std::uint16_t>());
  frame.blocking.resize(bytes.number<std::uint16_t>());
  for (FrameActive& row : frame.active) {
    row.level = bytes.number<std::uint8_t>();
    row.state = bytes.number<std::int8_t>();
    row.row = bytes.number<std::uint16_t>();
    row.by = bytes.number<float>();
  }
  for (FrameBlocking& row : frame.blocking) {
    row.level = bytes.number<std::uint8_t>();
    row.by_level = bytes.number<std::uint8_t>();
    row.row = bytes.number<std::uint16_t>();
    row.cost = bytes.number<float>();
  }
  return frame;
}

/// A block in parts.
struct ReadBlock {
  BlockHead head;
  std::vector<ViewFrame> frames;
};

/// Reads a block as viewer/README.md describes it. Throws Error where the bytes are no block
/// of frames with so many floats.
inline ReadBlock read_block(std::string_view bytes, std::size_t frame_floats) {
  Bytes block(bytes);
  if (block.take(4) != "SFV1") throw Error("not a block of frames");
  ReadBlock result;
  result.head.frames = block.number<std::uint32_t>();
  result.head.dropped = block.number<std::uint32_t>();
  result.head.generation = block.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < result.head.frames; ++i) {
    result.frames.push_back(read_frame(block, frame_floats));
  }
  if (!block.is_empty()) throw Error("a block of frames is longer than it says");
  return result;
}

}  // namespace surefoot::server
