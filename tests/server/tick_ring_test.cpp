#include "server/tick_ring.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace surefoot::server {
namespace {

TEST(TickRing, holds_so_many_and_has_no_room_for_more) {
  TickRing<int> ring(3);
  for (int i = 0; i < 3; ++i) {
    int* place = ring.next_to_write();
    ASSERT_NE(place, nullptr);
    *place = i;
    ring.written();
  }
  EXPECT_EQ(ring.next_to_write(), nullptr);
  ASSERT_NE(ring.next_to_read(), nullptr);
  EXPECT_EQ(*ring.next_to_read(), 0);
  ring.read();
  EXPECT_NE(ring.next_to_write(), nullptr);
}

TEST(TickRing, what_one_thread_writes_another_reads_in_order_and_whole) {
  struct Pair {
    long a = 0, b = 0;
  };
  TickRing<Pair> ring(16);
  constexpr long kCount = 200000;
  long lost = 0;
  std::thread writer([&] {
    for (long i = 1; i <= kCount; ++i) {
      Pair* place = ring.next_to_write();
      if (place == nullptr) {
        ++lost;
        if (i < kCount) continue;
        while ((place = ring.next_to_write()) == nullptr) std::this_thread::yield();
        --lost;
      }
      *place = {i, -i};
      ring.written();
    }
  });
  long read = 0, last = 0;
  while (last < kCount) {
    const Pair* pair = ring.next_to_read();
    if (pair == nullptr) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_GT(pair->a, last);
    ASSERT_EQ(pair->b, -pair->a);
    last = pair->a;
    ++read;
    ring.read();
  }
  writer.join();
  EXPECT_EQ(read + lost, kCount);
}

}  // namespace
}  // namespace surefoot::server
