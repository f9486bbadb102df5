#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// The names under which a server may be asked: whatever else a browser says that it wants comes
/// from a page that has no business here (DNS rebinding, requests across sites).
class OwnNames {
 public:
  /// `hosts` as in a link, without the port: "127.0.0.1", "localhost", "[::1]".
  OwnNames(const std::vector<std::string>& hosts, std::uint16_t port);

  /// Of the header `Host`: one of the names, exactly.
  [[nodiscard]] bool has_host(std::string_view host) const;
  /// Of the header `Origin`: "http://" before one of the names, exactly.
  [[nodiscard]] bool has_origin(std::string_view origin) const;
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
};

/// The same, in a time that does not depend on where they differ.
[[nodiscard]] bool is_same_secret(std::string_view given, std::string_view secret);

/// 128 random bits, as 32 hexadecimal digits.
[[nodiscard]] std::string random_token();

/// Throws Error unless the token can stand in a link and is long enough not to be guessed.
void check_token(const std::string& token);

/// So many messages a second, and as many at once.
class RateLimit {
 public:
  explicit RateLimit(double per_second) : per_second_(per_second), left_(per_second) {}

  /// False for one too many.
  [[nodiscard]] bool take(std::chrono::steady_clock::time_point now);

 private:
  double per_second_, left_;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace surefoot::server
