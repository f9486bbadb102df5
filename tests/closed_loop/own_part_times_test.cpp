#include "surefoot/closed_loop/own_part_times.hpp"

#include <gtest/gtest.h>

namespace surefoot::closed_loop {
namespace {

/// Of three ticks whose stages take these times [µs].
std::vector<std::string> notes_of(const std::vector<std::string>& own_parts, const TickTiming& one,
                                  const TickTiming& another) {
  OwnPartTimes times(own_parts, 0.0025);
  for (const TickTiming& timing : {one, another, one}) times.add(timing);
  return times.notes();
}

TEST(OwnPartTimes, those_above_the_tick_in_the_median_are_told_with_their_names) {
  const std::vector<std::string> all{"estimator", "planner", "gait sway", "task a", "task b"};
  const TickTiming fast{.estimate = 2400.0, .plan = 900.0, .stack = 80.0};
  const TickTiming slow{.estimate = 3000.0, .plan = 10123.0, .stack = 2600.0};
  EXPECT_TRUE(notes_of(all, fast, slow).empty()) << "one slow tick of three";
  EXPECT_EQ(notes_of(all, slow, fast),
            (std::vector<std::string>{
                "the stage of your own estimator takes 3 ms in the median, and a tick has 2.5 ms",
                "the stage of your own planner and gait sway takes 10.1 ms in the median, and a "
                "tick has 2.5 ms",
                "the stage of your own task a and task b takes 2.6 ms in the median, and a tick "
                "has 2.5 ms"}));
  EXPECT_EQ(notes_of({"task a"}, slow, slow).size(), 1u) << "the library's are not the user's";
  EXPECT_TRUE(notes_of({}, slow, slow).empty());
  EXPECT_TRUE(notes_of(all, {}, {}).empty()) << "nothing was measured";
}

}  // namespace
}  // namespace surefoot::closed_loop
