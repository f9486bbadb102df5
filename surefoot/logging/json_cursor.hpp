#pragma once

#include "surefoot/base/error.hpp"

#include <string>
#include <string_view>

namespace surefoot::logging {

/// Invalid JSON, or a value of another kind than requested.
class JsonError : public Error {
 public:
  using Error::Error;
};

/// Reads JSON from front to back without building a tree: fast enough for each message of a log.
/// Every read throws JsonError on other text.
class JsonCursor {
 public:
  explicit JsonCursor(std::string_view text) : text_(text) {}

  /// The next byte that is not white space; '\0' at the end.
  [[nodiscard]] char peek();
  /// Takes this byte, which must be next.
  void expect(char c);
  /// Takes this byte if it is the next.
  [[nodiscard]] bool accept(char c);

  /// A number; null is NaN.
  [[nodiscard]] double number();
  [[nodiscard]] bool truth();
  [[nodiscard]] std::string string();
  /// A member's name, unescaped, and its colon.
  [[nodiscard]] std::string_view key();
  /// Skips any value.
  void skip();

  [[nodiscard]] std::size_t position() const { return position_; }
  void go_to(std::size_t position) { position_ = position; }

 private:
  [[nodiscard]] bool accept_word(std::string_view word);
  [[nodiscard]] std::string_view quoted();
  [[noreturn]] void fail(const char* expected) const;

  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace surefoot::logging
