#include "server/view_channels.hpp"

#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/signals/joint_name.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace surefoot::server {
namespace {

using test::holds;

const ViewChannel& channel(const ViewChannels& table, const std::string& name) {
  const auto found = std::ranges::find(table.channels, name, &ViewChannel::name);
  EXPECT_NE(found, table.channels.end()) << name;
  return *found;
}

ViewChannels table_of_plan() {
  ViewChannels table;
  logged::ChannelLister(table).add("plan", MotionPlan());
  return table;
}

TEST(ViewChannels, a_field_has_the_logs_name_unit_and_description) {
  const ViewChannels table = table_of_plan();
  const ViewChannel& height = channel(table, "plan.torso.height");
  EXPECT_EQ(height.unit, "m");
  EXPECT_EQ(height.about, "desired z of the base in W");
  EXPECT_EQ(height.size, 1u);
  const ViewChannel& foot = channel(table, "plan.feet.LH.p_WF");
  EXPECT_EQ(foot.labels, (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(channel(table, "plan.torso.q_WB").labels,
            (std::vector<std::string>{"w", "x", "y", "z"}));
  EXPECT_EQ(channel(table, "plan.feet.RF.phase").values.at(2), "swing");
  EXPECT_EQ(channel(table, "plan.R_WC").labels.at(5), "23") << "row by row";
  EXPECT_EQ(std::ranges::find(table.channels, "plan.time", &ViewChannel::name),
            table.channels.end())
      << "it is the frame's";
}

TEST(ViewChannels, a_list_whose_numbers_have_several_units_has_none_and_says_which_they_are) {
  simulation::GroundTruth truth;
  truth.qvel.resize(18);
  truth.ctrl.resize(kNumLegJoints);
  ViewChannels table;
  logged::ChannelLister(table).add("truth", truth);
  EXPECT_EQ(channel(table, "truth.qvel").unit, "");
  EXPECT_TRUE(holds(channel(table, "truth.qvel").about, "[m/s, m/s, m/s, rad/s, …]"));
  EXPECT_EQ(channel(table, "truth.ctrl").unit, "N·m");
}

TEST(ViewChannels, six_legs_have_theirs) {
  MotionPlan plan;
  plan.feet.resize(kMaxLegs);
  plan.feet[index(Leg{3})].friction = 0.25;
  ViewChannels table;
  table.num_legs = kMaxLegs;
  logged::ChannelLister(table).add("plan", plan);
  constexpr float kUnwritten = 1234.5F;
  std::vector<float> floats(table.floats, kUnwritten);
  logged::ChannelWriter(table, floats).add(plan);
  EXPECT_EQ(floats.at(channel(table, "plan.feet.RM.friction").offset), 0.25F);
  EXPECT_EQ(std::ranges::count(floats, kUnwritten), 0);
}

TEST(ViewChannels, channels_lie_one_behind_the_other) {
  const ViewChannels table = table_of_plan();
  std::size_t next = 0;
  for (const ViewChannel& entry : table.channels) {
    EXPECT_EQ(entry.offset, next) << entry.name;
    next += entry.size;
  }
  EXPECT_EQ(table.floats, next);
}

TEST(ViewChannels, the_floats_of_a_signal_stand_where_its_channels_say) {
  const ViewChannels table = table_of_plan();
  MotionPlan plan;
  plan.feet[2].p_WF = Vec3(1.0, 2.0, 3.0);
  plan.feet[1].phase = LegPhase::search;
  plan.torso.q_WB = Quat(0.5, -0.5, 0.25, 0.75);
  plan.R_WC(1, 2) = 7.0;
  plan.com_zmp_slack = kNaN;
  plan.arm.arm = 2;
  constexpr float kUnwritten = 1234.5F;
  std::vector<float> floats(table.floats, kUnwritten);
  logged::ChannelWriter(table, floats).add(plan);
  const auto at = [&](const std::string& name, std::size_t place) {
    return floats[channel(table, name).offset + place];
  };
  EXPECT_EQ(at("plan.feet.LH.p_WF", 1), 2.0F);
  EXPECT_EQ(at("plan.feet.RF.phase", 0), 3.0F);
  EXPECT_EQ(at("plan.torso.q_WB", 0), 0.5F);
  EXPECT_EQ(at("plan.torso.q_WB", 3), 0.75F);
  EXPECT_EQ(at("plan.R_WC", 5), 7.0F);
  EXPECT_TRUE(std::isnan(at("plan.com_zmp_slack", 0)));
  EXPECT_TRUE(std::isnan(at("plan.joints", kNumLegJoints - 1))) << "this plan has none";
  EXPECT_EQ(std::ranges::count(floats, kUnwritten), 0) << "all are written";
}

TEST(ViewChannels, joints_have_their_names_and_other_long_lists_numbers) {
  simulation::GroundTruth truth;
  truth.qvel.resize(20);
  truth.ctrl.resize(14);
  ViewChannels table;
  table.joint_names = told_joints(std::vector<std::string>(14, "shoulder"), kNumLegs);
  table.joint_names.back() = "wrist";
  logged::ChannelLister(table).add("truth", truth);
  EXPECT_EQ(channel(table, "truth.ctrl").labels.at(2), "LF_KFE");
  EXPECT_EQ(channel(table, "truth.ctrl").labels.at(13), "wrist");
  EXPECT_EQ(channel(table, "truth.qvel").labels.at(13), "13");
}

TEST(ViewChannels, levels_have_their_channels_by_name_whatever_their_order) {
  ViewChannels table;
  table.level_names = {"first", "second", "third"};
  logged::ChannelLister(table).add("hierarchy", logged::Hierarchy());
  logged::Hierarchy hierarchy;
  hierarchy.levels = {{.name = "second", .report = {.residual = 2.0}},
                      {.name = "first", .report = {.residual = 1.0}}};
  std::vector<float> floats(table.floats);
  logged::ChannelWriter(table, floats).add(hierarchy);
  const auto residual = [&](const std::string& level) {
    return floats[channel(table, "hierarchy.level." + level + ".residual").offset];
  };
  EXPECT_EQ(residual("first"), 1.0F);
  EXPECT_EQ(residual("second"), 2.0F);
  EXPECT_TRUE(std::isnan(residual("third"))) << "it was not there";
}

TEST(ViewChannels, the_page_can_read_what_they_are) {
  const nlohmann::json list = nlohmann::json::parse(to_json(table_of_plan().channels));
  EXPECT_EQ(list.at(0).at("name"), "plan.feet.LF.phase");
  EXPECT_EQ(list.at(0).at("values").at(0), "stance");
  EXPECT_EQ(list.at(1).at("offset"), 1);
}

}  // namespace
}  // namespace surefoot::server
