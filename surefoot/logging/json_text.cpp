#include "surefoot/logging/json_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace surefoot {
namespace {

bool needs_escape(char c) { return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20; }

}  // namespace

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

JsonText& JsonText::value(std::span<const std::string> texts) {
  array();
  for (const std::string& text : texts) value(std::string_view(text));
  return end_array();
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
  out_ += '"';
  if (std::none_of(text.begin(), text.end(), needs_escape)) {
    out_ += text;
  } else {
    for (const char c : text) escape(c);
  }
  out_ += '"';
}

void JsonText::escape(char c) {
  constexpr std::string_view kHex = "0123456789abcdef";
  if (!needs_escape(c)) {
    out_ += c;
  } else if (c == '"' || c == '\\') {
    out_ += '\\';
    out_ += c;
  } else {
    out_ += "\\u00";
    out_ += kHex[static_cast<std::size_t>(c >> 4)];
    out_ += kHex[static_cast<std::size_t>(c & 15)];
  }
}

}  // namespace surefoot
