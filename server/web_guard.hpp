#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// The names of this server. A browser that asks for other names acts for a foreign page (DNS
/// rebinding, cross-site requests).
class OwnNames {
 public:
  /// `hosts` as in a link, without the port: "127.0.0.1", "localhost", "[::1]".
  OwnNames(const std::vector<std::string>& hosts, std::uint16_t port);

  /// Whether the header `Host` is one of the names.
  [[nodiscard]] bool has_host(std::string_view host) const;
  /// Whether the header `Origin` is "http://" and one of the names.
  [[nodiscard]] bool has_origin(std::string_view origin) const;
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
};

/// Compares in a time that does not depend on the first difference.
[[nodiscard]] bool is_same_secret(std::string_view given, std::string_view secret);

/// 128 random bits, as 32 hexadecimal digits.
[[nodiscard]] std::string random_token();

/// Throws Error unless the token can stand in a link and is long enough not to be guessed.
void check_token(const std::string& token);

/// Allows so many messages a second, and as many at once.
class RateLimit {
 public:
  explicit RateLimit(double per_second) : per_second_(per_second), left_(per_second) {}

  /// Counts a message; false: too many.
  [[nodiscard]] bool take(std::chrono::steady_clock::time_point now);

 private:
  double per_second_, left_;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace surefoot::server
