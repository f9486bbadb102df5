#include "surefoot/logging/tick_clock.hpp"

#include <gtest/gtest.h>

namespace surefoot::logging {
namespace {

constexpr double kPeriod = 0.0025, kBegin = 100.0;

TEST(TickClock, WhatIsLostBeforeTheFirstTickIsCountedFromWhereItBegan) {
  TickClock clock(kPeriod);
  clock.lose(kBegin);
  clock.lose(kBegin + 1.0);
  clock.add(kBegin + 2.0);
  EXPECT_FALSE(clock.follows());
  EXPECT_EQ(clock.lost(), 800u);
  clock.add(kBegin + 2.0 + kPeriod);
  EXPECT_TRUE(clock.follows());
  EXPECT_EQ(clock.lost(), 800u);
}

TEST(TickClock, OfWhatIsLostBeforeTheFirstTickAtAnUnknownTimeNoTicksAreCounted) {
  TickClock clock(kPeriod);
  clock.lose({});
  clock.end(kBegin);
  EXPECT_EQ(clock.lost(), 0u);
  clock.add(kBegin);
  EXPECT_FALSE(clock.follows()) << "there may be some";
  EXPECT_EQ(clock.lost(), 0u);
  clock.lose({});
  clock.add(kBegin + 1.0);
  EXPECT_FALSE(clock.follows());
  EXPECT_EQ(clock.lost(), 399u);
}

}  // namespace
}  // namespace surefoot::logging
