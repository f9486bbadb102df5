#include "surefoot/logging/json_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace surefoot {

JsonText& JsonText::key(std::string_view name) {
  separate();
  quote(name);
  out_ += ':';
  comma_ = false;
  return *this;
}

JsonText& JsonText::value(double number) {
  if (!std::isfinite(number)) return null();
  // "-0" would be read as an integer, which has no sign.
  if (number == 0.0) return plain(std::signbit(number) ? "-0.0" : "0");
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return plain({text.data(), static_cast<std::size_t>(end - text.data())});
}

JsonText& JsonText::value(std::string_view text) {
  separate();
  quote(text);
  comma_ = true;
  return *this;
}

JsonText& JsonText::open(char bracket) {
  separate();
  out_ += bracket;
  comma_ = false;
  return *this;
}

JsonText& JsonText::close(char bracket) {
  out_ += bracket;
  comma_ = true;
  return *this;
}

JsonText& JsonText::plain(std::string_view text) {
  separate();
  out_ += text;
  comma_ = true;
  return *this;
}

void JsonText::separate() {
  if (comma_) out_ += ',';
}

void JsonText::quote(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  out_ += '"';
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out_ += '\\';
      out_ += c;
    } else if (code >= 0x20) {
      out_ += c;
    } else {
      out_ += "\\u00";
      out_ += kHex[code >> 4];
      out_ += kHex[code & 15];
    }
  }
  out_ += '"';
}

}  // namespace surefoot
