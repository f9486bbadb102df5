#include "surefoot/logging/change_count.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

logged::Change change(const std::string& kind) {
  logged::Change change;
  change.kind = kind;
  return change;
}

logged::Change pull(const std::string& body, double force) {
  logged::Change change;
  change.kind = "pull";
  change.body = body;
  change.force = Vec3(force, 0.0, 0.0);
  return change;
}

TEST(ChangeCount, CountsAPullOnceHoweverManyMessagesFollowTheHand) {
  ChangeCount changes;
  for (const double force : {10.0, 20.0, 30.0, 5.0, 0.0}) changes.add(pull("base", force));
  EXPECT_EQ(changes.count(), 1);
  for (const double force : {10.0, 20.0, 0.0}) changes.add(pull("base", force));
  EXPECT_EQ(changes.count(), 2);
}

TEST(ChangeCount, CountsAPullAtAnotherBodyAndChangesMeanwhile) {
  ChangeCount changes;
  changes.add(pull("base", 10.0));
  changes.add(change("friction"));
  changes.add(pull("base", 12.0));
  changes.add(pull("LF_SHANK", 12.0));
  changes.add(pull("", 0.0));
  changes.add(change("push"));
  changes.add(change("push"));
  EXPECT_EQ(changes.count(), 5);
}

TEST(ChangeCount, TakesWhatMakesNoSenseForAChange) {
  ChangeCount changes;
  changes.add("{\"kind\": 7}");
  changes.add("{\"kind\": \"pull\", \"body\": \"base\", \"force\": [1, 0, 0]}");
  changes.add("{\"kind\": \"pull\", \"body\": \"base\", \"force\": [2, 0, 0]}");
  EXPECT_EQ(changes.count(), 2);
}

}  // namespace
}  // namespace surefoot
