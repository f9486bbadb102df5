#include "surefoot/control/part_fault.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot::control {
namespace {

TEST(PartFault, ALongTextIsCutBetweenLetters) {
  for (const std::size_t size : {237u, 238u, 239u, 240u}) {
    const std::string word(size, 'a');
    PartFault fault;
    fault.set(word, "ö");
    EXPECT_EQ(fault.text(), size < 239 ? word + "ö" : word);
  }
}

}  // namespace
}  // namespace surefoot::control
