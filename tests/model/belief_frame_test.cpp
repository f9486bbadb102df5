#include "surefoot/model/belief_frame.hpp"

#include "surefoot/math/rotation.hpp"

#include <gtest/gtest.h>

namespace surefoot::model {
namespace {

const PerLeg<Vec3> kFeet{Vec3(0.36, 0.22, 0.0), Vec3(0.36, -0.22, 0.02), Vec3(-0.36, 0.22, 0.0),
                         Vec3(-0.36, -0.22, -0.01)};

TEST(BeliefFrame, FindsWhereTheControllersWorldLies) {
  const Mat3 R = rotation_about_z(0.8);
  const Vec3 p(3.0, -2.0, 0.4);
  PerLeg<Vec3> believed;
  for (std::size_t k = 0; k < kNumLegs; ++k) believed[k] = R.transpose() * (kFeet[k] - p);
  BeliefFrame frame;
  frame.update(MotionPlan{}, believed, kFeet);
  EXPECT_LT((frame.R_SW() - R).norm(), 1e-12);
  const Vec3 place(0.1, 0.2, 0.3);
  EXPECT_LT((frame.to_S(R.transpose() * (place - p)) - place).norm(), 1e-12);
}

TEST(BeliefFrame, AFootInTheAirPlaysNoPart) {
  PerLeg<Vec3> believed = kFeet;
  believed[1] += Vec3(0.5, 0.5, 0.5);
  MotionPlan plan;
  plan.feet[1].phase = LegPhase::swing;
  BeliefFrame frame;
  frame.update(plan, believed, kFeet);
  EXPECT_LT((frame.R_SW() - Mat3::Identity()).norm(), 1e-12);
}

}  // namespace
}  // namespace surefoot::model
