#include "tests/simulation/plant_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::simulation {
namespace {

using test::kMass;

/// Momentum that a push gives to a falling robot, gravity taken away.
Vec3 momentum_after(const Push& push, double duration) {
  PlantOptions options = test::falling_options();
  options.disturbances.pushes = {push};
  Plant plant(test::anymal_b(), options);
  while (plant.time() < duration - 1e-9) plant.write({});
  return kMass * (plant.truth().v_SCom + Vec3(0.0, 0.0, kGravity * plant.time()));
}

TEST(Push, GivesItsImpulseWhateverLinkItActsOnAlsoBetweenPhysicsSteps) {
  struct Case {
    Push push;
    double until, tolerance;
  };
  for (const Case& one : {Case{{"", 0.1, 0.2, Vec3(30.0, -50.0, 20.0)}, 0.4, 0.02},
                          Case{{"base", 0.0, 0.02, Vec3(0.0, 40.0, 0.0)}, 0.05, 0.02},
                          Case{{"LF_THIGH", 0.0, 0.02, Vec3(0.0, 40.0, 0.0)}, 0.05, 0.02},
                          Case{{"RH_SHANK", 0.0, 0.02, Vec3(0.0, 40.0, 0.0)}, 0.05, 0.02},
                          Case{{"", 0.01013, 0.02371, Vec3(0.0, 50.0, 0.0)}, 0.05, 2e-3}}) {
    const Vec3 impulse = one.push.duration * one.push.force;
    EXPECT_LT((momentum_after(one.push, one.until) - impulse).norm(), one.tolerance);
  }
  EXPECT_LT(momentum_after({"", 0.3, 0.1, Vec3(100.0, 0.0, 0.0)}, 0.3).norm(), 1e-6) << "before";
}

TEST(Push, AddsToOthersOnTheSameLink) {
  PlantOptions options = test::falling_options();
  const Push push{"", 0.0, 0.1, Vec3(0.0, 25.0, 0.0)};
  options.disturbances.pushes = {push, push};
  Plant plant(test::anymal_b(), options);
  while (plant.time() < 0.2 - 1e-9) plant.write({});
  EXPECT_NEAR(kMass * plant.truth().v_SCom.y(), 5.0, 0.02);
}

TEST(Push, OffTheCenterOfMassTurnsTheRobot) {
  PlantOptions options = test::falling_options();
  options.disturbances.pushes = {{"LF_HIP", 0.0, 0.1, Vec3(0.0, 30.0, 0.0)}};
  Plant plant(test::anymal_b(), options);
  for (int tick = 0; tick < 40; ++tick) plant.write({});
  EXPECT_GT(plant.truth().w_SB_B.z(), 0.1);
}

TEST(Lift, TheHandRisesStaysAndComesDownAndLetsGo) {
  PlantOptions options = test::standing_options();
  options.initial.settle = 0.6;
  options.disturbances.lifts = {{.time = 0.2, .height = 0.3, .duration = 0.5, .hold = 1.0}};
  Plant plant(test::anymal_b(), options);
  const auto hold = [&](double until) {
    while (plant.time() < until - 1e-9) {
      const GroundTruth& truth = plant.truth();
      JointCommand command;
      command.torque = 200.0 * (options.initial.q - truth.q) - 5.0 * truth.qd;
      plant.write(command);
    }
    return plant.truth();
  };
  const double standing = hold(0.2).p_SB.z();
  const GroundTruth up = hold(1.6);
  EXPECT_NEAR(up.p_SB.z() - standing, 0.3 - 0.03, 0.01);  // the hand gives way under the weight
  EXPECT_LT(up.v_SB.norm(), 0.05);
  for (const TrueContact& foot : up.feet) EXPECT_FALSE(foot.touching);
  const GroundTruth down = hold(4.0);
  EXPECT_NEAR(down.p_SB.z(), standing, 0.03);
  for (const TrueContact& foot : down.feet) EXPECT_TRUE(foot.touching);
  const auto& pulls = down.xfrc_applied;
  EXPECT_TRUE(std::ranges::all_of(pulls, [](double pull) { return pull == 0.0; }));
}

TEST(Payload, AddsItsWeightAndMovesTheCenterOfMass) {
  const GroundTruth plain = Plant(test::anymal_b(), test::standing_options()).truth();
  PlantOptions options = test::standing_options();
  options.disturbances.payload = {6.0, Vec3(0.1, -0.05, 0.25)};
  test::HeldRobot robot(options);
  const Vec3 payload = robot.truth().p_SB + options.disturbances.payload.position;
  const Vec3 expected = (kMass * plain.p_SCom + 6.0 * payload) / (kMass + 6.0);
  EXPECT_LT((robot.truth().p_SCom - expected).norm(), 1e-9);
  robot.run(1.0);
  const double weight = (kMass + 6.0) * kGravity;
  EXPECT_NEAR(robot.ground_force().z(), weight, 0.01 * weight);
}

TEST(WrongMasses, ScaleBaseAndLegsApart) {
  for (const auto& [base, leg] : {std::pair{1.15, 1.0}, {1.0, 0.85}, {0.9, 1.1}}) {
    PlantOptions options = test::standing_options();
    options.disturbances.base_mass_scale = base;
    options.disturbances.leg_mass_scale = leg;
    const Plant plant(test::anymal_b(), options);
    const test::StockMujoco mujoco(plant.model_xml(), plant.truth());
    const double base_mass = 16.793507758 + 0.05;  // with the IMU
    EXPECT_NEAR(mj_getTotalmass(mujoco.model.get()), base * base_mass + leg * (kMass - base_mass),
                1e-6);
  }
}

TEST(WrongMasses, ScaleInertiasToo) {
  PlantOptions options = test::standing_options();
  const Plant plain(test::anymal_b(), options);
  options.disturbances.base_mass_scale = 1.3;
  options.disturbances.leg_mass_scale = 0.7;
  const Plant scaled(test::anymal_b(), options);
  const test::StockMujoco before(plain.model_xml(), plain.truth());
  const test::StockMujoco after(scaled.model_xml(), scaled.truth());
  for (const auto& [name, scale] : {std::pair{"base_inertia", 1.3}, {"RF_THIGH", 0.7}}) {
    for (int axis = 0; axis < 3; ++axis) {
      const int i = 3 * before.body(name) + axis;
      EXPECT_NEAR(after.model->body_inertia[i], scale * before.model->body_inertia[i], 1e-12);
    }
  }
}

TEST(WrongMasses, MoveTheCenterOfMassOfTheBase) {
  const Vec3 offset(0.02, -0.01, 0.015);
  PlantOptions options = test::standing_options();
  const Vec3 before = Plant(test::anymal_b(), options).truth().p_SCom;
  options.disturbances.base_com_offset = offset;
  const Vec3 after = Plant(test::anymal_b(), options).truth().p_SCom;
  EXPECT_LT((after - before - (16.793507758 + 0.05) / kMass * offset).norm(), 1e-9);
}

TEST(WrongMasses, ScaleEachLinkOfALegByItself) {
  PlantOptions options = test::standing_options();
  const Plant plain(test::anymal_b(), options);
  for (Eigen::Index i = 0; i < kNumLegJoints; ++i) {
    options.disturbances.link_mass_scale[i] = 0.85 + 0.02 * static_cast<double>(i);
  }
  options.disturbances.leg_mass_scale = 1.1;
  const Plant scaled(test::anymal_b(), options);
  const test::StockMujoco before(plain.model_xml(), plain.truth());
  const test::StockMujoco after(scaled.model_xml(), scaled.truth());
  for (const auto& [name, link] : {std::pair{"LF_HIP", 0},
                                   {"LF_THIGH", 1},
                                   {"LF_SHANK", 2},
                                   {"LF_FOOT", 2},
                                   {"RF_HIP", 3},
                                   {"RH_SHANK", 11}}) {
    const auto i = static_cast<std::size_t>(before.body(name));
    EXPECT_NEAR(after.model->body_mass[i], 1.1 * (0.85 + 0.02 * link) * before.model->body_mass[i],
                1e-12)
        << name;
  }
  const auto base = static_cast<std::size_t>(before.body("base_inertia"));
  EXPECT_EQ(after.model->body_mass[base], before.model->body_mass[base]);
}

/// Distances HFE to KFE axis and KFE axis to the centre of the foot sphere, seen along the axes.
std::pair<double, double> lengths_of(const Plant& plant, Leg leg) {
  const test::StockMujoco mujoco(plant.model_xml(), plant.truth());
  const std::string name(kLegNames[index(leg)]);
  const auto joint = [&](const char* which) {
    return mj_name2id(mujoco.model.get(), mjOBJ_JOINT, (name + which).c_str());
  };
  const auto at = [](const mjtNum* values, int i) {
    return Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  };
  const auto across = [](const Vec3& v, const Vec3& axis) {
    return (v - axis * axis.dot(v)).norm();
  };
  const Vec3 hip = at(mujoco.data->xanchor, joint("_HFE"));
  const Vec3 knee = at(mujoco.data->xanchor, joint("_KFE"));
  return {across(knee - hip, at(mujoco.data->xaxis, joint("_HFE"))),
          across(plant.truth().p_SF[index(leg)] - knee, at(mujoco.data->xaxis, joint("_KFE")))};
}

TEST(WrongLengths, AreThoseThatWereAskedFor) {
  PlantOptions options = test::standing_options();
  options.initial.q.setLinSpaced(-0.4, 0.5);  // any posture
  options.initial.position.z() = 5.0;
  const Plant plain(test::anymal_b(), options);
  options.disturbances.thigh_length_offset = {0.01, -0.01, 0.0, 0.004};
  options.disturbances.shank_length_offset = {-0.008, 0.01, -0.01, 0.0};
  const Plant other(test::anymal_b(), options);
  for (const Leg leg : kLegs) {
    const auto [thigh, shank] = lengths_of(plain, leg);
    const auto [other_thigh, other_shank] = lengths_of(other, leg);
    EXPECT_NEAR(other_thigh - thigh, options.disturbances.thigh_length_offset[index(leg)], 1e-9);
    EXPECT_NEAR(other_shank - shank, options.disturbances.shank_length_offset[index(leg)], 1e-9);
  }
  EXPECT_NEAR(lengths_of(plain, Leg::LF).first, 0.25, 1e-9);
}

}  // namespace
}  // namespace surefoot::simulation
