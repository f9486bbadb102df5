#include "surefoot/config/hierarchy_json.hpp"

#include "surefoot/math/numbers.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/seeds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace surefoot::config {
namespace {

using test::holds;

solver::Hierarchy parse(const std::string& line) {
  return parse_hierarchy(line, "stack.jsonl:3").hierarchy;
}

std::string error_of(const std::string& line) {
  return test::message_of([&] { (void)parse(line); });
}

void expect_error(const std::string& line, const std::string& part) {
  const std::string message = error_of(line);
  EXPECT_EQ(message.find("stack.jsonl:3: "), 0u) << message;
  EXPECT_TRUE(holds(message, part));
}

TEST(HierarchyJson, ReadsEqualitiesAndInequalities) {
  const solver::Hierarchy hierarchy =
      parse(R"({"levels":[{"A":[[1,2.5]],"b":[3],"D":[[4,5],[6,7]],"f":[8,-9e-1]}]})");
  ASSERT_EQ(hierarchy.unknowns(), 2);
  ASSERT_EQ(hierarchy.num_levels(), 1u);
  const solver::Level& level = hierarchy.level(0);
  ASSERT_EQ(level.num_rows(), 3);
  EXPECT_EQ(level.A()(0, 1), 2.5);
  EXPECT_EQ(level.A()(2, 0), 6.0);
  EXPECT_EQ(level.lower()[0], 3.0);
  EXPECT_EQ(level.upper()[0], 3.0);
  EXPECT_EQ(level.lower()[2], -kInfinity);
  EXPECT_EQ(level.upper()[2], -0.9);
}

TEST(HierarchyJson, EmptyAndMissingBlocksAreAllowed) {
  const solver::Hierarchy hierarchy =
      parse(R"({"levels":[{"A":[],"b":[],"D":[],"f":[]},{"A":[[1]],"b":[2]},{}]})");
  ASSERT_EQ(hierarchy.num_levels(), 3u);
  EXPECT_EQ(hierarchy.level(0).num_rows(), 0);
  EXPECT_EQ(hierarchy.level(1).num_rows(), 1);
  EXPECT_EQ(hierarchy.level(2).num_rows(), 0);
}

/// The rows of a level in the order in which they are written.
std::vector<Eigen::Index> as_written(const solver::Level& level) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(level.num_rows()));
  std::iota(rows.begin(), rows.end(), 0);
  std::ranges::stable_partition(
      rows, [&](Eigen::Index i) { return level.lower()[i] == level.upper()[i]; });
  return rows;
}

TEST(HierarchyJson, WhatIsWrittenReadsBackToTheSameRowsBoundsAndIds) {
  int two_sided = 0;
  for (test::SeededRandom& random : test::Seeds(50)) {
    solver::Hierarchy original(5);
    for (const test::LevelData& level : test::random_levels(random, {.unknowns = 5, .levels = 4})) {
      const std::size_t k = original.add_level("any", level.A.rows());
      for (Eigen::Index i = 0; i < level.A.rows(); ++i) {
        solver::Rows row =
            original.level(k).add(1, 10 * static_cast<int>(i) + random.integer(0, 9));
        row.A = level.A.row(i);
        row.lower[0] = random.chance(0.3) ? -kInfinity : level.lower[i];
        row.upper[0] = level.upper[i];
        if (row.lower[0] == -kInfinity && row.upper[0] == kInfinity) row.upper[0] = 1.0;
      }
    }
    const solver::Hierarchy copy = parse(format_hierarchy(original));
    ASSERT_EQ(format_hierarchy(copy), format_hierarchy(original));
    for (std::size_t k = 0; k < original.num_levels(); ++k) {
      const solver::Level &from = original.level(k), &to = copy.level(k);
      const std::vector<Eigen::Index> rows = as_written(from);
      ASSERT_EQ(to.num_rows(), from.num_rows());
      for (Eigen::Index i = 0; i < to.num_rows(); ++i) {
        const Eigen::Index row = rows[static_cast<std::size_t>(i)];
        ASSERT_EQ(to.A().row(i), from.A().row(row));
        ASSERT_EQ(to.lower()[i], from.lower()[row]);
        ASSERT_EQ(to.upper()[i], from.upper()[row]);
        ASSERT_EQ(to.id(i), from.id(row));
        const bool is_bounded = to.lower()[i] > -kInfinity && to.upper()[i] < kInfinity;
        two_sided += is_bounded && to.lower()[i] < to.upper()[i] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(two_sided, 20);
}

TEST(HierarchyJson, ARowMayHaveALowerBoundAnUpperBoundOrBoth) {
  const solver::Level level =
      parse(R"({"levels":[{"D":[[1],[2],[3]],"lower":[-1,null,-2],"f":[1,4,null],
                                           "D_ids":[7,9,-3]}]})")
          .level(0);
  ASSERT_EQ(level.num_rows(), 3);
  EXPECT_EQ(level.lower(), Eigen::Vector3d(-1.0, -kInfinity, -2.0));
  EXPECT_EQ(level.upper(), Eigen::Vector3d(1.0, 4.0, kInfinity));
  EXPECT_EQ(level.id(0), 7);
  EXPECT_EQ(level.id(2), -3);
  const solver::Level open = parse(R"({"levels":[{"D":[[1],[2]],"lower":[-1,3]}]})").level(0);
  EXPECT_EQ(open.lower(), Eigen::Vector2d(-1.0, 3.0));
  EXPECT_EQ(open.upper(), Eigen::Vector2d(kInfinity, kInfinity));
}

