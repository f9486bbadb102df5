#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

/// Reading of MCAP records, shared by those who read a file from front to back and by chunks.
namespace surefoot::mcap {

/// What a record claims does not fit into its bytes.
struct Malformed {
  const char* what;
};

/// Takes values from the front of some bytes. Throws Malformed beyond their end.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  std::string_view bytes(std::uint64_t count);

  template <std::unsigned_integral Integer>
  Integer number() {
    Integer result = 0;
    unsigned shift = 0;
    for (const char byte : bytes(sizeof(Integer))) {
      result = static_cast<Integer>(result | static_cast<Integer>(static_cast<unsigned char>(byte))
                                                 << shift);
      shift += 8;
    }
    return result;
  }

  std::string text() { return std::string(bytes(number<std::uint32_t>())); }
  std::map<std::string, std::string> map();

  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// The records in a chunk record, decompressed and with the right checksum. Throws Malformed.
[[nodiscard]] std::string chunk_records(std::string_view chunk);

}  // namespace surefoot::mcap
