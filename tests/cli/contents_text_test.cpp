#include "cli/contents_text.hpp"

#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

namespace surefoot::cli {
namespace {

using test::holds;

TEST(ContentsText, SaysOfASteeredRunThatItsCommandAloneGivesAnother) {
  LogContents contents;
  contents.header.command = "bin/surefoot run step_down";
  EXPECT_FALSE(holds(contents_text("run.mcap", contents), "steered"));
  contents.changes = 30;
  EXPECT_TRUE(holds(contents_text("run.mcap", contents), "steered      30 changes and pushes"));
}

}  // namespace
}  // namespace surefoot::cli
