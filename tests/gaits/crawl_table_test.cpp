#include "surefoot/gaits/crawl/crawl_table.hpp"

#include "tests/support/messages.hpp"
#include "tests/support/source_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace surefoot::gaits {
namespace {

using test::holds;

/// The table as a Mermaid diagram.
std::string diagram() {
  std::string text = "```mermaid\nstateDiagram-v2\n    [*] --> stand\n";
  for (const CrawlTransition& way : kCrawlTable) {
    text += "    " + std::string(name(way.from)) + " --> " + std::string(name(way.to)) + ": " +
            std::string(way.why) + "\n";
  }
  return text + "```\n";
}

TEST(CrawlTable, IsThePictureInTheDocuments) {
  std::ifstream file(test::source_file("docs/architecture.md"));
  std::stringstream document;
  document << file.rdbuf();
  EXPECT_TRUE(holds(document.str(), diagram())) << "docs/architecture.md should have this:\n"
                                                << diagram();
}

TEST(CrawlTable, NoStateHasTwoWaysForOneCause) {
  for (const CrawlTransition& way : kCrawlTable)
    EXPECT_EQ(find_transition(way.from, way.cause), &way) << way.why;
}

TEST(CrawlTable, NoLabelBreaksTheDiagram) {
  for (const CrawlTransition& way : kCrawlTable)
    EXPECT_EQ(way.why.find_first_of(":;"), std::string_view::npos) << way.why;
}

TEST(CrawlTable, EveryStateCanBeReachedAndLeft) {
  for (const CrawlState state :
       {CrawlState::stand, CrawlState::shift, CrawlState::unload, CrawlState::swing}) {
    bool is_reached = false, is_left = false;
    for (const CrawlTransition& way : kCrawlTable) {
      is_reached = is_reached || (way.to == state && way.from != state);
      is_left = is_left || (way.from == state && way.to != state);
    }
    EXPECT_TRUE(is_reached && is_left) << name(state);
  }
}

}  // namespace
}  // namespace surefoot::gaits
