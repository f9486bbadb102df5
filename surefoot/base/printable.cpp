#include "surefoot/base/printable.hpp"

#include "surefoot/base/formatted.hpp"

namespace surefoot {
namespace {

unsigned byte(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

bool is_ascii_control(unsigned code) { return code < 0x20U || code == 0x7fU; }

/// U+0080 to U+009F are two bytes in UTF-8; the second one is the code.
bool is_later_control(std::string_view text, std::size_t i) {
  return byte(text, i) == 0xc2U && byte(text, i + 1) >= 0x80U && byte(text, i + 1) < 0xa0U;
}

}  // namespace

std::string printable(std::string_view text, std::string_view kept) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_later_control(text, i)) {
      result += formatted("\\u%04x", byte(text, ++i));
    } else if (is_ascii_control(byte(text, i)) && kept.find(text[i]) == std::string_view::npos) {
      result += formatted("\\u%04x", byte(text, i));
    } else {
      result += text[i];
    }
  }
  return result;
}

}  // namespace surefoot
