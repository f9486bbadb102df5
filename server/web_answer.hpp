#pragma once

#include "server/web_server.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace surefoot::server {

/// Headers of every answer.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kWebHeaders{{
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
     "img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cache-Control", "no-store"},
}};

/// A target's path and its query, `?a=1&b=2`. None where it is not a plain path.
[[nodiscard]] std::optional<std::pair<std::string, WebContent::Query>> read_target(
    std::string_view target);

/// The answer for a target: a file of the page, or the content's.
[[nodiscard]] WebAnswer answer_for(std::string_view target, WebContent& content);

/// Reads a whole number from a query; keeps `value` where it is not given. Throws Error, with what
/// is valid.
void read_number(const WebContent::Query& query, const char* key, std::uint32_t min,
                 std::uint32_t max, std::uint32_t& value);

/// An answer with a status and a line of text.
[[nodiscard]] WebAnswer refusal(int status, std::string why);

}  // namespace surefoot::server
