#include "surefoot/config/hierarchy_json.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace surefoot::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Hierarchy parse(const std::string& line) {
  return parse_hierarchy(line, "stack.jsonl:3").hierarchy;
}

/// Message of the error that a line gives.
std::string error_of(const std::string& line) {
  try {
    (void)parse(line);
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

void expect_error(const std::string& line, const std::string& part) {
  const std::string message = error_of(line);
  EXPECT_EQ(message.find("stack.jsonl:3: "), 0u) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(HierarchyJson, ReadsEqualitiesAndInequalities) {
  const Hierarchy hierarchy =
      parse(R"({"levels":[{"A":[[1,2.5]],"b":[3],"D":[[4,5],[6,7]],"f":[8,-9e-1]}]})");
  ASSERT_EQ(hierarchy.unknowns(), 2);
  ASSERT_EQ(hierarchy.num_levels(), 1u);
  const Level& level = hierarchy.level(0);
  ASSERT_EQ(level.num_rows(), 3);
  EXPECT_EQ(level.A()(0, 1), 2.5);
  EXPECT_EQ(level.A()(2, 0), 6.0);
  EXPECT_EQ(level.lower()[0], 3.0);
  EXPECT_EQ(level.upper()[0], 3.0);
  EXPECT_EQ(level.lower()[2], -kInfinity);
  EXPECT_EQ(level.upper()[2], -0.9);
}

TEST(HierarchyJson, EmptyAndMissingBlocksAndOtherMembersAreAllowed) {
  const Hierarchy hierarchy = parse(
      R"({"n":5,"levels":[{"A":[],"b":[],"D":[],"f":[]},{"note":[1,"x"],"A":[[1]],"b":[2]},{}]})");
  ASSERT_EQ(hierarchy.num_levels(), 3u);
  EXPECT_EQ(hierarchy.level(0).num_rows(), 0);
  EXPECT_EQ(hierarchy.level(1).num_rows(), 1);
  EXPECT_EQ(hierarchy.level(2).num_rows(), 0);
}

TEST(HierarchyJson, WhatIsWrittenReadsBackToTheSameNumbers) {
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    HierarchyData levels =
        random_levels(random, {.unknowns = 5, .levels = 4, .two_sided_share = 0.0});
    levels.push_back(equalities(random.matrix(2, 5), random.vector(2)));
    const Hierarchy original = make_hierarchy(5, levels);
    const Hierarchy copy = parse(format_hierarchy(original));
    ASSERT_EQ(copy.num_levels(), original.num_levels());
    ASSERT_EQ(format_hierarchy(copy), format_hierarchy(original));
    const Level& last = copy.level(copy.num_levels() - 1);
    ASSERT_EQ(last.A(), original.level(copy.num_levels() - 1).A());
    ASSERT_EQ(last.lower(), original.level(copy.num_levels() - 1).lower());
  }
}

TEST(HierarchyJson, ACopyHasTheSameResiduals) {
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    HierarchyData levels = random_levels(random, {.unknowns = 5, .levels = 4});
    levels.push_back(equalities(random.matrix(2, 5), random.vector(2)));
    const Hierarchy original = make_hierarchy(5, levels);
    const Hierarchy copy = parse(format_hierarchy(original));
    CascadeSolver first(original);
    CascadeSolver second(copy);
    (void)first.solve(original);
    (void)second.solve(copy);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      ASSERT_NEAR(first.solution().levels[k].residual, second.solution().levels[k].residual, 1e-9);
    }
  }
}

TEST(HierarchyJson, LevelsKeepTheirNames) {
  Hierarchy hierarchy(1);
  hierarchy.add_level("torque \"limits\"", 1);
  Rows rows = hierarchy.level(0).add(1, 0);
  rows.A << 2.0;
  rows.set_equal(0, 1.0);
  const std::string line = format_hierarchy(hierarchy);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(parse(line).level(0).name(), "torque \"limits\"");
}

TEST(HierarchyJson, LevelsKeepTheirUnits) {
  Hierarchy hierarchy(1);
  for (const char* name : {"first", "second"}) {
    const std::size_t k = hierarchy.add_level(name, 1);
    hierarchy.level(k).add(1, 0).A << 2.0;
  }
  const std::string line = format_hierarchy(hierarchy, nullptr, {"N·m", ""});
  EXPECT_EQ(line.find("unit"), line.rfind("unit"));
  EXPECT_EQ(parse_hierarchy(line, "line").units, (std::vector<std::string>{"N·m", ""}));
}

TEST(HierarchyJson, ALineThatIsNotJsonIsNamed) {
  expect_error("levels: 3", "not JSON");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1]}])", "not JSON");
}

