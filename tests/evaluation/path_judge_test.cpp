#include "surefoot/evaluation/path_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::evaluation {
namespace {

constexpr double kPeriod = 0.0025;

/// A robot that goes where `velocity` takes it, whatever it is asked for.
struct Walker {
  void walk(double duration, const Vec2& velocity) {
    for (int i = 0; i < std::lround(duration / kPeriod); ++i) {
      position.head<2>() += kPeriod * velocity;
      truth.p_SB = position;
      truth.p_SF.fill(position);
      judge.add(truth, user, heading);
    }
  }
  [[nodiscard]] Metrics metrics() const {
    Metrics result;
    judge.write(result);
    return result;
  }

  PathJudge judge{kPeriod};
  simulation::GroundTruth truth;
  UserCommand user{.walk = true, .velocity = {0.2, 0.0}};
  Vec3 heading = Vec3::UnitY();
  Vec3 position{3.0, -1.0, 0.4};
};

TEST(PathJudge, BeingLateIsNoDeviation) {
  Walker walker;
  walker.walk(2.0, {0.0, 0.2});
  walker.walk(2.0, {0.0, 0.0});
  EXPECT_NEAR(walker.metrics().path_deviation_max_m, 0.0, 1e-9);
}

TEST(PathJudge, MeasuresAcrossThePath) {
  Walker walker;
  walker.walk(1.0, {-0.05, 0.2});
  walker.walk(1.0, {0.05, 0.2});
  EXPECT_NEAR(walker.metrics().path_deviation_max_m, 0.05, 1e-3);
  EXPECT_NEAR(walker.metrics().path_deviation_base_max_m, 0.05, 1e-3);
}

TEST(PathJudge, FollowsACommandToTheSide) {
  Walker walker;
  walker.user.velocity = {0.0, 0.1};
  walker.walk(3.0, {-0.1, 0.0});
  EXPECT_NEAR(walker.metrics().path_deviation_max_m, 0.0, 1e-9);
}

TEST(PathJudge, SaysNothingOfARobotThatWasNotAskedToWalk) {
  EXPECT_TRUE(std::isnan(Walker().metrics().path_deviation_max_m));
}

}  // namespace
}  // namespace surefoot::evaluation