TEST(HierarchyJson, ARowWithoutAnyBoundIsOneThatIsSwitchedOff) {
  for (const char* bounds :
       {R"("lower":[0,null],"f":[1,null])", R"("lower":[0,null])", R"("f":[1,null])"}) {
    const std::string line = R"({"levels":[{"D":[[1],[2]],)" + std::string(bounds) + "}]}";
    const solver::Level level = parse(line).level(0);
    ASSERT_EQ(level.num_rows(), 2) << bounds;
    EXPECT_EQ(level.lower()[1], -kInfinity);
    EXPECT_EQ(level.upper()[1], kInfinity);
  }
}

TEST(HierarchyJson, WhatIsWrongIsNamedWithTheLevel) {
  expect_error(R"({"levels":[{"name":"wish","D":[[1]],"lower":[2],"f":[1]}]})",
               "level 1 (wish): row 1 of D has lower 2.0 above f 1.0; expected lower ≤ f");
  expect_error(R"({"levels":[{"D":[[1]],"lower":[],"f":[1]}]})",
               "lower has 0 elements, D has 1 row");
  expect_error(R"({"levels":[{"D":[[1],[2]]}]})",
               "level 1: D has 2 rows and no f; expected f with one element for each row");
  expect_error(R"({"levels":[{"A":[[1]]}]})", "level 1: A has 1 row and no b");
  expect_error(R"({"levels":[{"b":[1,2]}]})",
               "level 1: b has 2 elements and there is no A; expected A with a row for each");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"lower":[0]}]})",
               "lower has 1 element and there is no D");
  expect_error(
      R"({"levels":[{},{"D":[[1]],"lowr":[0],"f":[1]}]})",
      "level 2: unknown key \"lowr\"; did you mean \"lower\"? valid are: name, unit, A, b, "
      "D, f, lower, A_names, D_names, A_ids, D_ids");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"weights":[2]}]})",
               "level 1: unknown key \"weights\"; did you mean \"A_weights\"? valid are: name");
  expect_error(R"({"level":[{"A":[[1]],"b":[1]}]})",
               "unknown key \"level\"; did you mean \"levels\"? valid are: levels");
  expect_error(R"({"levels":[{"name":3,"A":[[1]],"b":[1]}]})",
               "level 1: name is 3; expected a text");
  expect_error(R"({"levels":[{"unit":["N"],"A":[[1]],"b":[1]}]})",
               "level 1: unit is [\"N\"]; expected a text");
  expect_error(R"({"levels":[{"D":[[1]],"f":[1],"D_ids":[1.5]}]})", "level 1: D_ids is [1.5]");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"A_ids":[1,2]}]})", "array of 1 integer");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"A_ids":[5000000000]}]})", "A_ids is [5000000000]");
  expect_error(
      R"({"levels":[{"A":[[1]],"b":[1],"A_ids":[2147483648]}]})",
      "A_ids is [2147483648]; expected an array of 1 integer from -2147483648 to 2147483647, "
      "one for each row of A");
  expect_error("levels: 3", "not JSON");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1]}])", "not JSON");
  expect_error(R"({"levels":[{"A":[[1,2],[3,1e200]],"b":[1,2]}]})",
               "level 1: A: row 2: element 2 is 1e+200, too large");
  expect_error(R"({"levels":[{"D":[[1]],"f":[-1e150]}]})", "level 1: f: element 1 is -1e+150");
  expect_error("[]", "\"levels\"");
  expect_error("{}", "\"levels\"");
  expect_error(R"({"levels":3})", "\"levels\"");
  expect_error(R"({"levels":[]})", "levels is empty, so there are no unknowns");
  expect_error(R"({"levels":[{"A":[],"b":[],"D":[],"f":[]}]})",
               "level 1: has no row in A or D, so there are no unknowns");
  expect_error(R"({"levels":[{},{}]})", "levels 1 to 2: have no row in A or D");
  expect_error(R"({"levels":[{"A":[[1,2],[3]],"b":[1,2]}]})", "level 1: A: row 2: has 1 element;");
  expect_error(R"({"levels":[{"A":[[1,2],[]],"b":[1,2]}]})", "level 1: A: row 2: is empty");
  expect_error(R"({"levels":[{"A":[[1,2]],"b":[1]},{"D":[[1,2,3]],"f":[1]}]})",
               "level 2: D: row 1: has 3 elements; the rows before it have 2");
  expect_error(R"({"levels":[{"A":[[1,2]],"b":[1,2]}]})", "level 1: b has 2 elements, A has 1 row");
  expect_error(R"({"levels":[{"A":[[1,2]],"b":[1],"D":[[3,4]],"f":[]}]})",
               "level 1: f has 0 elements, D has 1 row");
  expect_error(R"({"levels":[{"A":[[1,"two"]],"b":[1]}]})",
               "level 1: A: row 1: element 2 is \"two\"");
  expect_error(R"({"levels":[{"A":[[1,2]],"b":[null]}]})", "level 1: b: element 1 is null");
  expect_error(R"({"levels":[{"A":[1,2],"b":[1]}]})", "level 1: A: row 1: is 1; expected an array");
  expect_error(R"({"levels":[{"A":{},"b":[1]}]})", "level 1: A is {}; expected an array");
  expect_error(R"({"levels":[7]})", "level 1: is 7; expected an object");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"A_names":["a","b"]}]})",
               "level 1: A_names is [\"a\",\"b\"]; expected an array of 1 text");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"A_names":[3]}]})", "A_names");
}

