#include "server/frame_range.hpp"

#include "server/frame_block.hpp"

#include <limits>

namespace surefoot::server {
namespace {

constexpr float kBeyondAll = std::numeric_limits<float>::infinity();
constexpr float kNotKnown = std::numeric_limits<float>::quiet_NaN();

// Without a branch or a call, as it is done for every channel of every tick. NaN is neither less
// nor greater.
void widen(std::span<float> least, std::span<float> greatest, std::span<const float> low,
           std::span<const float> high) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    least[i] = low[i] < least[i] ? low[i] : least[i];
    greatest[i] = high[i] > greatest[i] ? high[i] : greatest[i];
  }
}

}  // namespace

void FrameRange::clear(std::size_t num_floats) {
  least.assign(num_floats, kBeyondAll);
  greatest.assign(num_floats, -kBeyondAll);
}

void FrameRange::add(std::span<const float> floats) { widen(least, greatest, floats, floats); }

void FrameRange::add(const FrameRange& range) {
  widen(least, greatest, range.least, range.greatest);
}

void FrameRange::pack(std::uint32_t tick, double time, std::string& out) const {
  ViewFrame low, high;
  low.tick = high.tick = tick;
  low.time = high.time = time;
  low.floats = least;
  high.floats = greatest;
  for (std::size_t i = 0; i < least.size(); ++i) {
    if (least[i] > greatest[i]) low.floats[i] = high.floats[i] = kNotKnown;
  }
  server::pack(low, out);
  server::pack(high, out);
}

}  // namespace surefoot::server
