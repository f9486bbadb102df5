// What a seed draws for a scenario, from its `randomise:` and that of the command line.
#include "tests/config/trial_scenario.hpp"

#include <algorithm>
#include <array>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

class RandomisedScenario : public test::TrialScenario {};

/// Draws the friction and nothing of what walk_flat draws.
const char* const kRandomFriction =
    "randomise:\n  initial.yaw:\n  planner.gait.start_duration:\n  terrain.friction: [0.4, 1.0]\n";

TEST_F(RandomisedScenario,
       draws_nothing_for_seed_zero_and_the_same_values_for_the_same_other_seed) {
  const Scenario nominal = read(kRandomFriction, 0);
  EXPECT_TRUE(nominal.drawn.empty());
  EXPECT_EQ(nominal.plant.terrain.friction, 0.8);
  const double first = read(kRandomFriction, 1).plant.terrain.friction;
  EXPECT_EQ(read(kRandomFriction, 1).plant.terrain.friction, first);
  EXPECT_NE(read(kRandomFriction, 2).plant.terrain.friction, first);
  EXPECT_EQ(read(kRandomFriction, 1).drawn.at(0).value, first);
  const std::string more = std::string(kRandomFriction) + "  initial.x: [0, 1]\n";
  EXPECT_EQ(read(more, 1).plant.terrain.friction, first) << "whatever else is drawn";
}

TEST_F(RandomisedScenario, pairs_the_seeds_of_the_step_down_variants) {
  const Scenario full = load_scenario({"step_down", 5, {}});
  const Scenario regular = load_scenario({"step_down_regular_stack", 5, {}});
  ASSERT_EQ(full.drawn.size(), regular.drawn.size());
  for (std::size_t i = 0; i < full.drawn.size(); ++i) {
    EXPECT_EQ(full.drawn[i].path, regular.drawn[i].path);
    EXPECT_EQ(full.drawn[i].value, regular.drawn[i].value);
  }
}

TEST_F(RandomisedScenario, lets_an_assignment_win_over_a_draw) {
  const Scenario scenario = read(kRandomFriction, 1, {"terrain.friction=0.77"});
  EXPECT_EQ(scenario.plant.terrain.friction, 0.77);
  EXPECT_TRUE(scenario.drawn.empty());
}

TEST_F(RandomisedScenario,
       is_refused_with_any_seed_where_an_end_of_a_range_is_beyond_its_keys_limits) {
  struct Case {
    const char *range, *told;
  };
  constexpr std::array<Case, 7> kCases{{
      {"disturbances.payload.mass=[-1e-9, 5]", "\"-1e-09\" is not a number from 0 to 200 kg"},
      {"sensors.imu.delay_ticks=[0, 1001]", "\"1001\" is more than 1000"},
      {"disturbances.shank_length_offset=[0, 0.11]", "LF: \"0.11\" is not a number between"},
      {"slip.end_speed=[0.01, 10]", "it must not be above begin_speed"},
      {"tasks.com_xy.kp=[-5, 80]", "kp is -5, but must be a number of at least 0"},
      {"tasks.limb_extension_limits.max=[0.5, 5.2]", "but this robot reaches only"},
      {"planner.stance.height=[0.46, 0.9]", "[0.46, 0.9]: randomise: planner.stance: foot LF"},
  }};
  for (const Case& one : kCases) {
    const std::string assignment = std::string("randomise.") + one.range;
    for (const std::uint64_t seed : {0u, 1u, 2u, 3u}) {
      const std::string told =
          message_of([&] { (void)load_scenario({"step_down", seed, {assignment}}); });
      EXPECT_TRUE(holds(told, one.told)) << one.range << ", seed " << seed << ": " << told;
      EXPECT_TRUE(holds(told, "randomise")) << told;
    }
  }
}

TEST_F(RandomisedScenario,
       names_file_line_and_key_of_a_range_beyond_limits_but_not_of_one_assigned) {
  const std::string heavy = "randomise:\n  disturbances.payload.mass: [-5, 5]\n";
  EXPECT_TRUE(
      holds(complaint(heavy), "trial.yaml:3: randomise: disturbances.payload.mass: \"-5\" is not"));
  EXPECT_NO_THROW((void)read(heavy, 1, {"disturbances.payload.mass=3"}));
}

TEST_F(RandomisedScenario, takes_ranges_that_end_at_their_keys_limits_also_of_large_whole_numbers) {
  const Scenario scenario = read(
      "terrain: {elements: {field: {shape: random_boxes, size_x: 1, size_y: 1, max_height: "
      "0.1}}}\nrandomise: {sensors.imu.delay_ticks: [0, 1000], "
      "terrain.elements.field.seed: [1e5, 1e5], disturbances.payload.mass: [0, 5]}\n",
      1);
  const auto seed =
      std::ranges::find(scenario.drawn, "terrain.elements.field.seed", &RandomDraw::path);
  ASSERT_NE(seed, scenario.drawn.end());
  EXPECT_EQ(seed->value, 1e5) << "which has a shorter form with an exponent";
}

TEST_F(RandomisedScenario, takes_ranges_of_the_command_line) {
  const std::vector<std::string> narrow{"randomise.terrain.friction=[0.45, 0.46]"};
  const Scenario scenario = read(kRandomFriction, 1, narrow);
  ASSERT_EQ(scenario.drawn.size(), 1u);
  EXPECT_NEAR(scenario.plant.terrain.friction, 0.455, 0.005);
  EXPECT_EQ(read("", 1, narrow).drawn.size(), 3u) << "beside what walk_flat draws";
  EXPECT_EQ(read("", 1, {"randomise.initial.yaw=~"}).drawn.size(), 1u);
  const Scenario worn = read("", 1, {narrow[0], "randomise.include=mismatch"});
  EXPECT_NEAR(worn.plant.terrain.friction, 0.455, 0.005) << "before the file's";
}

TEST_F(RandomisedScenario, names_the_range_of_the_command_line_that_is_wrong) {
  EXPECT_TRUE(holds(complaint("", {"randomise.terrain.frictoin=[0.4, 0.6]"}),
                    "terrain.frictoin: unknown key; did you mean \"friction\"?"));
  for (const char* wrong : {"[]", "[0.4]", "0.5", "{min: 0.4}"}) {
    EXPECT_TRUE(holds(complaint("", {std::string("randomise.terrain.friction=") + wrong}),
                      "randomise.terrain.friction: must be a range [min, max]"))
        << wrong;
  }
  EXPECT_TRUE(holds(complaint("", {"randomise.terrain.friction=[1.0, 0.4]"}),
                    "--set randomise.terrain.friction=[1.0, 0.4]: randomise.terrain.friction: min, "
                    "1, must not be above max, which is 0.4"));
}

TEST_F(RandomisedScenario, refuses_to_take_away_a_range_that_is_not_there) {
  EXPECT_TRUE(holds(complaint("", {"randomise.terrain.frictoin="}),
                    "randomise.terrain.frictoin: this is not drawn, so there is nothing to take "
                    "away; valid are: initial.yaw, "));
  EXPECT_TRUE(holds(complaint("", {"randomise.disturbances.mass_scale=~"}), "valid are: "));
  const Scenario included =
      read("", 1, {"randomise.include=mismatch", "randomise.disturbances.payload.mass=~"});
  EXPECT_EQ(std::ranges::count(included.drawn, "disturbances.payload.mass", &RandomDraw::path), 0);
}

}  // namespace
}  // namespace surefoot::config
