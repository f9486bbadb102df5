#include "server/web_guard.hpp"

#include "surefoot/base/error.hpp"

#include <gtest/gtest.h>

namespace surefoot::server {
namespace {

const OwnNames kNames({"127.0.0.1", "localhost", "[::1]"}, 7373);

TEST(WebGuard, only_the_very_names_of_the_server_are_its_own) {
  for (const char* name : {"127.0.0.1:7373", "localhost:7373", "[::1]:7373"}) {
    EXPECT_TRUE(kNames.has_host(name)) << name;
    EXPECT_TRUE(kNames.has_origin("http://" + std::string(name))) << name;
  }
  for (const char* name :
       {"", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:73730", "127.attacker.example:7373",
        "127.0.0.1.attacker.example:7373", "localhost:7373.", "LOCALHOST:7373",
        "evil@localhost:7373", "127.0.0.2:7373", "0x7f000001:7373", " localhost:7373",
        "localhost:7373,localhost:7373"}) {
    EXPECT_FALSE(kNames.has_host(name)) << name;
    EXPECT_FALSE(kNames.has_origin("http://" + std::string(name))) << name;
  }
  for (const char* origin : {"null", "https://127.0.0.1:7373", "127.0.0.1:7373", "http://",
                             "http://127.0.0.1:7373/", "HTTP://127.0.0.1:7373"}) {
    EXPECT_FALSE(kNames.has_origin(origin)) << origin;
  }
}

TEST(WebGuard, at_port_80_a_browser_leaves_the_port_out) {
  const OwnNames names({"localhost"}, 80);
  EXPECT_TRUE(names.has_host("localhost"));
  EXPECT_TRUE(names.has_origin("http://localhost"));
}

TEST(WebGuard, a_secret_is_the_same_only_if_all_of_it_is) {
  EXPECT_TRUE(is_same_secret("0123456789abcdef", "0123456789abcdef"));
  for (const char* given : {"", "0", "0123456789abcdeX", "X123456789abcdef", "0123456789abcdef0",
                            "0123456789abcde", "0123456789abcdef0123456789abcdef"}) {
    EXPECT_FALSE(is_same_secret(given, "0123456789abcdef")) << given;
  }
  EXPECT_FALSE(is_same_secret("", "")) << "no secret is none";
}

TEST(WebGuard, every_token_is_another_and_can_stand_in_a_link) {
  const std::string first = random_token(), second = random_token();
  EXPECT_EQ(first.size(), 32u);
  EXPECT_NE(first, second);
  EXPECT_NO_THROW(check_token(first));
  EXPECT_NO_THROW(check_token("my-own_secret-of-16"));
  for (const char* bad : {"", "short", "with space in it 123", "with/slash/in/it/12345"}) {
    EXPECT_THROW(check_token(bad), Error) << bad;
  }
}

TEST(WebGuard, messages_beyond_the_rate_are_refused_and_later_ones_not) {
  RateLimit rate(60.0);
  const std::chrono::steady_clock::time_point start{std::chrono::seconds(100)};
  int taken = 0;
  for (int i = 0; i < 200; ++i) taken += rate.take(start) ? 1 : 0;
  EXPECT_EQ(taken, 60);
  EXPECT_FALSE(rate.take(start + std::chrono::milliseconds(10)));
  EXPECT_TRUE(rate.take(start + std::chrono::milliseconds(40)));
}

}  // namespace
}  // namespace surefoot::server