TEST(HierarchyJson, RowsOfAWithBoundsAreToldHowTheyAreWritten) {
  for (const char* level : {R"("A":[[1]],"lower":[0],"upper":[1])", R"("A":[[1]],"lower":[0])",
                            R"("A":[[1]],"f":[0])", R"("D":[[1]],"lower":[0],"upper":[1])"}) {
    expect_error(R"({"levels":[{)" + std::string(level) + "}]}",
                 "level 1: rows with bounds are those of D, lower ≤ D x ≤ f; write D instead of A, "
                 "and f instead of upper");
  }
}

TEST(HierarchyJson, AKeyThatIsGivenTwiceIsNamed) {
  expect_error(R"({"levels":[{},{"A":[[1]],"b":[1],"b":[2]}]})",
               "stack.jsonl:3: level 2: the key \"b\" is given twice; expected once");
  expect_error(R"({"levels":[],"levels":[{"A":[[1]],"b":[1]}]})",
               "stack.jsonl:3: the key \"levels\" is given twice");
  EXPECT_EQ(parse(R"({"levels":[{"A":[[1]],"b":[1]},{"A":[[1]],"b":[1]}]})").num_levels(), 2u);
}

TEST(HierarchyJson, IdsThatALevelHasTwiceAreNamed) {
  expect_error(R"({"levels":[{"A":[[1],[2]],"b":[1,2],"A_ids":[7,7]}]})",
               "level 1: A_ids: element 2 is 7, which another row of the level has; expected one "
               "that none has");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"A_ids":[4],"D":[[1]],"f":[2],"D_ids":[4]}]})",
               "level 1: D_ids: element 1 is 4, which another");
  const solver::Hierarchy two =
      parse(R"({"levels":[{"A":[[1]],"b":[1],"A_ids":[4]},{"A":[[1]],"b":[1],"A_ids":[4]}]})");
  EXPECT_EQ(two.level(1).id(0), 4);
}

TEST(HierarchyJson, RowsWithoutIdsAreCountedPastThoseThatOthersHave) {
  const solver::Level level = parse(
                                  R"({"levels":[{"A":[[1],[2]],"b":[1,2],
                              "D":[[1],[2]],"f":[2,3],"D_ids":[1,0]}]})")
                                  .level(0);
  EXPECT_EQ(level.id(0), 2);
  EXPECT_EQ(level.id(1), 3);
  EXPECT_EQ(level.id(2), 1);
}

