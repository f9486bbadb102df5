#include "cli/contents_text.hpp"

#include <gtest/gtest.h>

namespace surefoot::cli {
namespace {

TEST(ContentsText, SaysOfASteeredRunThatItsCommandAloneGivesAnother) {
  LogContents contents;
  contents.header.command = "bin/surefoot run step_down";
  EXPECT_EQ(contents_text("run.mcap", contents).find("steered"), std::string::npos);
  contents.changes = 30;
  EXPECT_NE(contents_text("run.mcap", contents).find("steered      30 changes and pushes"),
            std::string::npos)
      << contents_text("run.mcap", contents);
}

}  // namespace
}  // namespace surefoot::cli
