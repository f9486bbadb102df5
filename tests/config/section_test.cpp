#include "surefoot/config/section.hpp"

#include "surefoot/base/nearest_name.hpp"
#include "tests/support/messages.hpp"

#include <functional>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

/// What reading a text with `fields` says that is wrong.
std::string complaint(const std::string& text, const std::function<void(Section&)>& fields) {
  const ConfigNode tree = parse_yaml(text, "f.yaml");
  return message_of([&] {
    Section section(tree, "part");
    fields(section);
    section.finish();
  });
}

double number_of(const std::string& text) {
  const ConfigNode tree = parse_yaml("a: " + text, "f.yaml");
  double value = 7.0;
  Section section(tree, "");
  section.number("a", value);
  return value;
}

void read_apex(Section& section) {
  double apex = 0.0, duration = 0.0;
  section.number("apex", apex, kPositive);
  section.number("swing_duration", duration, kNotNegative);
}

TEST(Section, a_wrong_key_or_number_is_told_with_line_path_and_what_would_be_valid) {
  const std::string valid = "valid are: apex, swing_duration";
  EXPECT_EQ(complaint("\napx: 0.1", read_apex),
            "f.yaml:2: part.apx: unknown key; did you mean \"apex\"? " + valid);
  EXPECT_EQ(complaint("something: 0.1", read_apex),
            "f.yaml:1: part.something: unknown key; " + valid);
  EXPECT_EQ(complaint("swing_duration: -2", read_apex),
            "f.yaml:1: part.swing_duration: \"-2\" is not a number of at least 0");
  EXPECT_TRUE(holds(complaint("apex: 0", read_apex), "above 0"));
}

TEST(Section, what_is_no_number_is_told) {
  for (const char* text : {".nan", "nan", "NaN", ".inf", "-.inf", "inf", "1e999"})
    EXPECT_TRUE(holds(complaint(std::string("apex: ") + text, read_apex), text));
  for (const char* text : {"high", "[1]", "{a: 1}", "", "0.1 m", "0x10", "'1 2'"})
    EXPECT_TRUE(holds(complaint(std::string("apex: ") + text, read_apex), "part.apex")) << text;
}

TEST(Section, numbers_are_read_exactly_in_every_way_to_write_them) {
  EXPECT_EQ(number_of("0.1"), 0.1);
  EXPECT_EQ(number_of("+3"), 3.0);
  EXPECT_EQ(number_of("-1e-3"), -1e-3);
}

TEST(Section, an_absent_key_leaves_the_value) {
  const ConfigNode tree = parse_yaml("a: 1", "f.yaml");
  double value = 7.0;
  Section section(tree, "");
  section.number("b", value);
  EXPECT_EQ(value, 7.0);
}

TEST(Section, an_unknown_choice_lists_the_choices) {
  const auto read_choice = [](Section& section) {
    (void)section.choice("model", {"ideal", "sea"});
  };
  EXPECT_EQ(
      complaint("model: see", read_choice),
      "f.yaml:1: part.model: unknown choice \"see\"; did you mean \"sea\"? valid are: ideal, sea");
}

TEST(Section, a_flag_is_true_or_false_and_nothing_else) {
  const auto read_flag = [](Section& section) {
    bool value = false;
    section.flag("on", value);
  };
  EXPECT_TRUE(holds(complaint("on: yes", read_flag), "true, false"));
}

TEST(Section, a_vector_needs_its_length) {
  const auto read_vector = [](Section& section) {
    Vec3 value = Vec3::Zero();
    section.vector("size", value);
  };
  EXPECT_TRUE(holds(complaint("size: [1, 2]", read_vector), "3 numbers"));
  EXPECT_TRUE(holds(complaint("size: [1, 2, wide]", read_vector), "wide"));
}

TEST(Section, a_whole_number_is_whole_and_neither_too_small_nor_too_large) {
  const auto read_count = [](Section& section) {
    int value = 0;
    section.integer("count", value, 1, 4);
  };
  EXPECT_TRUE(holds(complaint("count: 1.5", read_count), "whole number"));
  EXPECT_TRUE(holds(complaint("count: 0", read_count), "less than 1"));
  EXPECT_TRUE(holds(complaint("count: 5", read_count), "more than 4"));
}

TEST(Section, two_numbers_in_the_wrong_order_are_told_with_both_at_one_that_is_written) {
  const auto read_both = [](Section& section) {
    double low = 10.0, high = 400.0;
    section.number("min", low);
    section.number("max", high);
    section.require_order("min", low, "max", high);
  };
  EXPECT_EQ(complaint("max: 5", read_both),
            "f.yaml:1: part.max: 5 must not be below min, which is 10");
  EXPECT_EQ(complaint("min: 500", read_both),
            "f.yaml:1: part.min: 500 must not be above max, which is 400");
  EXPECT_EQ(complaint("min: 500\nmax: 450", read_both),
            "f.yaml:2: part.max: 450 must not be below min, which is 500");
  EXPECT_EQ(complaint("{min: 400, mx: 0}", read_both),
            "f.yaml:1: part.mx: unknown key; did you mean \"max\"? valid are: min, max")
      << "the same twice is in order";
}

TEST(Section, a_missing_required_key_is_named_after_unknown_ones) {
  const auto read_required = [](Section& section) {
    std::string name;
    section.require("name");
    section.text("name", name);
  };
  EXPECT_EQ(complaint("{}", read_required), "f.yaml:1: part.name: this key is missing");
  EXPECT_TRUE(holds(complaint("nmae: a", read_required), "did you mean \"name\""));
}

TEST(Section, a_number_where_a_map_should_be_is_told) {
  const auto read_below = [](Section& section) {
    section.section("swing", [](Section& below) { read_apex(below); });
  };
  EXPECT_EQ(complaint("swing: 3", read_below),
            "f.yaml:1: part.swing: \"3\" is not a map of keys and values");
}

TEST(NearestName, swapped_missing_and_wrong_letters_are_near) {
  EXPECT_TRUE(holds(valid_names("frcition", {"duration", "friction"}), "\"friction\""));
  EXPECT_TRUE(holds(valid_names("duratin", {"duration", "friction"}), "\"duration\""));
  EXPECT_FALSE(holds(valid_names("height", {"duration", "friction"}), "did you mean"));
  EXPECT_TRUE(holds(valid_names("LF_FOOT", {"base", "LF_foot"}), "did you mean \"LF_foot\"?"));
}

}  // namespace
}  // namespace surefoot::config
