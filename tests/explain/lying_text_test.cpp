#include "surefoot/explain/lying_text.hpp"

#include "tests/support/source_file.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace surefoot::explain {
namespace {

TEST(LyingText, is_that_of_the_page) {
  const auto words =
      nlohmann::json::parse(std::ifstream(test::source_file("tests/support/lying_words.json")));
  for (const auto& one : words) {
    simulation::GroundTruth truth;
    truth.torso_contact = one.at(0) == 1;
    truth.shank_contacts = one.at(1);
    truth.body_contact_force = one.at(2);
    const int feet = one.at(3);
    for (const Leg leg : kLegs) truth.feet[index(leg)].touching = ((feet >> index(leg)) & 1) != 0;
    GroundTouch touch;
    touch.see(truth);
    EXPECT_EQ(lying_text(touch), one.at(4).get<std::string>());
  }
}

TEST(LyingText, a_part_that_has_just_left_the_ground_still_counts) {
  simulation::GroundTruth down, up;
  down.torso_contact = true;
  down.body_contact_force = 115.0;
  GroundTouch touch;
  for (const simulation::GroundTruth& truth : {down, up}) touch.see(truth);
  EXPECT_EQ(lying_text(touch), "its torso, up to 115 N on a part");
}

}  // namespace
}  // namespace surefoot::explain