TEST(HierarchyJson, NumbersThatAreNotFiniteAreNamedWithLevelAndRow) {
  expect_error(R"({"levels":[{"A":[[1]],"b":[NaN]}]})", "level 1: b: element 1 is \"NaN\"");
  expect_error(R"({"levels":[{},{"A":[[1,2],[3,-Infinity]],"b":[1,2]}]})",
               "level 2: A: row 2: element 2 is \"-Infinity\"; expected a finite number");
  expect_error(R"({"levels":[{"D":[[nan]],"f":[1]}]})", "level 1: D: row 1: element 1 is \"nan\"");
  expect_error(R"({"levels":[{"A":[[1e999]],"b":[1]}]})",
               "level 1: A: row 1: element 1 is \"1e999\"");
  EXPECT_EQ(parse(R"({"note":"NaN \" NaN","levels":[{"A":[[1]],"b":[2]}]})").num_levels(), 1u);
}

TEST(HierarchyJson, NumbersTooLargeToComputeWithAreNamedWithLevelAndRow) {
  expect_error(R"({"levels":[{"A":[[1,2],[3,1e200]],"b":[1,2]}]})",
               "level 1: A: row 2: element 2 is 1e+200, too large");
  expect_error(R"({"levels":[{"D":[[1]],"f":[-1e150]}]})", "level 1: f: element 1 is -1e+150");
}

TEST(HierarchyJson, ALineNestedTooDeepIsNamed) {
  const std::string deep(100000, '[');
  expect_error("{\"levels\":" + deep, "nested deeper than 64");
  expect_error("{\"levels\":" + deep + std::string(100000, ']') + "}", "nested deeper than 64");
}

TEST(HierarchyJson, ALineWithoutLevelsIsNamed) {
  expect_error("[]", "\"levels\"");
  expect_error("{}", "\"levels\"");
  expect_error(R"({"levels":3})", "\"levels\"");
}

TEST(HierarchyJson, AHierarchyWithoutUnknownsIsNamed) {
  expect_error(R"({"levels":[]})", "no unknowns");
  expect_error(R"({"levels":[{"A":[],"b":[],"D":[],"f":[]}]})", "no unknowns");
}

TEST(HierarchyJson, RaggedRowsAreNamed) {
  expect_error(R"({"levels":[{"A":[[1,2],[3]],"b":[1,2]}]})", "level 1: A: row 2: has 1 element;");
  expect_error(R"({"levels":[{"A":[[1,2],[]],"b":[1,2]}]})", "level 1: A: row 2: is empty");
}

TEST(HierarchyJson, LevelsOfOtherUnknownsAreNamed) {
  expect_error(R"({"levels":[{"A":[[1,2]],"b":[1]},{"D":[[1,2,3]],"f":[1]}]})",
               "level 2: D: row 1: has 3 elements; the rows before it have 2");
}

TEST(HierarchyJson, RightHandSidesOfTheWrongLengthAreNamed) {
  expect_error(R"({"levels":[{"A":[[1,2]],"b":[1,2]}]})", "level 1: b has 2 elements, A has 1 row");
  expect_error(R"({"levels":[{"A":[[1,2]],"b":[1],"D":[[3,4]],"f":[]}]})",
               "level 1: f has 0 elements, D has 1 row");
}

TEST(HierarchyJson, WhatIsNoNumberIsNamed) {
  expect_error(R"({"levels":[{"A":[[1,"two"]],"b":[1]}]})",
               "level 1: A: row 1: element 2 is \"two\"");
  expect_error(R"({"levels":[{"A":[[1,2]],"b":[null]}]})", "level 1: b: element 1 is null");
  expect_error(R"({"levels":[{"A":[1,2],"b":[1]}]})", "level 1: A: row 1: is 1; expected an array");
  expect_error(R"({"levels":[{"A":{},"b":[1]}]})", "level 1: A is {}; expected an array");
  expect_error(R"({"levels":[7]})", "level 1: is 7; expected an object");
}

TEST(HierarchyJson, RowsHaveTheNamesOfTheFileOrTheirPlace) {
  const auto named = parse_hierarchy(
      R"({"levels":[{"A":[[1]],"b":[1],"A_names":["height"],"D":[[1],[2]],"f":[1,1]}]})", "f:1");
  EXPECT_EQ(named.row_names, (std::vector<std::vector<std::string>>{{"height", "D 1", "D 2"}}));
}

TEST(HierarchyJson, NamesAreWrittenAndReadBack) {
  Hierarchy hierarchy(1);
  hierarchy.add_level("limits", 1);
  Rows rows = hierarchy.level(0).add(1, 0);
  rows.A(0, 0) = 1.0;
  rows.lower[0] = -1.0;
  rows.upper[0] = 2.0;
  const auto name = [](std::size_t, Eigen::Index) { return std::string("force"); };
  const auto read = parse_hierarchy(format_hierarchy(hierarchy, name), "f:1");
  EXPECT_EQ(read.row_names, (std::vector<std::vector<std::string>>{{"force", "force"}}));
}

TEST(HierarchyJson, NamesThatDoNotFitTheRowsAreNamed) {
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"A_names":["a","b"]}]})",
               "level 1: A_names is [\"a\",\"b\"]; expected an array of 1 text");
  expect_error(R"({"levels":[{"A":[[1]],"b":[1],"A_names":[3]}]})", "A_names");
}

}  // namespace
}  // namespace surefoot::test
