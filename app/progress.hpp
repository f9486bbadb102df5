#pragma once

#include <chrono>
#include <string>
#include <thread>

namespace surefoot {

/// Progress on stderr: a bar where that is a terminal, otherwise a line now and then.
class Progress {
 public:
  /// `total` in the unit that `update` counts in.
  Progress(std::string label, double total, std::string unit);
  /// Wipes the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double done);
  /// A line of its own, above the bar.
  void say(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  void draw() const;
  void wipe() const;

  std::string label_, unit_;
  double total_, done_ = 0.0;
  bool terminal_;
  Clock::time_point last_;
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

}  // namespace surefoot
