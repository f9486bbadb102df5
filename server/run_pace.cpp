#include "server/run_pace.hpp"

namespace surefoot::server {
namespace {

constexpr std::chrono::milliseconds kLate{100};  // a longer delay is not made up

}  // namespace

void RunPace::begin(double time, double speed, Clock::time_point now) {
  time_ = time;
  speed_ = speed;
  begun_ = now;
}

RunPace::Clock::time_point RunPace::due(double time, Clock::time_point now) {
  const std::chrono::duration<double> after((time - time_) / speed_);
  const Clock::time_point due = begun_ + std::chrono::duration_cast<Clock::duration>(after);
  if (now - due > kLate) begin(time, speed_, now);
  return due;
}

}  // namespace surefoot::server
