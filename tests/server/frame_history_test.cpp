#include "server/frame_history.hpp"

#include "tests/server/read_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace surefoot::server {
namespace {

constexpr std::size_t kFloats = 5;
constexpr double kPeriod = 0.0025;
constexpr std::uint32_t kKept = 300;

/// A run of which some ticks are lost and some numbers are none, as a server sends it.
class RandomRun {
 public:
  explicit RandomRun(unsigned seed) : random_(seed) {}

  SharedBlock next_block() {
    auto bytes = std::make_shared<std::string>();
    SharedBlock block{.frames = 0, .generation = 2, .lost = 1, .bytes = bytes};
    for (auto left = 1 + random_() % 40; left > 0; --left) {
      tick_ += random_() % 20 == 0 ? 7 : 1;
      frames.push_back(frame());
      pack(frames.back(), *bytes);
      ++block.frames;
    }
    return block;
  }
  std::uint32_t number(std::uint32_t least, std::uint32_t most) {
    return least + static_cast<std::uint32_t>(random_() % (most - least + 1));
  }

  std::vector<ViewFrame> frames;  // all

 private:
  ViewFrame frame() {
    std::uniform_real_distribution<float> value(-9.0F, 9.0F);
    ViewFrame made{.tick = tick_,
                   .time = kPeriod * tick_,
                   .floats = {},
                   .active = {},
                   .blocking = {},
                   .events = {}};
    for (std::size_t i = 0; i < kFloats; ++i) {
      made.floats.push_back(random_() % 4 == 0 ? NAN : value(random_));
    }
    for (auto i = random_() % 3; i > 0; --i) made.active.push_back({1, -1, 9});
    return made;
  }

  std::mt19937 random_;
  std::uint32_t tick_ = 0;
};

std::vector<ViewFrame> asked(const FrameHistory& history, const FrameRequest& request) {
  const ReadBlock block = read_block(history.block(request, 3, kFloats, kPeriod), kFloats);
  EXPECT_EQ(block.head.generation, 3u);
  EXPECT_EQ(block.head.dropped, 0u);
  return block.frames;
}

bool is_same(const std::vector<float>& a, const std::vector<float>& b) {
  return std::ranges::equal(a, b, [](float one, float other) {
    return one == other || (std::isnan(one) && std::isnan(other));
  });
}

class FrameHistories : public ::testing::TestWithParam<unsigned> {
 protected:
  FrameHistories() {
    for (int i = 0; i < 60; ++i) history_.add(run_.next_block());
  }

  RandomRun run_{GetParam()};
  FrameHistory history_{kKept};
};

TEST_P(FrameHistories, keep_as_many_ticks_as_they_should_and_hardly_more) {
  const std::uint32_t last = run_.frames.back().tick, first = history_.first_tick();
  const auto oldest = std::ranges::find_if(
      run_.frames, [&](const ViewFrame& frame) { return frame.tick + kKept > last; });
  EXPECT_LE(first, oldest->tick);
  EXPECT_GT(first, last - kKept - 40 * 7);
  EXPECT_EQ(history_.first_time(), kPeriod * first);
  const auto kept = asked(history_, {.from = 0, .count = 4096});
  ASSERT_EQ(kept.front().tick, first);
  ASSERT_EQ(kept.back().tick, last);
  history_.clear();
  EXPECT_TRUE(history_.is_empty());
  EXPECT_TRUE(asked(history_, {.from = 0, .count = 4096}).empty());
}

TEST_P(FrameHistories, give_the_frames_of_the_ticks_that_are_asked_for) {
  for (int trial = 0; trial < 40; ++trial) {
    const FrameRequest request{.from = run_.number(0, run_.frames.back().tick + 5),
                               .count = run_.number(1, 200),
                               .stride = run_.number(1, 9)};
    const auto given = asked(history_, request);
    auto next = given.begin();
    for (const ViewFrame& frame : run_.frames) {
      const bool is_wanted = frame.tick >= std::max(request.from, history_.first_tick()) &&
                             frame.tick < request.from + request.count * request.stride &&
                             (frame.tick - request.from) % request.stride == 0;
      if (!is_wanted) continue;
      ASSERT_NE(next, given.end());
      EXPECT_EQ(next->tick, frame.tick);
      EXPECT_EQ(next->time, frame.time);
      EXPECT_TRUE(is_same(next->floats, frame.floats));
      EXPECT_EQ(next->active.size(), frame.active.size());
      ++next;
    }
    EXPECT_EQ(next, given.end());
  }
}

TEST_P(FrameHistories, give_the_least_and_greatest_of_each_stride) {
  for (int trial = 0; trial < 20; ++trial) {
    const FrameRequest request{.from = run_.number(0, run_.frames.back().tick),
                               .count = run_.number(1, 60),
                               .stride = run_.number(1, 20),
                               .min_max = true};
    const auto given = asked(history_, request);
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < request.count / 2; ++i) {
      const std::uint32_t begin = request.from + i * request.stride;
      std::vector<float> least(kFloats, NAN), greatest(kFloats, NAN);
      bool is_known = false;
      for (const ViewFrame& frame : run_.frames) {
        if (frame.tick < std::max(begin, history_.first_tick()) ||
            frame.tick >= begin + request.stride)
          continue;
        is_known = true;
        for (std::size_t k = 0; k < kFloats; ++k) {
          least[k] = std::fmin(least[k], frame.floats[k]);
          greatest[k] = std::fmax(greatest[k], frame.floats[k]);
        }
      }
      if (!is_known) continue;
      ASSERT_LT(next + 1, given.size());
      EXPECT_EQ(given[next].tick, begin);
      EXPECT_EQ(given[next].time, kPeriod * begin);
      EXPECT_TRUE(is_same(given[next].floats, least));
      EXPECT_TRUE(is_same(given[next + 1].floats, greatest));
      next += 2;
    }
    EXPECT_EQ(next, given.size());
  }
}

TEST_P(FrameHistories, have_the_newest_blocks_for_whoever_comes) {
  std::size_t frames = 0, last = 0;
  for (const SharedBlock& block : history_.newest(100)) {
    EXPECT_EQ(block.lost, 0u) << "not lost to a page that was not there";
    EXPECT_EQ(block.generation, 2u);
    frames += last = block.frames;
  }
  EXPECT_GE(frames, 100u);
  EXPECT_LT(frames - 100, 40u);
  EXPECT_EQ(first_frame(*history_.newest(1).front().bytes).tick,
            run_.frames[run_.frames.size() - last].tick);
  EXPECT_EQ(first_frame(*history_.newest(100000).front().bytes).tick, history_.first_tick());
}

INSTANTIATE_TEST_SUITE_P(Seeds, FrameHistories, ::testing::Range(1u, 9u));

}  // namespace
}  // namespace surefoot::server
