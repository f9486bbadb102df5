#include "server/frame_block.hpp"

#include "surefoot/base/error.hpp"

#include <bit>
#include <cstring>
#include <type_traits>

namespace surefoot::server {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are little-endian");

constexpr std::string_view kMagic = "SFV1";
constexpr std::size_t kAlignment = 8;
constexpr std::size_t kFrameHeadBytes = 16;

template <typename Number>
void put(Number number, std::string& out) {
  static_assert(std::is_trivially_copyable_v<Number>);
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), &number, sizeof(Number));
  out.append(bytes.data(), bytes.size());
}

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

ViewFrame read_frame(Bytes& block, std::size_t frame_floats) {
  const auto size = block.number<std::uint32_t>();
  if (size < kFrameHeadBytes) throw Error("a frame is shorter than its head");
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

}  // namespace

std::array<char, kBlockHeadBytes> packed(const BlockHead& head) {
  std::string bytes(kMagic);
  put(head.frames, bytes);
  put(head.dropped, bytes);
  put(head.generation, bytes);
  std::array<char, kBlockHeadBytes> result{};
  std::memcpy(result.data(), bytes.data(), result.size());
  return result;
}

void pack(const ViewFrame& frame, std::string& out) {
  const std::size_t begin = out.size();
  put(std::uint32_t{0}, out);  // the size, known at the end
  put(frame.tick, out);
  put(frame.time, out);
  out.append(reinterpret_cast<const char*>(frame.floats.data()),
             frame.floats.size() * sizeof(float));
  put(static_cast<std::uint16_t>(frame.active.size()), out);
  put(static_cast<std::uint16_t>(frame.blocking.size()), out);
  for (const FrameActive& row : frame.active) {
    put(row.level, out);
    put(row.state, out);
    put(row.row, out);
    put(row.by, out);
  }
  for (const FrameBlocking& row : frame.blocking) {
    put(row.level, out);
    put(row.by_level, out);
    put(row.row, out);
    put(row.cost, out);
  }
  while ((out.size() - begin) % kAlignment != 0) out.push_back('\0');
  const auto size = static_cast<std::uint32_t>(out.size() - begin);
  std::memcpy(out.data() + begin, &size, sizeof(size));
}

ReadBlock read_block(std::string_view bytes, std::size_t frame_floats) {
  Bytes block(bytes);
  if (block.take(kMagic.size()) != kMagic) throw Error("not a block of frames");
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
