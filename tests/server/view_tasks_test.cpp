#include "server/view_tasks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace surefoot::server {
namespace {

control::StackOptions stack(const std::vector<std::string>& names) {
  control::StackOptions stack;
  for (const std::string& name : names) stack.levels.push_back({.name = name, .tasks = {}});
  return stack;
}

std::string told(const std::vector<std::string>& after) {
  return change_text(stack({"a", "b", "c", "d", "e"}), stack(after));
}

TEST(ViewTasks, of_an_order_it_is_told_what_moved) {
  EXPECT_EQ(told({"a", "b", "c", "d", "e"}), "");
  EXPECT_EQ(told({"a", "e", "b", "c", "d"}), "order: e from 5 to 2");
  EXPECT_EQ(told({"b", "c", "d", "a", "e"}), "order: a from 1 to 4");
  EXPECT_EQ(told({"a", "c", "b", "d", "e"}), "order: c from 3 to 2");
  EXPECT_EQ(told({"a", "d", "c", "b", "e"}), "order from 2: d, c, b");
}

TEST(ViewTasks, what_was_moved_alone_is_told_alone_from_anywhere_to_anywhere) {
  std::mt19937 random(11);
  const std::vector<std::string> names{"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k"};
  for (int round = 0; round < 200; ++round) {
    const std::size_t from = random() % names.size();
    const std::size_t to = (from + 1 + random() % (names.size() - 1)) % names.size();
    std::vector<std::string> after = names;
    after.erase(after.begin() + static_cast<std::ptrdiff_t>(from));
    after.insert(after.begin() + static_cast<std::ptrdiff_t>(to), names[from]);
    const std::string text = change_text(stack(names), stack(after));
    EXPECT_EQ(std::ranges::count(text, ','), 0) << text;
    const bool are_neighbours = from == to + 1 || to == from + 1;  // either may be said to move
    EXPECT_TRUE(are_neighbours || text.starts_with("order: " + names[from])) << text;
  }
}

}  // namespace
}  // namespace surefoot::server
