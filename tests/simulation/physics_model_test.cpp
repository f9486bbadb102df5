#include "surefoot/model/urdf.hpp"
#include "surefoot/simulation/model_builder.hpp"
#include "surefoot/simulation/robot_parts.hpp"
#include "tests/simulation/plant_support.hpp"
#include "tests/support/biped.hpp"
#include "tests/support/changed_urdf.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace surefoot::simulation {
namespace {

using test::ChangedUrdf;
using test::holds;
using test::StockMujoco;

Mat3 inertia_in_link(const mjModel& model, int body) {
  const double* q = model.body_iquat + 4 * body;
  const Mat3 R = Quat(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Vec3 principal = Eigen::Map<const Vec3>(model.body_inertia + 3 * body);
  return R * principal.asDiagonal() * R.transpose();
}

/// A point of W in the axes of a link [m].
Vec3 in_link(const StockMujoco& mujoco, const std::string& link, const Vec3& p_W) {
  const int body = mujoco.body(link);
  Vec3 p;
  const Vec3 from_origin = p_W - Eigen::Map<const Vec3>(mujoco.data->xpos + 3 * body);
  mju_mulMatTVec3(p.data(), mujoco.data->xmat + 9 * body, from_origin.data());
  return p;
}

StockMujoco stock(const Plant& plant) { return {plant.model_xml(), plant.truth()}; }

TEST(PhysicsModel, SoleThicknessGoesWithItsLength) {
  std::vector<double> shares;
  for (const double size : {1.0, 2.0}) {
    model::RobotDescription robot = test::biped();
    robot.sole *= size;
    std::vector<std::string> notes;
    const BuiltModel built = build_model(robot, {}, notes);
    const int sole =
        mj_name2id(built.model.get(), mjOBJ_GEOM, foot_geom_name(Leg{0}, robot.num_legs()).c_str());
    const double* half = built.model->geom_size + 3 * sole;
    EXPECT_DOUBLE_EQ(2.0 * half[0], robot.sole.x());
    shares.push_back(half[2] / half[0]);
  }
  EXPECT_DOUBLE_EQ(shares[0], shares[1]);
}

TEST(PhysicsModel, WeighsWhatTheLinksOfTheUrdfWeigh) {
  const Plant plant(test::anymal_b(), test::standing_options());
  const StockMujoco mujoco = stock(plant);
  EXPECT_NEAR(mj_getTotalmass(mujoco.model.get()), test::kMass, 1e-6);
  // 30.4214 kg of the published table, four feet of 1 g and the IMU's 50 g.
  EXPECT_NEAR(test::kMass, 30.4214 + 4 * 0.001 + 0.05, 1e-4);
}

// Of the URDF, whose figures tests/model/ compares with the published ones.
TEST(PhysicsModel, EveryLinkHasItsMassCenterAndInertia) {
  const Plant plant(test::anymal_b(), test::standing_options());
  const StockMujoco mujoco = stock(plant);
  int compared = 0;
  for (const model::UrdfLink& link : model::read_urdf(test::anymal_b().urdf_path).links) {
    if (link.inertia.mass == 0.0) continue;
    SCOPED_TRACE(link.name);
    const int body = mujoco.body(link.name);
    ASSERT_GT(body, 0);
    EXPECT_NEAR(mujoco.model->body_mass[body], link.inertia.mass, 1e-8);
    const Vec3 com = Eigen::Map<const Vec3>(mujoco.model->body_ipos + 3 * body);
    EXPECT_LT((com - link.inertia.com).norm(), 1e-8);
    EXPECT_LT((inertia_in_link(*mujoco.model, body) - link.inertia.about_com).norm(), 1e-6);
    ++compared;
  }
  EXPECT_GE(compared, 1 + 4 * kNumLegs);
}

TEST(PhysicsModel, LeavesOutTheDummyInertiaAndSaysSo) {
  const Plant plant(test::anymal_b(), test::standing_options());
  ASSERT_EQ(plant.notes().size(), 1U);
  EXPECT_TRUE(holds(plant.notes()[0], "base"));
  EXPECT_TRUE(holds(plant.notes()[0], "1e-06 kg"));
  const StockMujoco mujoco = stock(plant);
  EXPECT_EQ(mujoco.model->body_mass[mujoco.body("base")], 0.0);
}

TEST(PhysicsModel, FeetStandWhereThePublishedKinematicsPutThem) {
  struct Posture {
    double haa, hfe, kfe;  // of the front left leg
    Vec3 foot;             // its foot frame in the base frame
  };
  for (const Posture& posture : {Posture{0.0, 0.0, 0.0, {0.4405, 0.246, -0.57125}},
                                 Posture{0.0, 0.4, -0.8, {0.4604, 0.246, -0.4872}},
                                 Posture{-0.25, 0.6, -0.85, {0.3757, 0.120, -0.5097}}}) {
    PlantOptions options = test::falling_options();
    for (const Leg leg : kLegs) {
      const double front = is_front(leg) ? 1.0 : -1.0;
      const double left = is_left(leg) ? 1.0 : -1.0;
      options.initial.q.segment<3>(first_joint(leg)) << left * posture.haa, front * posture.hfe,
          front * posture.kfe;
    }
    const Plant plant(test::anymal_b(), options);
    const StockMujoco mujoco = stock(plant);
    for (const Leg leg : kLegs) {
      const int body = mujoco.body(std::string(kLegNames[index(leg)]) + "_FOOT");
      const Vec3 foot = Eigen::Map<const Vec3>(mujoco.data->xpos + 3 * body) - plant.truth().p_SB;
      const Vec3 mirror(is_front(leg) ? 1.0 : -1.0, is_left(leg) ? 1.0 : -1.0, 1.0);
      EXPECT_LT((foot - mirror.cwiseProduct(posture.foot)).cwiseAbs().maxCoeff(), 1e-4);
    }
  }
}

TEST(PhysicsModel, JointsAreMappedByNameWhateverTheOrderOfTheDescription) {
  model::RobotDescription swapped = test::anymal_b();
  std::swap(swapped.legs[index(Leg::RF)], swapped.legs[index(Leg::LH)]);
  PlantOptions options = test::falling_options();
  for (Eigen::Index i = 0; i < kNumLegJoints; ++i)
    options.initial.q[i] = 0.01 * static_cast<double>(i);
  Plant plant(swapped, options);
  EXPECT_LT((plant.truth().q - options.initial.q).norm(), 1e-12);
  const StockMujoco mujoco = stock(plant);
  const auto angle = [&mujoco](const char* name) {
    return mujoco.data
        ->qpos[mujoco.model->jnt_qposadr[mj_name2id(mujoco.model.get(), mjOBJ_JOINT, name)]];
  };
  EXPECT_DOUBLE_EQ(angle("LF_KFE"), 0.02);
  EXPECT_DOUBLE_EQ(angle("LH_HAA"), 0.03);
  EXPECT_DOUBLE_EQ(angle("RF_HFE"), 0.07);

  JointCommand command;
  command.torque[4] = 5.0;  // second joint of the second leg: LH_HFE
  plant.write(command);
  EXPECT_EQ(plant.truth().torque, command.torque);
  Eigen::Index fastest = 0;
  plant.truth().qd.cwiseAbs().maxCoeff(&fastest);
  EXPECT_TRUE(fastest == 4 || fastest == 5) << fastest;
}

TEST(PhysicsModel, JointsHaveNoFrictionDampingOrRotorInertiaOfTheirOwn) {
  const Plant plant(test::anymal_b(), test::standing_options());
  const StockMujoco mujoco = stock(plant);
  for (int dof = 0; dof < mujoco.model->nv; ++dof) {
    EXPECT_EQ(mujoco.model->dof_damping[dof], 0.0);
    EXPECT_EQ(mujoco.model->dof_frictionloss[dof], 0.0);
    EXPECT_EQ(mujoco.model->dof_armature[dof], 0.0);
  }
}

TEST(PhysicsModel, EveryCollisionShapeOfTheUrdfIsThereAndCanTouchTerrain) {
  const Plant plant(test::anymal_b(), test::standing_options());
  const StockMujoco mujoco = stock(plant);
  std::map<std::string, int> shapes;
  for (int geom = 0; geom < mujoco.model->ngeom; ++geom) {
    if (mujoco.model->geom_bodyid[geom] == 0) continue;
    ++shapes[mj_id2name(mujoco.model.get(), mjOBJ_BODY, mujoco.model->geom_bodyid[geom])];
    EXPECT_NE(mujoco.model->geom_conaffinity[geom] & 1, 0);
  }
  EXPECT_EQ(shapes["base"], 8);
  EXPECT_EQ(shapes["LF_HIP"], 2);
  EXPECT_EQ(shapes["RH_THIGH"], 3);
  EXPECT_EQ(shapes["LH_SHANK"], 1);
  EXPECT_EQ(shapes["RF_ADAPTER"], 1);
  EXPECT_EQ(shapes["LF_FOOT"], 1);
  EXPECT_EQ(mujoco.model->nmesh, 0);
}

TEST(PhysicsModel, OwnShapesDoNotTouchInAnyKneeConfiguration) {
  for (const double front_knee : {-0.8, 0.8}) {
    for (const double hind_knee : {-0.8, 0.8}) {
      for (const double scale : {0.5, 1.0, 2.2}) {
        PlantOptions options = test::falling_options();
        for (const Leg leg : kLegs) {
          const double knee = scale * (is_front(leg) ? front_knee : hind_knee);
          options.initial.q.segment<3>(first_joint(leg)) << 0.0, -0.5 * knee, knee;
        }
        const Plant plant(test::anymal_b(), options);
        EXPECT_EQ(plant.truth().body_contact_force, 0.0) << front_knee << hind_knee << scale;
      }
    }
  }
}

TEST(PhysicsModel, TwoLegsThatAreSwungIntoEachOtherCollide) {
  PlantOptions options = test::falling_options();
  Plant plant(test::anymal_b(), options);
  JointCommand inwards;
  inwards.torque[first_joint(Leg::LF)] = -20.0;
  inwards.torque[first_joint(Leg::RF)] = 20.0;
  double force = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    plant.write(inwards);
    force = std::max(force, plant.truth().body_contact_force);
    EXPECT_FALSE(plant.truth().torso_contact);
    EXPECT_EQ(plant.truth().shank_contacts, 0) << "a leg is not the ground";
  }
  EXPECT_GT(force, 1.0);
}

TEST(PhysicsModel, AMeshThatCollidesIsInTheModelItself) {
  std::string xml;
  GroundTruth truth;
  {
    ChangedUrdf urdf("<link name=\"imu_link\">",
                     "<link name=\"imu_link\"><collision><geometry><mesh filename=\"wedge.obj\" "
                     "scale=\"0.1 0.2 0.3\"/></geometry></collision>");
    const std::string folder = std::filesystem::path(urdf.robot().urdf_path).parent_path();
    test::write_file(folder + "/wedge.obj",
                     "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const Plant plant(urdf.robot(), test::standing_options());
    xml = plant.model_xml();
    truth = plant.truth();
  }
  const StockMujoco mujoco{xml, truth};  // its files are gone
  ASSERT_EQ(mujoco.model->nmesh, 1);
  EXPECT_EQ(mujoco.model->mesh_vertnum[0], 4);
  EXPECT_NEAR(mj_getTotalmass(mujoco.model.get()), test::kMass, 1e-6);
  const int geom = mujoco.model->body_geomadr[mujoco.body("imu_link")];
  Vec3 low = Vec3::Constant(1.0), high = -low;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Map<const Eigen::Vector3f> vertex(mujoco.model->mesh_vert + 3 * i);
    Vec3 p_W;
    mju_mulMatVec3(p_W.data(), mujoco.data->geom_xmat + 9 * geom,
                   Vec3(vertex.cast<double>()).data());
    p_W += Eigen::Map<const Vec3>(mujoco.data->geom_xpos + 3 * geom);
    const Vec3 p = in_link(mujoco, "imu_link", p_W);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_LT(low.norm(), 1e-6);
  EXPECT_LT((high - Vec3(0.1, 0.2, 0.3)).norm(), 1e-6);
}

TEST(PhysicsModel, AFootSphereThatTheUrdfLacksIsAddedWithoutMass) {
  model::RobotDescription robot = test::anymal_b();
  for (model::LegDescription& leg : robot.legs) {
    leg.foot_frame.replace(3, 4, "ADAPTER");
    leg.foot_center = Vec3(0.0, 0.0, -0.31);
  }
  const Plant plant(robot, test::standing_options());
  EXPECT_EQ(plant.notes().size(), 5U) << "dummy inertia, four feet";
  EXPECT_NEAR(mj_getTotalmass(stock(plant).model.get()), test::kMass, 1e-6);
}

}  // namespace
}  // namespace surefoot::simulation
