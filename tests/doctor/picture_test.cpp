// The picture of a robot that the doctor draws.
#include "surefoot/doctor/picture.hpp"

#include "surefoot/doctor/skeleton.hpp"
#include "surefoot/model/mesh_files.hpp"
#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::doctor {
namespace {

using Picture = test::ChangedRobot;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t result = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++result;
  return result;
}

TEST_F(Picture, is_xml_that_names_each_joint_and_foot_once) {
  const std::string svg = picture(diagnosis());
  EXPECT_NO_THROW((void)model::mesh_files(svg, {}));
  for (const char* leg : {"LF", "RF", "LH", "RH"}) {
    for (const char* part : {"_HAA<", "_HFE<", "_KFE<", "_FOOT, r 31 mm<"})
      EXPECT_EQ(count(svg, std::string(">") + leg + part), 1U) << leg << part;
  }
  EXPECT_EQ(count(svg, "centre of mass, 30.48 kg"), 3U);
}

TEST_F(Picture, shows_the_robot_as_it_stands) {
  const Diagnosis robot = diagnosis();
  const Skeleton skeleton = skeleton_of(robot);
  ASSERT_EQ(skeleton.limbs.size(), kNumLegs);
  for (const Leg leg : kLegs) {
    const DrawnLimb& limb = skeleton.limbs[index(leg)];
    const Vec3 q = robot.robot->q_nominal.segment<3>(first_joint(leg));
    const Vec3 expected = (*robot.anatomy.legs)[index(leg)].chain.foot_in_base(q);
    EXPECT_LT((limb.tip - expected).norm(), 1e-9);
    EXPECT_EQ(limb.radius, 0.031);
  }
  EXPECT_LT((skeleton.limbs[0].joints[2].axis - Vec3::UnitY()).norm(), 1e-9);
}

TEST_F(Picture, of_a_robot_without_legs_shows_its_limbs) {
  change("<joint name=\"RH_HAA\"", "type=\"revolute\"", "type=\"fixed\"");
  const std::string svg = picture(diagnosis());
  EXPECT_EQ(count(svg, ">RH_KFE<"), 1U);
  EXPECT_EQ(count(svg, ">LF_FOOT, r 31 mm<"), 1U);
}

TEST_F(Picture, has_names_with_signs_of_xml) {
  replace_all("\"LF_HFE\"", "\"a &amp; &lt;b&gt;\"");
  EXPECT_NO_THROW((void)model::mesh_files(picture(diagnosis()), {}));
}

TEST_F(Picture, lies_beside_the_robot_file) {
  EXPECT_EQ(write_picture(diagnosis(), folder_ / "robot.yaml"), folder_ / "robot.svg");
  EXPECT_TRUE(test::holds(test::contents(folder_ / "robot.svg"), "from above"));
}

}  // namespace
}  // namespace surefoot::doctor
