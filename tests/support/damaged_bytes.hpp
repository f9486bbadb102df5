#pragma once

#include <random>
#include <string>

namespace surefoot::test {

/// Bytes of something good, some of them changed, taken out or doubled.
[[nodiscard]] std::string damaged(std::string bytes, std::mt19937& random);

/// A good JSON text, some of whose numbers are others: too large, too small, none at all. Now and
/// then its bytes are damaged as well.
[[nodiscard]] std::string damaged_values(const std::string& json, std::mt19937& random);

/// How many trials a test with damaged bytes makes: as usual, or SUREFOOT_FUZZ times as many.
[[nodiscard]] int trials(int usual);

}  // namespace surefoot::test
