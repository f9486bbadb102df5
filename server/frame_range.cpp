#include "server/frame_range.hpp"

#include <limits>

namespace surefoot::server {
namespace {

constexpr float kBeyondAll = std::numeric_limits<float>::infinity();
constexpr float kNotKnown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void FrameRange::clear(std::size_t num_floats) {
  least.floats.assign(num_floats, kBeyondAll);
  greatest.floats.assign(num_floats, -kBeyondAll);
}

// Without a branch or a call, as it is done for every channel of every tick. What is not a number
// is neither less nor greater.
void FrameRange::add(std::span<const float> floats) {
  float* low = least.floats.data();
  float* high = greatest.floats.data();
  for (std::size_t i = 0; i < floats.size(); ++i) {
    low[i] = floats[i] < low[i] ? floats[i] : low[i];
    high[i] = floats[i] > high[i] ? floats[i] : high[i];
  }
}

void FrameRange::pack(std::uint32_t tick, double time, std::string& out) {
  for (std::size_t i = 0; i < least.floats.size(); ++i) {
    if (least.floats[i] > greatest.floats[i]) least.floats[i] = greatest.floats[i] = kNotKnown;
  }
  for (ViewFrame* frame : {&least, &greatest}) {
    frame->tick = tick;
    frame->time = time;
    server::pack(*frame, out);
  }
}

}  // namespace surefoot::server
