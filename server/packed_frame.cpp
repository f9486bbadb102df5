#include "server/packed_frame.hpp"

#include <cstring>

namespace surefoot::server {
namespace {

// Of a frame, docs/view_protocol.md.
constexpr std::size_t kTick = 4, kTime = 8, kFloats = 16;

template <typename Number>
Number number_at(std::string_view bytes, std::size_t place) {
  Number number{};
  std::memcpy(&number, bytes.substr(place, sizeof(Number)).data(), sizeof(Number));
  return number;
}

}  // namespace

PackedFrame first_frame(std::string_view frames) {
  return {.tick = number_at<std::uint32_t>(frames, kTick),
          .time = number_at<double>(frames, kTime),
          .bytes = frames.substr(0, number_at<std::uint32_t>(frames, 0))};
}

void read_floats(const PackedFrame& frame, std::span<float> floats) {
  std::memcpy(floats.data(), frame.bytes.substr(kFloats).data(), floats.size_bytes());
}

}  // namespace surefoot::server
