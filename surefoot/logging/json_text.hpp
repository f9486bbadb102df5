#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace surefoot::logging {

/// Appends compact JSON to a string. Numbers have the shortest text that reads back to the same
/// double. NaN and infinity become null, bytes that are not UTF-8 (possible in file names) U+FFFD.
///
///     JsonText(out).object().member("time", 0.25).member("name", "LF").end_object();
class JsonText {
 public:
  explicit JsonText(std::string& out) : out_(out) {}

  JsonText& object() { return open('{'); }
  JsonText& end_object() { return close('}'); }
  JsonText& array() { return open('['); }
  JsonText& end_array() { return close(']'); }

  JsonText& key(std::string_view name);
  JsonText& value(double number);
  JsonText& value(bool truth) { return plain(truth ? "true" : "false"); }
  JsonText& value(std::string_view text);
  JsonText& value(const char* text) { return value(std::string_view(text)); }
  template <std::integral Integer>
    requires(!std::same_as<Integer, bool>)
  JsonText& value(Integer number) {
    return plain(std::to_string(number));
  }
  /// A list of texts.
  JsonText& value(std::span<const std::string> texts);
  JsonText& null() { return plain("null"); }
  /// Text that already is JSON.
  JsonText& raw(std::string_view json) { return plain(json); }

  template <typename T>
  JsonText& member(std::string_view name, const T& content) {
    return key(name).value(content);
  }

 private:
  JsonText& open(char bracket);
  JsonText& close(char bracket);
  JsonText& plain(std::string_view text);
  void separate();
  void quote(std::string_view text);
  void quote_each(std::string_view text);
  void escape(char c);

  std::string& out_;
  bool comma_ = false;  // the next element needs a comma before it
};

}  // namespace surefoot::logging
