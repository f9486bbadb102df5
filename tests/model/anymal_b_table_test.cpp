// ANYmal B against its makers' published figures, typed in here, not read from the URDF.
#include "surefoot/model/body_tree.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::model {
namespace {

using test::anymal_b;
using test::holds;

constexpr double kTolerance = 1e-6;

// The packaged URDF adds to the published one: an IMU, and a gram for each foot.
constexpr double kImuMass = 0.05;
const Vec3 kImuPosition(0.038, 0.06245, 0.1837);
constexpr double kFootMass = 0.001;

struct PublishedInertia {
  std::string link;
  double mass;
  Vec3 com;
  Eigen::Matrix<double, 6, 1> inertia;  // xx xy xz yy yz zz
};

Mat3 to_matrix(const Eigen::Matrix<double, 6, 1>& i) {
  Mat3 result;
  result << i[0], i[1], i[2], i[1], i[3], i[4], i[2], i[4], i[5];
  return result;
}

std::vector<PublishedInertia> published() {
  return {{"base_inertia",
           16.793507758,
           {-0.001960558, -0.001413218, 0.050207125},
           {0.217391101503, -0.00132873239, -0.00228200226, 0.639432546734, -0.00138078263,
            0.62414077654}},
          {"LF_HIP",
           1.42462064,
           {0.064516258, -0.003787102, -0.000152184},
           {0.00243023350, -1.530e-5, -2.182e-5, 0.00230257239, 2.647e-5, 0.00198067592}},
          {"LF_THIGH",
           1.634976467,
           {-0.003897968, 0.054226619, -0.214583374},
           {0.0120367944, 6.762e-5, 2.878e-4, 0.0120643638, -1.4061e-3, 0.0024942257}},
          {"LF_SHANK",
           0.207204302,
           {0.030816858, -0.004617229, 0.000893126},
           {2.104880e-4, -5.675e-5, 1.0128e-5, 6.762702e-4, -8.23e-7, 5.450327e-4}},
          {"LF_ADAPTER",
           0.140170767,
           {0.0, 0.0, -0.244345749},
           {0.0015993874, 0.0, 0.0, 0.0015993874, 0.0, 5.44232e-5}}};
}

TEST(AnymalB, has_the_published_masses_and_inertias) {
  const Urdf urdf = read_urdf(anymal_b().urdf_path);
  for (const PublishedInertia& expected : published()) {
    SCOPED_TRACE(expected.link);
    const UrdfLink* link = urdf.find_link(expected.link);
    ASSERT_NE(link, nullptr);
    EXPECT_NEAR(link->inertia.mass, expected.mass, kTolerance);
    EXPECT_LT((link->inertia.com - expected.com).norm(), kTolerance);
    EXPECT_LT((link->inertia.about_com - to_matrix(expected.inertia)).norm(), kTolerance);
  }
}

TEST(AnymalB, mirrors_its_inertias_from_leg_to_leg) {
  const Urdf urdf = read_urdf(anymal_b().urdf_path);
  for (const char* part : {"_HIP", "_THIGH", "_SHANK", "_ADAPTER"}) {
    const Inertia& left_fore = urdf.find_link(std::string("LF") + part)->inertia;
    for (const Leg leg : kLegs) {
      const Inertia& other = urdf.find_link(std::string(kLegNames[index(leg)]) + part)->inertia;
      const Vec3 mirror(is_front(leg) ? 1.0 : -1.0, is_left(leg) ? 1.0 : -1.0, 1.0);
      EXPECT_NEAR(other.mass, left_fore.mass, kTolerance);
      EXPECT_LT((other.com - mirror.cwiseProduct(left_fore.com)).norm(), 1e-5);
      EXPECT_LT((other.about_com - mirror.asDiagonal() * left_fore.about_com * mirror.asDiagonal())
                    .norm(),
                1e-5);
    }
  }
}

TEST(AnymalB, lumps_the_welded_links_of_a_shank) {
  const BodyTree tree = make_body_tree(anymal_b(), read_urdf(anymal_b().urdf_path));
  Inertia lumped = tree.limb_bodies[2].inertia;
  // Without the gram at the foot.
  const Inertia foot{-kFootMass, Vec3(0.1, -0.02, -0.32125), Mat3::Identity() * -4.9e-7};
  lumped = lumped + foot;
  EXPECT_NEAR(lumped.mass, 0.347375, kTolerance);
  EXPECT_LT((lumped.com - Vec3(0.058733, -0.010824, -0.098064)).norm(), kTolerance);
  Eigen::Matrix<double, 6, 1> inertia;
  inertia << 0.00685813, 3.2229e-5, 0.00142869, 0.00770431, -3.16237e-4, 0.00101942;
  EXPECT_LT((lumped.about_com - to_matrix(inertia)).norm(), kTolerance);
}

TEST(AnymalB, drops_the_placeholder_inertia_of_its_root_and_says_so) {
  const RobotModel model(anymal_b());
  ASSERT_EQ(model.notes().size(), 1u);
  EXPECT_TRUE(holds(model.notes()[0], "\"base\""));
  EXPECT_NEAR(model.mass(), 30.421396 + kImuMass + 4.0 * kFootMass, 2e-6);
}

struct Posture {
  double haa, hfe, kfe;  ///< of the left front leg; mirrored for the others
  Vec3 published_foot;   ///< foot frame of that leg in B, to four digits
};

Vec3 leg_angles(const Posture& posture, Leg leg) {
  const double side = is_left(leg) ? 1.0 : -1.0;
  const double end = is_front(leg) ? 1.0 : -1.0;
  return {side * posture.haa, end * posture.hfe, end * posture.kfe};
}

/// Foot frame of the left front leg by planar trigonometry.
Vec3 foot_by_trigonometry(const Posture& posture) {
  const double knee = posture.hfe + posture.kfe;
  const double x = -0.25 * std::sin(posture.hfe) + 0.1 * std::cos(knee) - 0.32125 * std::sin(knee);
  const double z = -0.25 * std::cos(posture.hfe) - 0.1 * std::sin(knee) - 0.32125 * std::cos(knee);
  const double y = 0.041 + 0.109 - 0.02;
  return {0.277 + 0.0635 + x, 0.116 + y * std::cos(posture.haa) - z * std::sin(posture.haa),
          y * std::sin(posture.haa) + z * std::cos(posture.haa)};
}

TEST(AnymalB, has_its_feet_at_the_published_places_in_three_postures) {
  RobotDescription robot = anymal_b();
  for (LegDescription& leg : robot.legs)
    leg.foot_center.setZero();  // the published points are the origins of the foot frames
  const RobotModel model(robot);
  for (const Posture& posture : {Posture{0.0, 0.0, 0.0, {0.4405, 0.246, -0.5713}},
                                 Posture{0.0, 0.4, -0.8, {0.4604, 0.246, -0.4872}},
                                 Posture{-0.25, 0.6, -0.85, {0.3757, 0.120, -0.5097}}}) {
    const Vec3 exact = foot_by_trigonometry(posture);
    EXPECT_LT((exact - posture.published_foot).cwiseAbs().maxCoeff(), 5.1e-5);
    for (const Leg leg : kLegs) {
      const Vec3 mirror(is_front(leg) ? 1.0 : -1.0, is_left(leg) ? 1.0 : -1.0, 1.0);
      const Vec3 foot = model.foot_in_base(leg, leg_angles(posture, leg));
      EXPECT_LT((foot - mirror.cwiseProduct(exact)).norm(), kTolerance);
    }
  }
}

TEST(AnymalB, has_the_published_centre_of_mass_and_inertia_when_it_stands) {
  RobotModel model(anymal_b());
  RobotState state = test::straight_legged_state();
  state.q = model.description().q_nominal;
  state.p_WB.setZero();
  const Dynamics& dynamics = model.update(state, Vec3::UnitZ());
  // All bodies as one, its inertia about the base's origin turned into one about the centre of
  // mass.
  const auto shift = [](const Vec3& r) -> Mat3 {
    return r.squaredNorm() * Mat3::Identity() - r * r.transpose();
  };
  const Vec3 com = dynamics.com.p;
  const Mat3 about_base = dynamics.M.block<3, 3>(3, 3);
  Inertia whole{dynamics.mass, com, about_base - dynamics.mass * shift(com)};
  whole = whole + Inertia{-kImuMass, kImuPosition, Mat3::Zero()};
  for (const Leg leg : kLegs) {
    const Vec3 foot = dynamics.foot[index(leg)].p;
    whole = whole + Inertia{-kFootMass, foot, Mat3::Zero()};
  }
  EXPECT_NEAR(whole.mass, 30.4214, 5e-5);
  EXPECT_LT((whole.com - Vec3(-0.0011, -0.0008, -0.0281)).cwiseAbs().maxCoeff(), 6e-5);
  EXPECT_LT((whole.about_com.diagonal() - Vec3(1.137, 2.362, 2.354)).cwiseAbs().maxCoeff(), 6e-4);
}

}  // namespace
}  // namespace surefoot::model
