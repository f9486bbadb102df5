#include "surefoot/gaits/parts/impact_detector.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

constexpr double kPeriod = 0.0025;  // [s]

/// Does a foot that is stopped within so many ticks, its force risen, count as an impact?
bool is_impact(int ticks, double length) {
  ImpactDetector detector(TouchdownOptions{.bounce_force = 10.0}, kPeriod, Scale{.length = length});
  detector.begin();
  bool found = false;
  for (int i = 0; i < 20; ++i) (void)detector.is_impact(0.0, 0.4, 0.0);
  for (int i = 1; i <= ticks; ++i) found = detector.is_impact(0.5 * i / ticks, 0.4, 100.0) || found;
  return found;
}

TEST(ImpactDetector, SeesAFootThatIsStoppedAtOnce) {
  EXPECT_TRUE(is_impact(3, 1.0));
  EXPECT_FALSE(is_impact(6, 1.0)) << "so slowly drives change it";
}

TEST(ImpactDetector, SeesALargerRobotsFootThatIsStoppedMoreSlowly) {
  EXPECT_TRUE(is_impact(6, 4.0));
}

}  // namespace
}  // namespace surefoot::gaits
