#include "app/lying_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace surefoot {
namespace {

TEST(LyingText, is_that_of_the_page) {
  const auto words =
      nlohmann::json::parse(std::ifstream(SUREFOOT_SOURCE_DIR "/tests/support/lying_words.json"));
  for (const auto& one : words) {
    GroundTruth truth;
    truth.torso_contact = one.at(0) == 1;
    truth.shank_contacts = one.at(1);
    truth.body_contact_force = one.at(2);
    const int feet = one.at(3);
    for (const Leg leg : kLegs) truth.feet[index(leg)].touching = ((feet >> index(leg)) & 1) != 0;
    EXPECT_EQ(lying_text(truth), one.at(4).get<std::string>());
  }
}

}  // namespace
}  // namespace surefoot
