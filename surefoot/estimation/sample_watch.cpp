#include "surefoot/estimation/sample_watch.hpp"

#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kLearningRate = 0.1;  // weight of a new value in the usual age
constexpr double kMargin = 0.75;       // periods beyond the usual age
constexpr int kNewDelaySamples = 4;    // in a row with another delay make it the usual one

}  // namespace

void SampleWatch::update(double time, double sample_time) noexcept {
  const double given = believed_sample_time(sample_time, time);
  const bool stands_still = given == given_time_;
  const bool is_first = !(sample_time_ <= time_before_);
  is_new_ = is_first || given > sample_time_;
  if (is_new_ && !is_first) {
    const double replaced_at = std::min(time_before_ - sample_time_, patience_);
    usual_age_ += kLearningRate * (replaced_at - usual_age_);
  }
  if (is_new_) sample_time_ = given;
  const double age = time - sample_time_;
  const bool is_delayed = is_new_ ? age > max_delay_ + kTimeRounding : delayed_for_ > 0.0;
  delayed_for_ = is_delayed ? delayed_for_ + period_ : 0.0;
  const bool is_too_old = age > patience_ + kTimeRounding;
  fault_ = SampleFault::none;
  if (is_too_old || (!is_new_ && age > usual_age_ + kMargin * period_)) {
    fault_ = stands_still ? SampleFault::silent : SampleFault::late;
  }
  if (is_new_ || fault_ == SampleFault::none) lag_ = std::min(age, patience_);
  const bool has_more = has_second_;
  has_second_ = has_second_ || (is_new_ && !is_first);
  if (!has_more) delay_ = lag_;
  if (is_new_) follow_delay();
  is_new_ = is_new_ && !is_too_old;
  given_time_ = given;
  time_before_ = time;
}

// A single late sample does not change the usual delay.
void SampleWatch::follow_delay() noexcept {
  const bool is_as_before = std::abs(lag_ - other_delay_) < kMargin * period_;
  is_punctual_ = std::abs(lag_ - delay_) < kMargin * period_;
  others_ = is_punctual_ ? 0 : is_as_before ? others_ + 1 : 1;
  other_delay_ = lag_;
  if (others_ < kNewDelaySamples) return;
  delay_ = lag_;
  is_punctual_ = true;
  others_ = 0;
}

}  // namespace surefoot::estimation
