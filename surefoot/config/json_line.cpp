#include "surefoot/config/json_line.hpp"

#include "surefoot/base/error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDeepest = 64;

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
}

/// A number, but none that is finite.
bool is_not_finite(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  return *end == '\0' && !std::isfinite(number);
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

std::string quote_what_is_not_finite(std::string_view line) {
  std::string result;
  for (std::size_t i = 0; i < line.size();) {
    const bool is_text = line[i] == '"';
    const std::size_t end =
        is_text ? skip_text(line, i) : (is_word(line[i]) ? skip_word(line, i) : i + 1);
    const std::string word(line.substr(i, end - i));
    const bool is_quoted = !is_text && is_word(line[i]) && is_not_finite(word);
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

}  // namespace

Json parse_json_line(std::string_view line, const std::string& place, const std::string& expected) {
  if (depth_of(line) > kDeepest) {
    throw FileError(place + ": is nested deeper than " + std::to_string(kDeepest) + "; expected " +
                    expected);
  }
  try {
    return Json::parse(quote_what_is_not_finite(line));
  } catch (const Json::exception& error) {
    const std::string what = error.what();
    const std::size_t code = what.find("] ");
    throw FileError(place + ": is not JSON (" +
                    what.substr(code == std::string::npos ? 0 : code + 2) + "); expected " +
                    expected);
  }
}

}  // namespace surefoot
