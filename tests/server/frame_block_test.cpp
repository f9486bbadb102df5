#include "server/frame_block.hpp"

#include "surefoot/base/error.hpp"
#include "tests/server/read_block.hpp"

#include <gtest/gtest.h>

#include <random>

namespace surefoot::server {
namespace {

constexpr std::size_t kFloats = 7;

ViewFrame random_frame(std::mt19937& random, std::uint32_t tick) {
  std::uniform_real_distribution<float> number(-1e3F, 1e3F);
  ViewFrame frame{.tick = tick,
                  .time = 0.0025 * tick,
                  .floats = {},
                  .active = {},
                  .blocking = {},
                  .events = {}};
  for (std::size_t i = 0; i < kFloats; ++i) frame.floats.push_back(number(random));
  for (auto i = random() % 5; i > 0; --i) {
    frame.active.push_back({static_cast<std::uint8_t>(random() % 11), -3,
                            static_cast<std::uint16_t>(random() % 65536)});
  }
  for (auto i = random() % 5; i > 0; --i) {
    frame.blocking.push_back({static_cast<std::uint8_t>(random() % 11), 2,
                              static_cast<std::uint16_t>(random() % 999), number(random)});
  }
  return frame;
}

std::string block_of(const std::vector<ViewFrame>& frames) {
  const auto head = packed({static_cast<std::uint32_t>(frames.size()), 12, 3});
  std::string bytes(head.data(), head.size());
  for (const ViewFrame& frame : frames) pack(frame, bytes);
  return bytes;
}

TEST(FrameBlock, what_is_packed_is_read_again) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<ViewFrame> frames;
    for (std::uint32_t tick = 0; tick < random() % 6; ++tick) {
      frames.push_back(random_frame(random, tick));
    }
    const ReadBlock block = read_block(block_of(frames), kFloats);
    EXPECT_EQ(block.head.dropped, 12u);
    EXPECT_EQ(block.head.generation, 3u);
    ASSERT_EQ(block.frames.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(block.frames[i].tick, frames[i].tick);
      EXPECT_EQ(block.frames[i].time, frames[i].time);
      EXPECT_EQ(block.frames[i].floats, frames[i].floats);
      ASSERT_EQ(block.frames[i].active.size(), frames[i].active.size());
      for (std::size_t k = 0; k < frames[i].active.size(); ++k) {
        EXPECT_EQ(block.frames[i].active[k].row, frames[i].active[k].row);
        EXPECT_EQ(block.frames[i].active[k].state, -3);
      }
      ASSERT_EQ(block.frames[i].blocking.size(), frames[i].blocking.size());
      for (std::size_t k = 0; k < frames[i].blocking.size(); ++k) {
        EXPECT_EQ(block.frames[i].blocking[k].level, frames[i].blocking[k].level);
        EXPECT_EQ(block.frames[i].blocking[k].cost, frames[i].blocking[k].cost);
      }
    }
  }
}

TEST(FrameBlock, a_frame_begins_where_a_page_can_read_floats) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    std::string bytes;
    pack(random_frame(random, 1), bytes);
    EXPECT_EQ(bytes.size() % 8, 0u);
  }
}

TEST(FrameBlock, bytes_that_are_cut_off_or_no_block_are_told) {
  std::mt19937 random(3);
  const std::string good = block_of({random_frame(random, 0), random_frame(random, 1)});
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_THROW((void)read_block(good.substr(0, size), kFloats), Error) << size;
  }
  EXPECT_THROW((void)read_block("SFV2" + good.substr(4), kFloats), Error);
  EXPECT_THROW((void)read_block(good + "more", kFloats), Error);
}

}  // namespace
}  // namespace surefoot::server
