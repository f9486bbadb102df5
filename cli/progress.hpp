#pragma once

#include <chrono>
#include <string>
#include <thread>

namespace surefoot::cli {

/// "85 s", "3 min", "5 h", "12 days".
[[nodiscard]] std::string duration_text(double seconds);

/// ", about 3 min left" of work of which a share from 0 to 1 took so many seconds. Empty where it
/// is too early to tell, or where all of it takes less than a minute.
[[nodiscard]] std::string time_left(double seconds, double share);

/// Progress on stderr: a bar where that is a terminal, otherwise a line now and then; of what takes
/// longer than a minute with the time that is left.
class Progress {
 public:
  /// `total` in the unit that `update` counts in.
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

/// Says on stderr, while it lives, that something goes on of which nobody knows how far it is: a
/// line that counts seconds where that is a terminal, from the first second on, otherwise a line
/// every ten.
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
