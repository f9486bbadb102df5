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

}  // namespace
}  // namespace surefoot
