#include "surefoot/base/printable.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot {
namespace {

TEST(Printable, AllControlCharactersAreWrittenOut) {
  const char* digits = "0123456789abcdef";
  for (int code = 0; code < 0xa0; ++code) {
    if (code >= 0x20 && code < 0x7f) continue;
    const char byte = static_cast<char>(code);
    const std::string text = code < 0x80 ? std::string(1, byte) : std::string("\xc2") + byte;
    const std::string written = std::string("\\u00") + digits[code / 16] + digits[code % 16];
    EXPECT_EQ(printable("a" + text + "b"), "a" + written + "b");
  }
}

TEST(Printable, WhatMovesNothingStays) {
  // Second bytes of other characters may equal a control character's.
  for (const char* text : {"", " ~", "\xc2\xa0", "°µ", "ä€", "\xc3\x9b", "\xe2\x80\x93", "𝄞"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, WhatIsKeptStays) {
  EXPECT_EQ(printable("a\nb\tc", "\n"), "a\nb\\u0009c");
  EXPECT_EQ(printable("a\nb\tc", "\n\t"), "a\nb\tc");
}

TEST(Printable, HalfACharacterAtTheEndStays) { EXPECT_EQ(printable("a\xc2"), "a\xc2"); }

}  // namespace
}  // namespace surefoot
