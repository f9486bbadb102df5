#include "cli/progress.hpp"

#include <gtest/gtest.h>

namespace surefoot::cli {
namespace {

TEST(TimeLeft, is_told_of_what_takes_longer_than_a_minute) {
  EXPECT_EQ(time_left(20.0, 0.25), ", about 60 s left");
  EXPECT_EQ(time_left(100.0, 0.25), ", about 5 min left");
  EXPECT_EQ(time_left(90.0, 1.0), "");
  EXPECT_EQ(time_left(20.0, 0.5), "");
}

TEST(TimeLeft, is_not_told_before_anything_is_known) {
  EXPECT_EQ(time_left(1.0, 0.001), "");
  EXPECT_EQ(time_left(30.0, 0.0), "");
  EXPECT_EQ(time_left(30.0, 0.04), "");
}

}  // namespace
}  // namespace surefoot::cli
