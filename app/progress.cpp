#include "app/progress.hpp"

#include "surefoot/base/printable.hpp"

#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <utility>

namespace surefoot {
namespace {

constexpr int kWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::chrono::seconds kNextLine{10};

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

Progress::Progress(std::string label, double total, std::string unit)
    : label_(printable(label)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(is_terminal()),
      last_(Clock::now()) {}

Progress::~Progress() { wipe(); }

void Progress::update(double done) {
  done_ = done;
  const Clock::time_point now = Clock::now();
  if (terminal_ ? now - last_ < kRedraw : now - last_ < kNextLine) return;
  last_ = now;
  draw();
}

void Progress::say(const std::string& line) {
  wipe();
  std::fprintf(stderr, "%s\n", printable(line).c_str());
  if (terminal_) draw();
}

void Progress::draw() const {
  if (!terminal_) {
    std::fprintf(stderr, "%s: %.4g of %.4g %s\n", label_.c_str(), done_, total_, unit_.c_str());
    return;
  }
  const int filled = static_cast<int>(kWidth * std::clamp(done_ / total_, 0.0, 1.0));
  std::string bar;
  for (int i = 0; i < kWidth; ++i) bar += i < filled ? "█" : "░";
  std::fprintf(stderr, "\r\033[K%s %s %.4g of %.4g %s", label_.c_str(), bar.c_str(), done_, total_,
               unit_.c_str());
}

void Progress::wipe() const {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

Waiting::Waiting(std::string label)
    : Waiting(std::move(label), is_terminal() ? std::chrono::seconds(1) : kNextLine) {}

Waiting::Waiting(std::string label, std::chrono::milliseconds every)
    : thread_([label = printable(label), every](const std::stop_token& stop) {
        count_seconds(stop, label, every);
      }) {}

}  // namespace surefoot