TEST(HierarchyJson, LevelsAndRowsKeepTheirNamesAndLevelsTheirUnits) {
  solver::Hierarchy hierarchy(1);
  for (const char* name : {"torque \"limits\"", "second"}) {
    const std::size_t k = hierarchy.add_level(name, 1);
    hierarchy.level(k).add(1, 0).A << 2.0;
  }
  const auto name = [](std::size_t, Eigen::Index) { return std::string("force"); };
  const std::string line = format_hierarchy(hierarchy, name, {"N·m", ""});
  EXPECT_FALSE(holds(line, "\n"));
  EXPECT_EQ(line.find("unit"), line.rfind("unit"));
  const NamedHierarchy read = parse_hierarchy(line, "line");
  EXPECT_EQ(read.hierarchy.level(0).name(), "torque \"limits\"");
  EXPECT_EQ(read.units, (std::vector<std::string>{"N·m", ""}));
  EXPECT_EQ(read.row_names, (std::vector<std::vector<std::string>>{{"force"}, {"force"}}));
}

TEST(HierarchyJson, NumbersThatAreNotFiniteAreNamedWithLevelAndRow) {
  expect_error(R"({"levels":[{"A":[[1]],"b":[NaN]}]})", "level 1: b: element 1 is \"NaN\"");
  expect_error(R"({"levels":[{},{"A":[[1,2],[3,-Infinity]],"b":[1,2]}]})",
               "level 2: A: row 2: element 2 is \"-Infinity\"; expected a finite number");
  expect_error(R"({"levels":[{"D":[[nan]],"f":[1]}]})", "level 1: D: row 1: element 1 is \"nan\"");
  expect_error(
      R"({"levels":[{"D":[[1]],"lower":[-Infinity],"f":[NaN]}]})",
      "level 1: lower: element 1 is \"-Infinity\"; expected a finite number, or null where "
      "there is no bound");
  expect_error(R"({"levels":[{"A":[[1e999]],"b":[1]}]})",
               "level 1: A: row 1: element 1 is 1e999, too large");
  EXPECT_EQ(parse(R"({"levels":[{"name":"NaN \" NaN","A":[[1]],"b":[2]}]})").num_levels(), 1u);
}

TEST(HierarchyJson, NumbersUpTo1e100AreReadAndAreBounds) {
  const solver::Level level =
      parse(R"({"levels":[{"A":[[1e100]],"b":[-1e100],"D":[[1]],"lower":[-1e100],"f":[1e100]}]})")
          .level(0);
  EXPECT_EQ(level.A()(0, 0), 1e100);
  EXPECT_EQ(level.lower()[1], -1e100);
  EXPECT_EQ(level.upper()[1], 1e100);
  expect_error(R"({"levels":[{"D":[[1]],"f":[1.0001e100]}]})",
               "f: element 1 is 1.0001e+100, too large to compute with; expected at most 1e100 "
               "either way");
}

TEST(HierarchyJson, RowsTooSmallToComputeWithAreNamed) {
  expect_error(R"({"levels":[{"A":[[1,2],[1e-300,-1e-301]],"b":[1,2]}]})",
               "level 1: A: row 2: has nothing larger than 1e-300, too small to compute with; "
               "expected at least 1e-100, or zeros only");
  expect_error(R"({"levels":[{"D":[[-9e-101]],"f":[0]}]})",
               "level 1: D: row 1: has nothing larger");
  expect_error(R"({"levels":[{"A":[[1e-400]],"b":[1]}]})",
               "level 1: A: row 1: element 1 is 1e-400, too small");
  const solver::Level level =
      parse(R"({"levels":[{"A":[[1e-100,0],[0,0],[1,1e-300]],"b":[0,0,1e-300]}]})").level(0);
  EXPECT_EQ(level.A()(0, 0), 1e-100);
  EXPECT_EQ(level.A()(2, 1), 1e-300);
}

TEST(HierarchyJson, AWrongValueIsQuotedInWholeCharacters) {
  for (int before = 0; before < 4; ++before) {
    std::string text(static_cast<std::size_t>(before), 'a');
    for (int i = 0; i < 30; ++i) text += "ü";
    const std::string message = error_of(R"({"levels":[{"A":")" + text + R"("}]})");
    const std::size_t cut = message.find("…");
    ASSERT_NE(cut, std::string::npos);
    EXPECT_EQ(message.substr(cut - 2, 2), "ü");
  }
}

TEST(HierarchyJson, ALineNestedTooDeepIsNamed) {
  const std::string deep(100000, '[');
  expect_error("{\"levels\":" + deep, "nested deeper than 64");
  expect_error("{\"levels\":" + deep + std::string(100000, ']') + "}", "nested deeper than 64");
}

