#include "tests/support/damaged_bytes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdlib>

namespace surefoot::test {

std::string damaged(std::string bytes, std::mt19937& random) {
  for (auto changes = 1 + random() % 8; changes > 0 && !bytes.empty(); --changes) {
    const std::size_t place = random() % bytes.size();
    switch (random() % 4) {
      case 0:
        bytes[place] = static_cast<char>(random() % 256);
        break;
      case 1:
        bytes.erase(place, 1 + random() % 8);
        break;
      case 2:
        bytes.insert(place, bytes.substr(place, random() % 64));
        break;
      default:
        bytes.resize(place);
    }
  }
  return bytes;
}

std::string damaged_values(const std::string& json, std::mt19937& random) {
  constexpr std::array kNumbers{"0",          "-0.0",   "1",     "-1",   "0.5",   "1e-300",
                                "1e300",      "-1e300", "1e999", "60.1", "300.1", "4001",
                                "2147483648", "null",   "[]",    "\"1\""};
  std::string text;
  bool in_name = false;
  for (std::size_t i = 0; i < json.size();) {
    const auto is_number = [&](std::size_t k) {
      return k < json.size() && (std::isdigit(static_cast<unsigned char>(json[k])) != 0 ||
                                 json[k] == '.' || json[k] == '-');
    };
    if (json[i] == '"') in_name = !in_name;
    std::size_t end = i;
    while (!in_name && is_number(end)) ++end;
    if (end > i && random() % 4 == 0) {
      text += kNumbers[random() % kNumbers.size()];
      i = end;
    } else {
      end = end > i ? end : i + 1;
      text += json.substr(i, end - i);
      i = end;
    }
  }
  return random() % 8 == 0 ? damaged(text, random) : text;
}

int trials(int usual) {
  const char* times = std::getenv("SUREFOOT_FUZZ");
  return usual * std::max(1, times == nullptr ? 1 : std::atoi(times));
}

}  // namespace surefoot::test
