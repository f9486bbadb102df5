#include "app/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace surefoot {
namespace {

constexpr int kWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::chrono::seconds kNextLine{10};

}  // namespace

Progress::Progress(std::string label, double total, std::string unit)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
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
  std::fprintf(stderr, "%s\n", line.c_str());
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

}  // namespace surefoot
