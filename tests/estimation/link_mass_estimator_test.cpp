#include "surefoot/estimation/link_mass_estimator.hpp"

#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;
constexpr int kSwing = 180;  // ticks
constexpr PerLeg<bool> kStanding{true, true, true, true};
/// For links and torques without other errors.
constexpr LinkMassOptions kClear{.noise = 1e-3};
using Shares = LinkMassEstimator::Shares;

/// A robot whose base moves and turns while a leg, the links of which are heavier than modelled,
/// swings.
struct Bench {
  explicit Bench(const LinkMassOptions& options = kClear, Leg swinging = Leg::LF)
      : leg(swinging), model(test::anymal_b()), estimator(options, kPeriod) {}

  [[nodiscard]] RobotState state(double t) const {
    RobotState result;
    result.time = t;
    result.p_WB = Vec3(4.0 + 0.2 * t, -3.0 + 0.03 * std::sin(4.0 * t), 0.5);
    result.v_WB = Vec3(0.2, 0.12 * std::cos(4.0 * t), 0.0);
    result.q_WB = Quat(Eigen::AngleAxisd(0.1 * std::sin(3.0 * t), Vec3::UnitX()));
    result.w_WB_B = Vec3(0.3 * std::cos(3.0 * t), 0.0, 0.0);
    result.q = model.description().q_nominal;
    result.qd.setZero();
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const double speed = 7.0 + 2.0 * j;
      result.q[first_joint(leg) + j] += 0.3 * std::sin(speed * t + j);
      result.qd[first_joint(leg) + j] = 0.3 * speed * std::cos(speed * t + j);
    }
    return result;
  }

  const model::Dynamics& dynamics(double t) { return model.update(state(t), Vec3::UnitZ()); }

  /// The leg's torques at t, of links that are heavier.
  Vec3 torque(double t) {
    constexpr double kStep = 1e-5;
    const std::size_t k = index(leg);
    const Vec3 scale = Vec3::Ones() + heavier.segment<kJointsPerLeg>(first_joint(leg));
    const Vec3 after = dynamics(t + kStep).links[k].momentum * scale;
    const Vec3 before = dynamics(t - kStep).links[k].momentum * scale;
    return (after - before) / (2.0 * kStep) - dynamics(t).links[k].free_rate * scale;
  }

  void tick(const PerLeg<bool>& stands, const Vec3& extra = Vec3::Zero()) {
    time += kPeriod;
    JointVector measured = JointVector::Zero(kNumLegJoints);
    measured.segment<kJointsPerLeg>(first_joint(leg)) = torque(time) + extra;
    estimator.update(time, dynamics(time - delay), stands, measured);
  }

  [[nodiscard]] PerLeg<bool> swinging() const {
    PerLeg<bool> stands = kStanding;
    stands[index(leg)] = false;
    return stands;
  }

  void swing(int ticks = kSwing, const Vec3& extra = Vec3::Zero(), int missed = 0) {
    for (int t = 0; t < ticks; ++t) {
      if (t == 60) time += missed * kPeriod;
      tick(swinging(), extra);
    }
    for (int t = 0; t < 37; ++t) tick(kStanding);
  }

  Leg leg;
  model::RobotModel model;
  LinkMassEstimator estimator;
  Shares heavier = Shares::Zero(kNumLegJoints);
  double delay = 0.0;  // of angles [s]
  double time = 0.0;
};

TEST(LinkMassEstimator, FindsWhatEachLinkOfASwingingLegWeighs) {
  for (const Leg leg : kLegs) {
    Bench bench(kClear, leg);
    bench.heavier.segment<3>(first_joint(leg)) << 0.12, -0.08, 0.1;
    for (int i = 0; i < 4; ++i) bench.swing();
    EXPECT_LT((bench.estimator.shares() - bench.heavier).cwiseAbs().maxCoeff(), 0.01)
        << bench.estimator.shares().transpose();
    EXPECT_LT(std::abs(bench.estimator.delay()), 1e-4);
  }
}

TEST(LinkMassEstimator, TellsAnglesThatComeLateFromMasses) {
  Bench bench;
  bench.heavier.head<3>() << -0.05, 0.1, -0.12;
  bench.delay = kPeriod;
  for (int i = 0; i < 4; ++i) bench.swing();
  EXPECT_NEAR(bench.estimator.delay(), kPeriod, 1e-4);
  EXPECT_LT((bench.estimator.shares() - bench.heavier).cwiseAbs().maxCoeff(), 0.02)
      << bench.estimator.shares().transpose();
}

