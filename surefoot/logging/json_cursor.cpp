#include "surefoot/logging/json_cursor.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace surefoot::logging {
namespace {

// Appends a code point of the basic multilingual plane as UTF-8.
void append_utf8(std::string& out, unsigned code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0 | code >> 6);
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    out += static_cast<char>(0xE0 | code >> 12);
    out += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  }
}

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

char unescaped(char c) {
  switch (c) {
    case 'n':
      return '\n';
    case 't':
      return '\t';
    case 'r':
      return '\r';
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    default:
      return c;
  }
}

}  // namespace

char JsonCursor::peek() {
  while (position_ < text_.size() && is_space(text_[position_])) ++position_;
  return position_ < text_.size() ? text_[position_] : '\0';
}

void JsonCursor::expect(char c) {
  if (!accept(c)) fail(std::string(1, c).c_str());
}

bool JsonCursor::accept(char c) {
  if (peek() != c) return false;
  ++position_;
  return true;
}

bool JsonCursor::accept_word(std::string_view word) {
  static_cast<void>(peek());
  if (text_.substr(position_, word.size()) != word) return false;
  position_ += word.size();
  return true;
}

double JsonCursor::number() {
  if (peek() == 'n' && accept_word("null")) return std::numeric_limits<double>::quiet_NaN();
  double result = 0.0;
  const char* begin = text_.data() + position_;
  const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), result);
  if (error != std::errc()) fail("a number");
  position_ += static_cast<std::size_t>(end - begin);
  return result;
}

bool JsonCursor::truth() {
  if (accept_word("true")) return true;
  if (!accept_word("false")) fail("true or false");
  return false;
}

// The raw text between quotes.
std::string_view JsonCursor::quoted() {
  expect('"');
  const std::size_t begin = position_;
  while (position_ < text_.size() && text_[position_] != '"')
    position_ += text_[position_] == '\\' ? 2 : 1;
  if (position_ >= text_.size()) fail("the end of a text");
  return text_.substr(begin, position_++ - begin);
}

std::string JsonCursor::string() {
  const std::string_view raw = quoted();
  std::string out;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] != '\\') {
      out += raw[i];
    } else if (raw[++i] != 'u') {
      out += unescaped(raw[i]);
    } else {
      unsigned code = 0;
      const std::string_view digits = raw.substr(i + 1, 4);
      const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16).ptr;
      if (digits.size() != 4 || end != digits.data() + 4) fail("four hexadecimal digits");
      append_utf8(out, code);
      i += 4;
    }
  }
  return out;
}

std::string_view JsonCursor::key() {
  const std::string_view name = quoted();
  expect(':');
  return name;
}

void JsonCursor::skip() {
  int depth = 0;
  do {
    const char c = peek();
    if (c == '\0') fail("a value");
    if (c == '"') {
      static_cast<void>(quoted());
      continue;
    }
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth < 0) fail("a value");
    // Numbers and words end at the next structural character.
    const std::size_t end = text_.find_first_of("{}[],:\" \t\r\n", position_);
    position_ = end == position_ ? end + 1 : std::min(end, text_.size());
  } while (depth > 0);
}

void JsonCursor::fail(const char* expected) const {
  throw JsonError{"expected " + std::string(expected) + " at byte " + std::to_string(position_)};
}

}  // namespace surefoot::logging
