#include "server/mailbox.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace surefoot::server {
namespace {

TEST(Mailbox, letters_come_out_once_and_in_order) {
  Mailbox<std::string> box;
  EXPECT_TRUE(box.take().empty());
  for (const char* letter : {"a", "b", "c"}) box.put(letter);
  EXPECT_EQ(box.take(), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(box.take().empty());
  box.put("never taken");
}

TEST(Mailbox, none_is_lost_or_turned_while_another_thread_takes_them) {
  constexpr int kLetters = 200000;
  Mailbox<int> box;
  std::thread writer([&] {
    for (int i = 0; i < kLetters; ++i) box.put(i);
  });
  std::vector<int> all;
  while (all.size() < kLetters)
    for (const int letter : box.take()) all.push_back(letter);
  writer.join();
  for (int i = 0; i < kLetters; ++i) ASSERT_EQ(all[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace surefoot::server
