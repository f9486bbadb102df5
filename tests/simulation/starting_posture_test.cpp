// Starting postures that would throw the robot over are refused.
#include "surefoot/model/robot_model.hpp"
#include "tests/simulation/plant_support.hpp"
#include "tests/support/changed_urdf.hpp"
#include "tests/support/hyq.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

namespace surefoot::simulation {
namespace {

using test::ChangedUrdf;
using test::holds;

std::string shape(const std::string& geometry, const std::string& xyz) {
  return "<collision><origin xyz=\"" + xyz + "\"/><geometry>" + geometry +
         "</geometry></collision>";
}

/// ANYmal B with a rotor that is fixed to a link of the left front leg.
ChangedUrdf with_rotor(const std::string& link, const std::string& collision) {
  return {"</robot>", "<link name=\"rotor\">" + collision +
                          "</link><joint name=\"rotor\" type=\"fixed\"><parent link=\"" + link +
                          "\"/><child link=\"rotor\"/></joint></robot>"};
}

std::string error_of(const ChangedUrdf& urdf) {
  return test::error_of(urdf.robot(), test::standing_options());
}

TEST(StartingPosture,
     what_is_fixed_to_a_thigh_may_lie_in_the_base_and_what_is_fixed_to_a_shank_in_the_hip) {
  EXPECT_EQ(error_of(with_rotor("LF_THIGH", shape("<sphere radius=\"0.05\"/>", "-0.1 -0.1 0.1"))),
            "");
  EXPECT_EQ(error_of(with_rotor("LF_ADAPTER", shape("<sphere radius=\"0.03\"/>", "0.1 -0.1 0.2"))),
            "");
}

TEST(StartingPosture, links_that_overlap_are_named_with_their_depth) {
  const std::string error =
      error_of(with_rotor("LF_SHANK", shape("<box size=\"0.3 1.0 0.05\"/>", "0 0 -0.2")));
  EXPECT_TRUE(holds(error, "changed.urdf: in the starting posture the collision shapes of links "));
  EXPECT_TRUE(holds(error, "\"rotor\""));
  EXPECT_TRUE(holds(error, " mm"));
}

TEST(StartingPosture, a_foot_with_a_shape_below_its_sphere_is_told_by_how_much) {
  for (const char* lower :
       {"<box size=\"0.02 0.02 0.1\"/>", "<cylinder radius=\"0.01\" length=\"0.1\"/>",
        "<capsule radius=\"0.01\" length=\"0.08\"/>"}) {
    ChangedUrdf urdf;
    urdf.change("<collision>\n      <origin xyz=\"0 0 0.02325\"/>",
                shape(lower, "0 0 0.02325") + "<collision>\n      <origin xyz=\"0 0 0.02325\"/>");
    const std::string error = error_of(urdf);
    EXPECT_TRUE(holds(error, "a collision shape of link \"LF_FOOT\" reaches ")) << lower;
    EXPECT_TRUE(holds(error, " mm below the foot sphere of LF")) << lower;
  }
}

TEST(StartingPosture, a_joint_beyond_its_stops_is_named) {
  const ChangedUrdf urdf("lower=\"-9.42\" upper=\"9.42\"", "lower=\"0.1\" upper=\"9.42\"");
  EXPECT_TRUE(holds(error_of(urdf),
                    "joint \"LF_HAA\" would begin at 0.000 rad, beyond its stops in "
                    "the URDF, 0.100 to 9.420 rad"));
}

TEST(StartingPosture, a_robot_that_does_not_stand_may_have_its_feet_up) {
  PlantOptions options = test::standing_options();
  for (const Leg leg : kLegs)
    options.initial.q.segment<3>(first_joint(leg)) << 0.0, (is_front(leg) ? -1.7 : 1.7), 0.0;
  EXPECT_EQ(test::error_of(test::anymal_b(), options), "");
}

TEST(StartingPosture, HyQ_has_the_same_mass_in_both_models_and_stands) {
  const model::RobotModel model(test::hyq());
  PlantOptions options;
  options.initial.q = test::hyq().q_nominal;
  options.initial.settle = 0.6;
  const Plant plant(test::hyq(), options);
  const test::StockMujoco stock(plant.model_xml(), plant.truth());
  EXPECT_NEAR(mj_getTotalmass(stock.model.get()), model.mass(), 1e-9 * model.mass());
  for (const TrueContact& foot : plant.truth().feet) EXPECT_TRUE(foot.touching);
  EXPECT_LT(plant.truth().v_SB.norm(), 0.01);
}

}  // namespace
}  // namespace surefoot::simulation
