#include "server/frame_block.hpp"

#include <bit>
#include <cstring>
#include <type_traits>

namespace surefoot::server {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are little-endian");

constexpr std::string_view kMagic = "SFV1";
constexpr std::size_t kAlignment = 8;
constexpr std::size_t kTick = 4, kTime = 8, kFloats = 16;  // places in a frame

template <typename Number>
void put(Number number, std::string& out) {
  static_assert(std::is_trivially_copyable_v<Number>);
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), &number, sizeof(Number));
  out.append(bytes.data(), bytes.size());
}

template <typename Number>
Number number_at(std::string_view bytes, std::size_t place) {
  Number number{};
  std::memcpy(&number, bytes.substr(place, sizeof(Number)).data(), sizeof(Number));
  return number;
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

PackedFrame first_frame(std::string_view frames) {
  return {.tick = number_at<std::uint32_t>(frames, kTick),
          .time = number_at<double>(frames, kTime),
          .bytes = frames.substr(0, number_at<std::uint32_t>(frames, 0))};
}

void read_floats(const PackedFrame& frame, std::span<float> floats) {
  std::memcpy(floats.data(), frame.bytes.substr(kFloats).data(), floats.size_bytes());
}

}  // namespace surefoot::server
