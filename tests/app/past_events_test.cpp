#include "app/past_events.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

TEST(PastEvents, come_in_the_order_of_time) {
  PastEvents past(200);
  EXPECT_EQ(past.json(), "[]");
  past.add(1.0, "a");
  past.add_change(2.0, "b");
  past.add(2.0, "c");
  past.add_change(2.5, "d");
  past.add(3.0, "e");
  EXPECT_EQ(past.json(), "[a,b,c,d,e]");
  past.clear();
  EXPECT_EQ(past.json(), "[]");
}

TEST(PastEvents, changes_are_remembered_for_longer_than_events_but_not_all_of_them) {
  PastEvents past(200);
  past.add(1.0, "touchdown");
  past.add_change(1.0, "first");
  past.add(9.0, "lift-off");
  past.forget_before(5.0);
  EXPECT_EQ(past.json(), "[first,lift-off]");
  for (int i = 0; i < 200; ++i) past.add_change(10.0 + i, "later");
  EXPECT_EQ(past.json().find("first"), std::string::npos);
  EXPECT_EQ(past.json().rfind("[lift-off,later,", 0), 0u);
}

TEST(PastEvents, of_a_force_that_still_acts_or_is_told_to_end_the_begin_is_remembered) {
  const auto force = [](std::string_view kind, std::string_view body, bool begins) {
    return ForceMark{.kind = kind, .body = body, .begins = begins};
  };
  PastEvents past(2);
  past.add(1.0, "on", force("scenario", "base", true));
  past.add(1.5, "leg_on", force("scenario", "LF_SHANK", true));
  past.add(2.0, "leg_off", force("scenario", "LF_SHANK", false));
  past.add_change(2.5, "pull", force("pull", "base", true));
  past.add_change(3.0, "push", ForceMark{.kind = "push", .body = "base", .duration = 0.1});
  for (const double time : {4.0, 5.0}) past.add_change(time, "walk");
  past.forget_before(6.0);
  EXPECT_EQ(past.json(), "[on,pull,walk,walk]");
  past.add_change(7.0, "end", force("pull", "base", false));
  past.add(7.5, "off", force("scenario", "base", false));
  EXPECT_EQ(past.json(), "[on,pull,walk,end,off]");
  past.forget_before(8.0);
  for (const double time : {8.0, 9.0}) past.add_change(time, "stand");
  EXPECT_EQ(past.json(), "[stand,stand]");
  past.add(9.5, "again", force("scenario", "base", true));
  past.forget_before(10.0);
  EXPECT_EQ(past.json(), "[stand,stand,again]");
  past.clear();
  EXPECT_EQ(past.json(), "[]");
}

}  // namespace
}  // namespace surefoot
