#include "surefoot/config/json_line.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace surefoot::config {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxDepth = 64;

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
}

/// Is the word a number that overflows a double or underflows to 0?
bool is_out_of_range(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  if (*end != '\0') return false;
  const std::string mantissa = word.substr(0, word.find_first_of("eE"));
  const bool is_zero = mantissa.find_first_of("123456789") == std::string::npos;
  return !std::isfinite(number) || (number == 0.0 && !is_zero);
}

/// Index after the text that begins at `begin`.
std::size_t skip_text(std::string_view line, std::size_t begin) {
  std::size_t i = begin + 1;
  while (i < line.size() && line[i] != '"') i += line[i] == '\\' ? 2 : 1;
  return std::min(i + 1, line.size());
}

std::size_t skip_word(std::string_view line, std::size_t begin) {
  std::size_t i = begin;
  while (i < line.size() && is_word(line[i])) ++i;
  return i;
}

std::string quote_out_of_range(std::string_view line) {
  std::string result;
  for (std::size_t i = 0; i < line.size();) {
    const bool is_text = line[i] == '"';
    const std::size_t end =
        is_text ? skip_text(line, i) : (is_word(line[i]) ? skip_word(line, i) : i + 1);
    const std::string word(line.substr(i, end - i));
    const bool is_quoted = !is_text && is_word(line[i]) && is_out_of_range(word);
    result += is_quoted ? '"' + word + '"' : word;
    i = end;
  }
  return result;
}

int depth_of(std::string_view line) {
  int depth = 0, deepest = 0;
  for (std::size_t i = 0; i < line.size(); i = line[i] == '"' ? skip_text(line, i) : i + 1) {
    depth += (line[i] == '[' || line[i] == '{') ? 1 : 0;
    depth -= (line[i] == ']' || line[i] == '}') ? 1 : 0;
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

/// Detects duplicate keys during parsing, as the parsed object keeps only the last one.
class DuplicateKeys {
 public:
  void see(Json::parse_event_t event, const Json& value) {
    using Event = Json::parse_event_t;
    if (event == Event::key) return see_key(value.get_ref<const std::string&>());
    const bool is_end = event == Event::object_end || event == Event::array_end;
    if (is_end) return open_.pop_back();
    if (!open_.empty()) ++open_.back().num_elements;
    if (event != Event::value) open_.push_back({.is_array = event == Event::array_start});
  }

  /// Place and name of the first duplicate key; empty: none.
  [[nodiscard]] const std::string& found() const { return found_; }

 private:
  struct Open {
    bool is_array = false;
    std::size_t num_elements = 0;
    std::string key = {};  ///< the last one read
    std::set<std::string> keys = {};
  };

  static std::string inside(const std::string& key) { return key.empty() ? "" : key + ": "; }

  /// "level 2: " for the array "levels".
  static std::string element(const std::string& array, std::size_t number) {
    const bool is_plural = array.size() > 1 && array.back() == 's';
    const std::string what =
        is_plural ? array.substr(0, array.size() - 1) : inside(array) + "element";
    return what + " " + std::to_string(number) + ": ";
  }

  void see_key(const std::string& key) {
    open_.back().key = key;
    if (open_.back().keys.insert(key).second || !found_.empty()) return;
    std::string above;  // key of the next inner value
    for (const Open& outer : std::span(open_).first(open_.size() - 1)) {
      found_ += outer.is_array ? element(above, outer.num_elements) : inside(above);
      above = outer.is_array ? "" : outer.key;
    }
    found_ += inside(above);
    found_ += "the key \"" + key + "\" is given twice";
  }

  std::vector<Open> open_;
  std::string found_;
};

}  // namespace

Json parse_json_line(std::string_view line, const std::string& place, const std::string& expected) {
  if (depth_of(line) > kMaxDepth) {
    throw FileError(place + ": is nested deeper than " + std::to_string(kMaxDepth) + "; expected " +
                    expected);
  }
  DuplicateKeys keys;
  const auto watch = [&keys](int, Json::parse_event_t event, const Json& value) {
    keys.see(event, value);
    return true;
  };
  Json result;
  try {
    result = Json::parse(quote_out_of_range(line), watch);
  } catch (const Json::exception& error) {
    const std::string what = error.what();
    const std::size_t code = what.find("] ");
    throw FileError(place + ": is not JSON (" +
                    printable(what.substr(code == std::string::npos ? 0 : code + 2)) +
                    "); expected " + expected);
  }
  if (!keys.found().empty())
    throw FileError(place + ": " + printable(keys.found()) + "; expected once");
  return result;
}

}  // namespace surefoot::config
