#pragma once

#include "surefoot/signals/sensor_health.hpp"

namespace surefoot {

/// When a sample was taken by a reading at `time` that gives this time for it [s]: one that is NaN,
/// or lies ahead, is taken for the reading's.
[[nodiscard]] inline double believed_sample_time(double given, double time) {
  return given <= time ? given : time;
}

/// Watches when a sensor's samples come: which are new, and which are overdue.
///
/// How old a sample gets before the next replaces it is learnt, so that slow sensors and constant
/// delays are not taken for missing samples; but that new ones are older than `max_delay` is told.
/// At first anything up to `patience` is usual.
class SampleWatch {
 public:
  /// All [s].
  SampleWatch(double period, double patience, double max_delay)
      : period_(period), patience_(patience), max_delay_(max_delay), usual_age_(patience) {}

  /// One tick. The sample time is believed as `believed_sample_time` says.
  void update(double time, double sample_time) noexcept;

  [[nodiscard]] double period() const { return period_; }
  /// This tick has a sample that is later than all before, and not too old.
  [[nodiscard]] bool is_new() const { return is_new_; }
  /// Of the newest sample [s].
  [[nodiscard]] double sample_time() const { return sample_time_; }
  /// Of this tick's, as it is believed [s].
  [[nodiscard]] double given_time() const { return given_time_; }
  /// How long new samples have been older than `max_delay` [s].
  [[nodiscard]] double delayed_for() const { return delayed_for_; }
  /// Of what is believed at this tick: how old the newest sample is, or, where the next is overdue
  /// and the values go on from it as expected, how old it was when it came; `patience` at most [s].
  [[nodiscard]] double lag() const { return lag_; }
  /// This tick's sample was there before: it says nothing of what happened since. Not before the
  /// second has come, as a robot begins at rest.
  [[nodiscard]] bool is_held() const { return !is_new_ && has_second_; }
  /// How old new samples usually are when they come; of the first, how old it is; `patience` at
  /// most [s]. It follows when four in a row come with another delay.
  [[nodiscard]] double delay() const { return delay_; }
  /// This tick's sample is new and as old as usual.
  [[nodiscard]] bool is_punctual() const { return !is_held() && is_punctual_; }
  /// `silent`, `late` or `none`.
  [[nodiscard]] SampleFault fault() const { return fault_; }

 private:
  void follow_delay() noexcept;

  double period_, patience_, max_delay_, usual_age_;
  double sample_time_ = kNaN, time_before_ = kNaN, given_time_ = kNaN;
  double delayed_for_ = 0.0, lag_ = 0.0, delay_ = 0.0;  // [s]
  double other_delay_ = kNaN;                           // of the newest sample [s]
  int others_ = 0;                                      // samples in a row with one like that
  bool is_new_ = false, has_second_ = false, is_punctual_ = true;
  SampleFault fault_ = SampleFault::none;
};

}  // namespace surefoot
