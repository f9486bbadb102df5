#include "server/web_guard.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>
#include <array>
#include <random>

namespace surefoot::server {
namespace {

constexpr std::string_view kScheme = "http://";
constexpr std::uint16_t kDefaultPort = 80;  // left out by browsers
constexpr std::size_t kShortestToken = 16;
constexpr std::size_t kLongestToken = 128;

}  // namespace

OwnNames::OwnNames(const std::vector<std::string>& hosts, std::uint16_t port) {
  for (const std::string& host : hosts) {
    names_.push_back(host + ":" + std::to_string(port));
    if (port == kDefaultPort) names_.push_back(host);
  }
}

bool OwnNames::has_host(std::string_view host) const {
  return std::ranges::find(names_, host) != names_.end();
}

bool OwnNames::has_origin(std::string_view origin) const {
  return origin.starts_with(kScheme) && has_host(origin.substr(kScheme.size()));
}

bool is_same_secret(std::string_view given, std::string_view secret) {
  unsigned difference = given.size() == secret.size() ? 0U : 1U;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const char other = given.empty() ? '\0' : given[i % given.size()];
    difference |= static_cast<unsigned>(static_cast<unsigned char>(other) ^
                                        static_cast<unsigned char>(secret[i]));
  }
  return difference == 0U && !secret.empty();
}

std::string random_token() {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::random_device source;  // the system's random source
  std::string token;
  for (int word = 0; word < 4; ++word) {
    unsigned bits = source();
    for (int digit = 0; digit < 8; ++digit, bits >>= 4U) token += kDigits[bits & 0xFU];
  }
  return token;
}

void check_token(const std::string& token) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  };
  if (token.size() >= kShortestToken && token.size() <= kLongestToken &&
      std::ranges::all_of(token, is_plain)) {
    return;
  }
  throw Error("the token has " + std::to_string(token.size()) +
              " characters; valid are 16 to 128 letters, digits, - and _");
}

bool RateLimit::take(std::chrono::steady_clock::time_point now) {
  if (last_ != std::chrono::steady_clock::time_point{}) {
    const std::chrono::duration<double> passed = now - last_;
    left_ = std::min(per_second_, left_ + per_second_ * passed.count());
  }
  last_ = now;
  if (left_ < 1.0) return false;
  left_ -= 1.0;
  return true;
}

}  // namespace surefoot::server
