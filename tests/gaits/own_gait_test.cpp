// A gait of the user's own within the library's planner, used beside the others.
#include "surefoot/base/error.hpp"
#include "surefoot/gaits/own_gaits.hpp"
#include "tests/gaits/puppet.hpp"
#include "tests/gaits/some_gaits.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace surefoot::gaits {
namespace {

constexpr double kSway = 0.02;  // to each side [m]
constexpr int kTrot = 0, kOwn = 1;

/// All feet stay, and the centre of mass sways to the sides, as long as the user walks.
class Sway final : public Gait {
 public:
  explicit Sway(int& restarts) : restarts_(restarts) {}

  void restart() override { ++restarts_; }
  void begin(Situation& now, Body&, const std::optional<Action>&) override {
    begin_ = now.time;
    centre_ = now.before.com.p;
  }
  [[nodiscard]] bool waits(const Body&) const override { return true; }
  [[nodiscard]] ComPlan com(const Situation& now, const Body&) const override {
    const double phase = 2.0 * (now.time - begin_);
    const double bend = 1.0 - std::cos(phase);
    const Vec2 at = centre_ + Vec2(0.0, kSway * bend);
    return {.p = at,
            .v = Vec2(0.0, 2.0 * kSway * std::sin(phase)),
            .a = Vec2(0.0, 4.0 * kSway * std::cos(phase)),
            .zmp = at};
  }

 private:
  void plan_com(const Situation&, Body&) override {}
  GaitOutcome go_on(Situation& now, Body&) override {
    return {.hands_over = !now.user.walk || now.yields};
  }

  int& restarts_;
  double begin_ = 0.0;
  Vec2 centre_{0.0, 0.0};
};

struct Bench {
  std::vector<NamedGait> gaits() {
    const auto make = [this](const PlannerOptions& given, double, const Scale&) {
      was_given = given;
      return std::make_unique<Sway>(restarts);
    };
    return {{"trot", test::kTrot}, {"sway", {}, make}};
  }
  int restarts = 0;
  PlannerOptions was_given;
};

TEST(OwnGait, IsChangedToAndFromLikeTheLibrarys) {
  Bench bench;
  test::Puppet puppet(test::kTrot, test::level_ground(), Vec2::Zero(), 0.0, bench.gaits(), kTrot);
  puppet.user = {.walk = true, .velocity = {0.2, 0.0}, .gait = kTrot};
  puppet.run(4.0);
  ASSERT_EQ(puppet.plan().gait, kTrot);
  const double after_trot = puppet.com().x();
  EXPECT_GT(after_trot, 0.2);
  puppet.user.gait = kOwn;
  puppet.run(2.0);
  ASSERT_EQ(puppet.plan().gait, kOwn);
  const Vec2 here = puppet.com();
  const int steps = puppet.planner().steps_taken();
  double farthest = 0.0;
  puppet.run(4.0, [&] {
    EXPECT_EQ(puppet.plan().num_contacts(), kNumLegs);
    farthest = std::max(farthest, std::abs(puppet.com().y() - here.y()));
  });
  EXPECT_EQ(puppet.planner().steps_taken(), steps);
  EXPECT_GT(farthest, kSway);
  EXPECT_NEAR(puppet.com().x(), here.x(), 1e-9);
  puppet.user.gait = kTrot;
  puppet.run(4.0);
  EXPECT_EQ(puppet.plan().gait, kTrot);
  EXPECT_GT(puppet.planner().steps_taken(), steps) << "the library's goes on";
}

TEST(OwnGait, IsMadeOfItsOptionsAndRestartedWithThePlanner) {
  Bench bench;
  std::vector<NamedGait> gaits = bench.gaits();
  gaits[kOwn].options.stance.height = 0.4;
  const Planner fresh(test::kTrot, test::Puppet::kPeriod, {}, gaits, kOwn);
  EXPECT_EQ(bench.was_given.stance.height, 0.4);
  Planner planner = fresh;
  const test::MallocCounter mallocs;
  planner.begin_anew(fresh);
  EXPECT_EQ(mallocs.count(), 0u);
  EXPECT_EQ(bench.restarts, 1);
}

class Failing final : public Gait {
 public:
  void begin(Situation&, Body&, const std::optional<Action>&) override {}
  [[nodiscard]] bool waits(const Body&) const override { return true; }

 private:
  void plan_com(const Situation&, Body&) override {}
  GaitOutcome go_on(Situation&, Body&) override { throw std::runtime_error("no idea"); }
};

TEST(OwnGait, IsNamedWhereItThrows) {
  const auto make = [](const PlannerOptions&, double, const Scale&) {
    return std::make_unique<Failing>();
  };
  test::Puppet puppet(test::kTrot, test::level_ground(), Vec2::Zero(), 0.0,
                      {{"failing", test::kTrot, make}}, 0);
  puppet.user = {.walk = true, .gait = 0};
  EXPECT_EQ(test::message_of([&] { puppet.run(1.0); }), "gait \"failing\": no idea");
}

TEST(OwnGaits, RefuseWhatCanBeNoGait) {
  const GaitFactory none_made = [](const PlannerOptions&, double, const Scale&) {
    return std::unique_ptr<Gait>();
  };
  OwnGaits own;
  own.add("mine", none_made);
  EXPECT_TRUE(test::holds(test::message_of([&] { own.add("mine", none_made); }),
                          "there is a gait \"mine\" already"));
  EXPECT_TRUE(test::holds(test::message_of([&] { own.add("other", nullptr); }),
                          "gait \"other\" needs a factory"));
  EXPECT_TRUE(test::holds(test::message_of([&] { own.add("auto", none_made); }),
                          "\"auto\" is no name for a gait of your own"));
  EXPECT_TRUE(test::holds(test::message_of([&] {
                            (void)Planner({}, 0.0025, {}, {{"mine", {}, *own.find("mine")}}, 0);
                          }),
                          "gait \"mine\": its factory gave no gait"));
}

}  // namespace
}  // namespace surefoot::gaits
