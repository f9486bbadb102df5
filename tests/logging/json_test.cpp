#include "surefoot/logging/json_cursor.hpp"
#include "surefoot/logging/json_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace surefoot::logging {
namespace {

std::string written(double number) {
  std::string text;
  JsonText(text).value(number);
  return text;
}

TEST(Json, EveryFiniteNumberIsReadBackBitByBit) {
  std::mt19937_64 random(1);
  int finite = 0;
  while (finite < 100000) {
    const auto number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    ++finite;
    const std::string text = written(number);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(JsonCursor(text).number()),
              std::bit_cast<std::uint64_t>(number))
        << text;
    ASSERT_EQ(nlohmann::json::parse(text).get<double>(), number) << text;
  }
}

TEST(Json, ATextIsJsonWhateverItsBytesAre) {
  const auto quoted = [](std::string_view text) {
    std::string out;
    JsonText(out).value(text);
    return out;
  };
  for (const char* text : {"plain", "N·m", "ä\u20AC\U0001F916", "\"\\\n\x7f"}) {
    EXPECT_EQ(nlohmann::json::parse(quoted(text)).get<std::string>(), text);
    EXPECT_EQ(JsonCursor(quoted(text)).string(), text);
  }
  for (const char* bytes :
       {"\xe4", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"}) {
    const std::string text = nlohmann::json::parse(quoted("a" + std::string(bytes) + "\"b"));
    EXPECT_TRUE(text.starts_with("a\uFFFD") && text.ends_with("\"b")) << text;
  }
}

TEST(Json, NegativeZeroKeepsItsSignInOtherReadersToo) {
  EXPECT_TRUE(std::signbit(JsonCursor(written(-0.0)).number()));
  EXPECT_TRUE(std::signbit(nlohmann::json::parse(written(-0.0)).get<double>()));
  EXPECT_FALSE(std::signbit(JsonCursor(written(0.0)).number()));
}

TEST(Json, WhatJsonHasNoNumberForIsNullAndReadsAsNaN) {
  for (const double number : {std::nan(""), std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(written(number), "null");
  }
  EXPECT_TRUE(std::isnan(JsonCursor("null").number()));
}

TEST(Json, AnyTextIsReadBack) {
  for (const std::string text :
       {"", "plain", "quote \" backslash \\ slash /", "line\nbreak\ttab", "\x01\x1f", "µ · Ω"}) {
    std::string json;
    JsonText(json).value(std::string_view(text));
    EXPECT_EQ(JsonCursor(json).string(), text);
    EXPECT_EQ(nlohmann::json::parse(json).get<std::string>(), text);
  }
}

TEST(Json, EscapesOfOtherWritersAreUnderstood) {
  EXPECT_EQ(JsonCursor(R"("a\u00b5\u2264\n\/b")").string(), "aµ≤\n/b");
}

TEST(Json, CommasStandBetweenElementsOnly) {
  std::string text;
  JsonText(text)
      .object()
      .member("a", 1)
      .key("b")
      .array()
      .value(true)
      .array()
      .end_array()
      .null()
      .end_array()
      .key("c")
      .object()
      .end_object()
      .end_object();
  EXPECT_EQ(text, R"({"a":1,"b":[true,[],null],"c":{}})");
}

TEST(Json, SkipPassesOverAnyValue) {
  for (const std::string value :
       {"1", "-1.5e-3", "null", "\"a]}\\\"\"", "[]", "{}", R"({"a":[1,{"b":"]"}],"c":2})"}) {
    JsonCursor cursor("[" + value + ",7]");
    const std::string text = "[" + value + ",7]";
    cursor = JsonCursor(text);
    cursor.expect('[');
    cursor.skip();
    cursor.expect(',');
    EXPECT_EQ(cursor.number(), 7.0) << value;
  }
}

TEST(Json, WhatIsCutOffIsAnError) {
  const std::string whole = R"({"name":"x\"y","list":[1,2.5,{"deep":null}]})";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    JsonCursor cursor(std::string_view(whole).substr(0, length));
    EXPECT_THROW(cursor.skip(), JsonError) << whole.substr(0, length);
  }
}

}  // namespace
}  // namespace surefoot::logging
