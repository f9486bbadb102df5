#include "cli/progress.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/base/printable.hpp"

#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <utility>

namespace surefoot::cli {
namespace {

constexpr int kBarWidth = 30;  // [characters]
constexpr std::chrono::milliseconds kRedrawPeriod{100};
constexpr std::chrono::seconds kLinePeriod{10};  // where stderr is no terminal

bool is_terminal() { return isatty(STDERR_FILENO) == 1; }

void count_seconds(const std::stop_token& stop, const std::string& label,
                   std::chrono::milliseconds every) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const bool terminal = is_terminal();
  bool is_drawn = false;
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  while (!stopped.wait_for(lock, stop, every, [&] { return stop.stop_requested(); })) {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    std::fprintf(stderr, terminal ? "\r\033[K%s: %.0f s" : "%s: %.0f s\n", label.c_str(), seconds);
    is_drawn = true;
  }
  if (terminal && is_drawn) std::fputs("\r\033[K", stderr);
}

}  // namespace

std::string duration_text(double seconds) {
  constexpr double kMinute = 60.0, kHour = 3600.0, kDay = 86400.0;
  if (seconds < 1.5 * kMinute) return formatted("%.0f s", seconds);
  if (seconds < 1.5 * kHour) return formatted("%.0f min", seconds / kMinute);
  if (seconds < 2.0 * kDay) return formatted("%.0f h", seconds / kHour);
  return formatted("%.0f days", seconds / kDay);
}

std::string time_left(double seconds, double share) {
  constexpr double kMinElapsed = 2.0, kMinTotal = 60.0;  // [s]
  constexpr double kMinShare = 0.05;
  const bool is_known = seconds >= kMinElapsed && share >= kMinShare && share < 1.0;
  if (!is_known || seconds / share < kMinTotal) return "";
  return ", about " + duration_text(seconds * (1.0 - share) / share) + " left";
}

Progress::Progress(std::string label, double total, std::string unit)
    : label_(printable(label)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(is_terminal()),
      begin_(Clock::now()),
      last_(begin_) {}

Progress::~Progress() { wipe(); }

void Progress::update(double done) {
  done_ = done;
  const Clock::time_point now = Clock::now();
  if (terminal_ ? now - last_ < kRedrawPeriod : now - last_ < kLinePeriod) return;
  last_ = now;
  draw();
}

void Progress::draw() const {
  const std::string left =
      time_left(std::chrono::duration<double>(Clock::now() - begin_).count(), done_ / total_);
  if (!terminal_) {
    std::fprintf(stderr, "%s: %.4g of %.4g %s%s\n", label_.c_str(), done_, total_, unit_.c_str(),
                 left.c_str());
    return;
  }
  const int filled = static_cast<int>(kBarWidth * std::clamp(done_ / total_, 0.0, 1.0));
  std::string bar;
  for (int i = 0; i < kBarWidth; ++i) bar += i < filled ? "█" : "░";
  std::fprintf(stderr, "\r\033[K%s %s %.4g of %.4g %s%s", label_.c_str(), bar.c_str(), done_,
               total_, unit_.c_str(), left.c_str());
}

void Progress::wipe() const {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

Waiting::Waiting(std::string label)
    : Waiting(std::move(label), is_terminal() ? std::chrono::seconds(1) : kLinePeriod) {}

Waiting::Waiting(std::string label, std::chrono::milliseconds every)
    : thread_([label = printable(label), every](const std::stop_token& stop) {
        count_seconds(stop, label, every);
      }) {}

}  // namespace surefoot::cli
