#include "app/tick_text.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

TEST(TickText, AForceThatIsRoundedAwayHasNoSign) {
  TickExplanation explanation;
  for (FootPlan& foot : explanation.tick.plan.feet) foot.phase = LegPhase::stance;
  explanation.forces.normal.fill(-0.04);
  explanation.truth.emplace();
  for (TrueContact& contact : explanation.truth->feet) {
    contact.touching = true;
    contact.force = Vec3(0.0, 0.0, -0.04);
  }
  const std::string text = tick_text("run.mcap", explanation);
  EXPECT_NE(text.find("0.0 N"), std::string::npos) << text;
  EXPECT_EQ(text.find("-0.0 N"), std::string::npos) << text;
}

}  // namespace
}  // namespace surefoot
