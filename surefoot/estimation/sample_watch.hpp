#pragma once

#include "surefoot/signals/sensor_health.hpp"

namespace surefoot::estimation {

/// Sample time that a reading at `time` gives [s]; NaN or a future time becomes the reading's.
[[nodiscard]] inline double believed_sample_time(double given, double time) {
  return given <= time ? given : time;
}

/// Watches the arrival of a sensor's samples: which are new, and which are overdue.
///
/// Learns how old a sample usually gets before the next replaces it, so that slow sensors and
/// constant delays don't count as missing samples. Reports new samples older than `max_delay`. At
/// first any age up to `patience` is usual.
class SampleWatch {
 public:
  /// All [s].
  SampleWatch(double period, double patience, double max_delay)
      : period_(period), patience_(patience), max_delay_(max_delay), usual_age_(patience) {}

  /// One tick. Interprets the sample time by `believed_sample_time`.
  void update(double time, double sample_time) noexcept;

  [[nodiscard]] double period() const { return period_; }
  /// This tick has a sample that is newer than all before, and not too old.
  [[nodiscard]] bool is_new() const { return is_new_; }
  /// Of the newest sample [s].
  [[nodiscard]] double sample_time() const { return sample_time_; }
  /// Accepted sample time of this tick [s].
  [[nodiscard]] double given_time() const { return given_time_; }
  /// Time for which new samples have been older than `max_delay` [s].
  [[nodiscard]] double delayed_for() const { return delayed_for_; }
  /// Age of this tick's values: of the newest sample, or, if the next is overdue and values are
  /// predicted from it, its age on arrival; at most `patience` [s].
  [[nodiscard]] double lag() const { return lag_; }
  /// This tick repeats an old sample, without information on the time since. False until the second
  /// sample, as a robot begins at rest.
  [[nodiscard]] bool is_held() const { return !is_new_ && has_second_; }
  /// Usual age of new samples on arrival; at first that of the first one; at most `patience` [s].
  /// Changes after four in a row with another delay.
  [[nodiscard]] double delay() const { return delay_; }
  /// This tick's sample is new and of the usual age.
  [[nodiscard]] bool is_punctual() const { return !is_held() && is_punctual_; }
  /// `silent`, `late` or `none`.
  [[nodiscard]] SampleFault fault() const { return fault_; }

 private:
  void follow_delay() noexcept;

  double period_, patience_, max_delay_, usual_age_;
  double sample_time_ = kNaN, time_before_ = kNaN, given_time_ = kNaN;
  double delayed_for_ = 0.0, lag_ = 0.0, delay_ = 0.0;  // [s]
  double other_delay_ = kNaN;                           // of the newest sample [s]
  int others_ = 0;                                      // samples in a row with that delay
  bool is_new_ = false, has_second_ = false, is_punctual_ = true;
  SampleFault fault_ = SampleFault::none;
};

}  // namespace surefoot::estimation
