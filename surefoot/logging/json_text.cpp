#include "surefoot/logging/json_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace surefoot::logging {
namespace {

bool needs_escape(char c) { return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20; }

bool is_plain(char c) { return !needs_escape(c) && static_cast<unsigned char>(c) < 0x80; }

/// Bytes of a text's first UTF-8 character; 0 if invalid.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80U) return 1;
  if (first < 0xC2U || first > 0xF4U) return 0;
  const std::size_t length = first < 0xE0U ? 2 : first < 0xF0U ? 3 : 4;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  // Overlong, a surrogate, or beyond U+10FFFF.
  const bool is_none = (first == 0xE0U && second < 0xA0U) || (first == 0xEDU && second > 0x9FU) ||
                       (first == 0xF0U && second < 0x90U) || (first == 0xF4U && second > 0x8FU);
  return is_none ? 0 : length;
}

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
  // "-0" would be read as an integer, without a sign.
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
  if (std::all_of(text.begin(), text.end(), is_plain)) {
    out_ += text;
  } else {
    quote_each(text);
  }
  out_ += '"';
}

void JsonText::quote_each(std::string_view text) {
  constexpr std::string_view kReplacement = "\uFFFD";
  while (!text.empty()) {
    const std::size_t length = character(text);
    if (length == 1) {
      escape(text.front());
    } else {
      out_ += length == 0 ? kReplacement : text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
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

}  // namespace surefoot::logging
