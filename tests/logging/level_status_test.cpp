#include "surefoot/logging/level_status.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace surefoot::logging {
namespace {

/// Three levels with rows, of which the second was missed, and one without.
HierarchyReport example() {
  HierarchyReport report;
  report.num_levels = 4;
  for (const std::size_t k : {0u, 1u, 2u}) report.levels[k].num_rows = 6;
  report.levels[0].residual = 1e-8;
  report.levels[1].residual = 0.3;
  return report;
}

std::vector<std::string_view> words(const HierarchyReport& report) {
  std::vector<std::string_view> words;
  for (std::size_t k = 0; k < 4; ++k) words.push_back(name_of(level_status(report, k)));
  return words;
}

using Words = std::vector<std::string_view>;

TEST(LevelStatus, SaysWhetherALevelWasMet) {
  EXPECT_EQ(words(example()), (Words{"met", "missed", "met", "no rows"}));
}

TEST(LevelStatus, OfASolveThatWasCutOffSaysWhere) {
  HierarchyReport report = example();
  report.status = 1;
  report.failed_level = 2;
  EXPECT_EQ(words(report), (Words{"met", "missed", "cut off", "not reached"}));
  report.failed_level = 0;
  EXPECT_EQ(words(report), (Words{"cut off", "not reached", "not reached", "not reached"}));
  report.failed_level = 4;
  EXPECT_EQ(words(report), words(example())) << "all are finished, x is only not the shortest";
}

TEST(LevelStatus, WhereNothingWasSolvedNoLevelWas) {
  HierarchyReport report = example();
  report.status = 2;
  EXPECT_EQ(words(report), (Words{"not solved", "not solved", "not solved", "not solved"}));
}

}  // namespace
}  // namespace surefoot::logging
