#pragma once

#include <chrono>
#include <string>
#include <thread>

namespace surefoot::cli {

/// "85 s", "3 min", "5 h", "12 days".
[[nodiscard]] std::string duration_text(double seconds);

/// ", about 3 min left" of work of which `share`, from 0 to 1, took `seconds`. Empty in the first
/// seconds, and for work of less than a minute.
[[nodiscard]] std::string time_left(double seconds, double share);

/// Progress on stderr: a bar in a terminal, otherwise a line every ten seconds. Shows the time left
/// if the work takes longer than a minute.
class Progress {
 public:
  /// `total`: in the unit of `update`.
  Progress(std::string label, double total, std::string unit);
  /// Wipes the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double done);

 private:
  using Clock = std::chrono::steady_clock;

  void draw() const;
  void wipe() const;

  std::string label_, unit_;
  double total_, done_ = 0.0;
  bool terminal_;
  Clock::time_point begin_, last_;
};

/// While it exists, shows on stderr that work of unknown length goes on: in a terminal a line that
/// counts seconds, otherwise a line every ten seconds.
class Waiting {
 public:
  explicit Waiting(std::string label);
  Waiting(std::string label, std::chrono::milliseconds every);
  /// Wipes the line.
  ~Waiting() = default;
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  std::jthread thread_;
};

}  // namespace surefoot::cli
