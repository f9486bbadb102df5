#include "surefoot/config/config_tree.hpp"

#include "surefoot/config/config_json.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <cstdlib>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

const char* const kTree = R"(
terrain:
  friction: 0.8
  boxes: [[1, 2, 3], [4, 5, 6]]
name: a
)";

ConfigNode tree() { return parse_yaml(kTree, "a.yaml"); }

TEST(ConfigTree, knows_the_line_of_every_key) {
  EXPECT_EQ(tree().find("terrain")->find("friction")->where, "a.yaml:3");
  EXPECT_EQ(tree().find("name")->where, "a.yaml:5");
}

TEST(ConfigTree, what_is_not_one_map_in_yaml_is_told_with_its_line) {
  const auto told = [](const char* text) {
    return message_of([&] { (void)parse_yaml(text, "bad.yaml"); });
  };
  EXPECT_TRUE(told("a: 1\nb: [2, 3\nc: }").starts_with("bad.yaml:"));
  EXPECT_TRUE(holds(told("a: 1\nb: [2, 3\nc: }"), "not YAML"));
  EXPECT_TRUE(holds(told("a: 1\na: 2\n"), "bad.yaml:2: the key \"a\" is given twice"));
  EXPECT_TRUE(holds(told("a: &x [*x]"), "bad.yaml")) << "an anchor that holds itself";
  EXPECT_TRUE(holds(told("a: 1\n---\nb: 2\n"), "bad.yaml")) << "a second document";
}

TEST(ConfigTree, a_file_of_plain_text_a_missing_one_and_a_folder_are_told) {
  const test::TemporaryFolder folder;
  test::write_file(folder / "text.yaml", "just a sentence");
  const auto told = [](const std::string& path) {
    return message_of([&] { (void)parse_yaml_file(path); });
  };
  EXPECT_TRUE(holds(told(folder / "text.yaml"), "key: value"));
  EXPECT_TRUE(holds(told(folder / "none.yaml"), "none.yaml"));
  EXPECT_TRUE(holds(told(folder.path()), folder.path()));
}

TEST(ConfigTree, an_overlay_changes_what_it_names_and_keeps_the_rest) {
  ConfigNode base = tree();
  merge(base, parse_yaml("terrain: {friction: 0.4}\nnew: 1\n", "b.yaml"));
  EXPECT_EQ(to_json(base),
            R"({"terrain":{"friction":0.4,"boxes":[[1,2,3],[4,5,6]]},"name":"a","new":1})");
  EXPECT_EQ(base.find("terrain")->find("friction")->where, "b.yaml:1");
  EXPECT_EQ(base.find("name")->where, "a.yaml:5");
}

TEST(ConfigTree, an_assignment_sets_a_number_a_list_entry_or_a_whole_map) {
  ConfigNode changed = tree();
  apply_assignment(changed, "terrain.friction=0.5");
  apply_assignment(changed, "terrain.boxes.1.z=9");
  apply_assignment(changed, "planner.swing={apex: 0.1}");
  EXPECT_EQ(to_json(changed), R"({"terrain":{"friction":0.5,"boxes":[[1,2,3],[4,5,9]]},"name":"a",)"
                              R"("planner":{"swing":{"apex":0.1}}})");
  EXPECT_EQ(changed.find("terrain")->find("friction")->where, "--set terrain.friction=0.5");
}

TEST(ConfigTree, an_assignment_takes_what_follows_randomise_for_one_key) {
  ConfigNode changed = parse_yaml("randomise: {initial.yaw: [0, 1], a.b: [1, 2]}\n", "a.yaml");
  apply_assignment(changed, "randomise.a.b=[3, 4]");
  apply_assignment(changed, "randomise.initial.yaw=~");
  apply_assignment(changed, "randomise.c.d.e=[5, 6]");
  apply_assignment(changed, "randomise.include=mismatch");
  EXPECT_EQ(to_json(changed),
            R"({"randomise":{"initial.yaw":null,"a.b":[3,4],"c.d.e":[5,6],"include":"mismatch"}})");
}

TEST(ConfigTree, an_assignment_takes_off_only_what_is_there) {
  ConfigNode changed = parse_yaml(
      "terrain: {elements: {ground: {shape: plane}}}\n"
      "randomise: {terrain.elements.ground.tilt: [0, 1], terrain.elements.grounds.tilt: [0, 1]}\n",
      "a.yaml");
  const auto told = [&changed](const char* assignment) {
    return message_of([&] { apply_assignment(changed, assignment); });
  };
  EXPECT_TRUE(holds(told("terrain.elements.grond=~"),
                    "terrain.elements.grond: \"grond\" is not there to be taken off; did you mean "
                    "\"ground\"?"));
  EXPECT_TRUE(holds(told("disturbances.pushes.kick=~"), "disturbances.pushes has no entries"));
  apply_assignment(changed, "terrain.elements.ground=~");
  apply_assignment(changed, "goal=~");
  EXPECT_EQ(
      to_json(changed),
      R"({"terrain":{"elements":{"ground":null}},"randomise":{"terrain.elements.ground.tilt":)"
      R"(null,"terrain.elements.grounds.tilt":[0,1]},"goal":null})");
}

TEST(ConfigTree, none_is_nothing_unless_it_is_quoted) {
  ConfigNode changed = tree();
  apply_assignment(changed, "terrain=none");
  apply_assignment(changed, "name='none'");
  merge(changed, parse_yaml("a: none\nb: \"none\"\nc: [none, None]\n", "a.yaml"));
  EXPECT_EQ(to_json(changed),
            R"({"terrain":null,"name":"none","a":null,"b":"none","c":[null,"None"]})");
}

TEST(ConfigTree, a_home_folder_that_the_shell_made_is_told) {
  const std::string home = std::getenv("HOME") == nullptr ? "/root" : std::getenv("HOME");
  setenv("HOME", "/home/someone", 1);
  ConfigNode changed = tree();
  const auto told = [&changed](const char* assignment) {
    return message_of([&] { apply_assignment(changed, assignment); });
  };
  EXPECT_TRUE(holds(told("goal=/home/someone"),
                    "--set goal=/home/someone: this is your home folder, which the shell makes of "
                    "~; valid is goal=none"));
  EXPECT_NO_THROW(apply_assignment(changed, "stack=/home/someone/mine.yaml"));
  setenv("HOME", home.c_str(), 1);
}

TEST(ConfigTree, an_assignment_without_a_path_or_a_value_is_told) {
  ConfigNode changed = tree();
  for (const char* wrong : {"terrain.friction", "=3", "a..b=3", ".a=3", "a.=3",
                            "randomise..a=[0, 1]", "randomise.=3"}) {
    EXPECT_TRUE(holds(message_of([&] { apply_assignment(changed, wrong); }), "as")) << wrong;
  }
}

TEST(ConfigTree, an_assignment_through_a_number_or_past_a_list_names_its_path) {
  ConfigNode changed = tree();
  EXPECT_TRUE(holds(message_of([&] { apply_assignment(changed, "terrain.friction.x=1"); }),
                    "terrain.friction.x"));
  EXPECT_TRUE(holds(message_of([&] { apply_assignment(changed, "terrain.boxes.2=1"); }),
                    "terrain.boxes.2"));
}

TEST(ConfigTree, words_become_json_texts_and_numbers_numbers) {
  EXPECT_EQ(to_json(parse_yaml("a: 1e-3\nb: 0.5 m\nc: true\nd:\n", "x")),
            R"({"a":0.001,"b":"0.5 m","c":true,"d":null})");
}

}  // namespace
}  // namespace surefoot::config