// A mean torque that is small against usual mass errors has little effect.
TEST(LinkMassEstimator, BelievesASingleNoisySwingLittle) {
  Bench bench({.noise = 10.0, .most_sigmas = 100.0});
  bench.heavier.head<3>() << 0.1, 0.1, 0.1;
  bench.tick(kStanding);
  bench.swing();
  EXPECT_LT(bench.estimator.shares().cwiseAbs().maxCoeff(), 0.01);
  EXPECT_GT(bench.estimator.shares().cwiseAbs().maxCoeff(), 0.0);
}

// Swings of the walks are planned to last 0.35 s, and end a little earlier.
TEST(LinkMassEstimator, LearnsNothingFromALegThatIsHeldOrComesDownOrIsNotKnown) {
  const LinkMassOptions usual;
  const int whole =
      static_cast<int>(std::lround((usual.begin + usual.duration + usual.wait) / kPeriod));
  EXPECT_LT(whole * kPeriod, 0.31);
  struct Case {
    const char* what;
    int ticks;
    Vec3 extra;
    int missed;
    bool is_learnt;
  };
  const Case cases[] = {{"free", kSwing, Vec3::Zero(), 0, true},
                        {"just long enough", whole, Vec3::Zero(), 0, true},
                        {"touches just after the window", whole - 1, Vec3::Zero(), 0, false},
                        {"held", kSwing, Vec3(0.0, 3.0, 0.0), 0, false},
                        {"no torque is known", kSwing, Vec3(0.0, kNaN, 0.0), 0, false},
                        {"a tick is missed", kSwing, Vec3::Zero(), 1, false},
                        {"many are", kSwing, Vec3::Zero(), 20, false}};
  for (const Case& one : cases) {
    Bench bench(usual);
    bench.heavier.head<3>() << 0.1, -0.1, 0.1;
    bench.tick(kStanding);
    bench.swing(one.ticks, one.extra, one.missed);
    EXPECT_EQ(!bench.estimator.shares().isZero(), one.is_learnt) << one.what;
    EXPECT_TRUE(bench.estimator.shares().allFinite()) << one.what;
    bench.swing();
    EXPECT_FALSE(bench.estimator.shares().isZero()) << "the next swing counts, after: " << one.what;
  }
}

TEST(LinkMassEstimator, BelievesNoShareBeyondAHalf) {
  Bench bench;
  bench.heavier.head<3>() << 0.0, 2.0, 0.0;
  LinkMassOptions trusting = kClear;
  trusting.most_sigmas = 1e9;
  bench.estimator = LinkMassEstimator(trusting, kPeriod);
  for (int i = 0; i < 4; ++i) bench.swing();
  EXPECT_EQ(bench.estimator.shares().maxCoeff(), 0.5);
}

TEST(LinkMassEstimator, LearnsNothingWhereItIsSwitchedOff) {
  Bench bench({.enabled = false});
  bench.heavier.setConstant(0.1);
  bench.swing();
  EXPECT_TRUE(bench.estimator.shares().isZero());
}

TEST(LinkMassEstimator, DoesNotAllocate) {
  Bench bench({.most_sigmas = 1e9});
  const model::Dynamics dynamics = bench.dynamics(0.0);
  const PerLeg<bool> swinging = bench.swinging();
  const test::MallocCounter counter;
  for (int t = 0; t < kSwing; ++t) {
    bench.estimator.update(t * kPeriod, dynamics, swinging, JointVector::Ones(kNumLegJoints));
  }
  EXPECT_EQ(counter.count(), 0u);
  EXPECT_TRUE(bench.estimator.shares().isZero()) << "its first tick follows no other";
  for (int t = 0; t < 2; ++t) {
    bench.estimator.update((kSwing + t) * kPeriod, dynamics, kStanding,
                           JointVector::Ones(kNumLegJoints));
  }
  for (int t = 2; t < kSwing; ++t) {
    bench.estimator.update((kSwing + t) * kPeriod, dynamics, swinging,
                           JointVector::Ones(kNumLegJoints));
  }
  EXPECT_EQ(counter.count(), 0u);
  EXPECT_FALSE(bench.estimator.shares().isZero());
}

}  // namespace
}  // namespace surefoot::estimation
