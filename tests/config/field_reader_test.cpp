#include "surefoot/config/field_reader.hpp"

#include "surefoot/config/json_schema.hpp"
#include "surefoot/config/option_list.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/scenario_fields.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/simulation/check_options.hpp"
#include "tests/support/messages.hpp"

#include <nlohmann/json.hpp>

#include <set>
#include <sstream>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

std::string complaint(const std::string& text) {
  const ConfigNode tree = parse_yaml(text, "f.yaml");
  return message_of([&] {
    Scenario scenario;
    scenario.commands = {TimedCommand{}};
    Section top(tree, "");
    read(top, scenario_fields(scenario));
    top.finish();
  });
}

TEST(Fields, have_defaults_that_are_valid_in_cpp) {
  control::ControllerOptions controller;
  check_fields("", fields(controller));
  simulation::check_options({});
}

TEST(Fields, out_of_range_are_refused_in_a_file_and_in_cpp) {
  control::ControllerOptions controller;
  controller.planner.swing.apex = -0.1;
  EXPECT_EQ(message_of([&] { check_fields("", fields(controller)); }),
            "planner.swing.apex is -0.1; it must be a finite number above 0");
  EXPECT_EQ(complaint("planner: {swing: {apex: -0.1}}"),
            "f.yaml:1: planner.swing.apex: \"-0.1\" is not a number above 0");
}

TEST(Fields, that_contradict_each_other_are_refused_in_a_file_and_in_cpp) {
  control::ControllerOptions controller;
  controller.safety.bridge_time = 0.05;
  EXPECT_TRUE(holds(message_of([&] { check_fields("", fields(controller)); }),
                    "safety.bridge_time: 0.05 s must not be above guard.patience, 0.02 s"));
  EXPECT_TRUE(holds(complaint("safety: {bridge_time: 0.05}"),
                    "f.yaml:1: safety.bridge_time: 0.05 s must not be above guard.patience"));
}

TEST(Fields, have_a_unit_or_help_and_keys_that_differ) {
  std::set<std::string> keys;
  for (const OptionRow& row : list_options("", load_robot("anymal_b"))) {
    EXPECT_FALSE(row.help.empty() && row.unit.empty()) << row.key;
    EXPECT_TRUE(keys.insert(row.key).second) << row.key;
  }
  EXPECT_GT(keys.size(), 300U);
  EXPECT_EQ(list_options("planner.swing.apex", load_robot("anymal_b")).size(), 2U);
}

TEST(Fields, rules_of_groups_that_are_put_together_all_hold_in_order) {
  std::string held;
  const auto note = [&held](char name) { return [&held, name](const Given&) { held += name; }; };
  check_fields("", Group{}.with(note('a')).with(note('b')).and_also(Group{}.with(note('c'))));
  EXPECT_EQ(held, "abc");
}

TEST(Fields, are_found_by_the_path_that_a_range_or_set_has) {
  std::size_t numbers = 0;
  EXPECT_TRUE(visit_scenario_option("sensors.encoders.offset", [&](const Field& field) {
    numbers = std::get<Numbers>(field.value).names.size();
  }));
  EXPECT_EQ(numbers, 12U);
  const auto exists = [](const char* path) {
    return visit_scenario_option(path, [](const Field&) {});
  };
  EXPECT_TRUE(exists("disturbances.pushes.kick.direction"));
  EXPECT_TRUE(exists("terrain.elements.ground.tread"));
  EXPECT_FALSE(exists("terrain.elements.ground"));
  EXPECT_FALSE(exists("planner.swing.apx"));
}

/// The schema of a key, through what may be null or a named entry.
const nlohmann::json* below(const nlohmann::json& schema, const std::string& key) {
  if (schema.contains("properties") && schema["properties"].contains(key))
    return &schema["properties"][key];
  for (const char* through : {"additionalProperties", "items"}) {
    if (schema.contains(through) && schema[through].is_object()) {
      if (key.empty() || key.front() == '<') return &schema[through];
    }
  }
  if (!schema.contains("anyOf")) return nullptr;
  for (const nlohmann::json& form : schema["anyOf"]) {
    if (const nlohmann::json* found = below(form, key)) return found;
  }
  return nullptr;
}

TEST(Fields, stand_in_the_schema_of_scenarios_as_in_the_list) {
  const nlohmann::json schema = nlohmann::json::parse(json_schema("scenario"));
  for (const OptionRow& row : list_options("", load_robot("anymal_b"))) {
    const nlohmann::json* at = &schema;
    std::istringstream path(row.key);
    for (std::string key; at != nullptr && std::getline(path, key, '.');) {
      const bool is_list = key.ends_with("[]");
      at = below(*at, is_list ? key.substr(0, key.size() - 2) : key);
      if (at != nullptr && is_list) at = below(*at, "");
    }
    EXPECT_NE(at, nullptr) << row.key;
  }
}

}  // namespace
}  // namespace surefoot::config