TEST(HierarchyJson, RowsHaveTheNamesOfTheFileOrTheirPlace) {
  const auto named = parse_hierarchy(
      R"({"levels":[{"A":[[1]],"b":[1],"A_names":["height"],"D":[[1],[2]],"f":[1,1]}]})", "f:1");
  EXPECT_EQ(named.row_names, (std::vector<std::vector<std::string>>{{"height", "D 1", "D 2"}}));
}

TEST(HierarchyJson, NumbersThatNoDoubleHoldsAreTooSmallOrTooLarge) {
  expect_error(R"({"levels":[{"A":[[1,1e-400]],"b":[1]}]})",
               "level 1: A: row 1: element 2 is 1e-400, too small for a double; expected 0 or");
  expect_error(R"({"levels":[{"A":[[1,1]],"b":[-1e400]}]})",
               "level 1: b: element 1 is -1e400, too large to compute with");
  EXPECT_EQ(parse(R"({"levels":[{"A":[[1,4.9406564584124654e-324]],"b":[1]}]})").level(0).A()(0, 1),
            std::numeric_limits<double>::denorm_min());
}

TEST(HierarchyJson, RowsAreWeighedAndALevelDampedAndXPulledToAReference) {
  const NamedHierarchy read = parse_hierarchy(
      R"({"levels":[{"A":[[0,2]],"b":[3],"A_weights":[10],"A_ids":[0],
          "D":[[0,4]],"f":[null],"lower":[1],"D_weights":[0.5],"D_ids":[2],"damping":0.25}],
          "x_ref":[7,8]})",
      "");
  ASSERT_EQ(read.hierarchy.num_levels(), 2u);
  const solver::Level& level = read.hierarchy.level(0);
  ASSERT_EQ(level.num_rows(), 4);
  EXPECT_EQ(level.A()(0, 1), 20.0);
  EXPECT_EQ(level.lower()[0], 30.0);
  EXPECT_EQ(level.A()(1, 1), 2.0);
  EXPECT_EQ(level.lower()[1], 0.5);
  EXPECT_EQ(level.upper()[1], kInfinity);
  EXPECT_EQ(level.id(2), 3);
  EXPECT_NEAR(level.A().bottomRows(2).norm(), 0.25, 1e-15);
  EXPECT_NEAR(level.upper().tail(2).norm(), 0.25 * 8.0, 1e-14);
  EXPECT_EQ(read.row_names[0], (std::vector<std::string>{"A 1", "D 1", "damping 1", "damping 2"}));
  const solver::Level& last = read.hierarchy.level(1);
  EXPECT_EQ(last.name(), "x_ref");
  ASSERT_EQ(last.num_rows(), 2);
  EXPECT_EQ(last.upper()[1], 8.0);
  EXPECT_EQ(read.row_names[1], (std::vector<std::string>{"x 1", "x 2"}));
}

TEST(HierarchyJson, WeightsDampingAndReferencesThatMakeNoSenseAreErrors) {
  const std::string level = R"({"levels":[{"A":[[1,1]],"b":[1])";
  for (const auto& [rest, message] : std::vector<std::pair<std::string, std::string>>{
           {R"(,"A_weights":[0]}]})", "A_weights: element 1: is 0; expected a number above 0"},
           {R"(,"A_weights":[1,1]}]})", "A_weights is [1,1]; expected an array of 1 number, one"},
           {R"(,"D_weights":[1]}]})", "D_weights is [1]; expected an array of 0 numbers"},
           {R"(,"A_weights":[1e-99],"D":[[1e-3,0]],"f":[1],"D_weights":[1e-99]}]})",
            "D_weights: element 1: the weighted row: has nothing larger than 1"},
           {R"(,"damping":-1}]})", "damping: is -1; expected a number above 0"},
           {R"(}],"x_ref":[1]})", "x_ref has 1 element; expected 2, one for each unknown"},
           {R"(}],"x_ref":3})", "x_ref is 3; expected an array"}})
    expect_error(level + rest, message);
  expect_error(R"({"levels":[{"A":[[1]],"b":[1e60],"A_weights":[1e60]}]})",
               "element 1: a number of the weighted row: is ");
  expect_error(R"({"levels":[{"A":[[1,0],[1e-90,0]],"b":[1,1],"A_weights":[1,1e-250]}]})",
               "A_weights: element 2: is 1e-250 and makes zeros of row 2 of A, too small");
}

}  // namespace
}  // namespace surefoot::config
