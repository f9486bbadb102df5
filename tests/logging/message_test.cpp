#include "surefoot/logging/message_decoder.hpp"
#include "tests/logging/synthetic_run.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

namespace surefoot::logging {
namespace {

using nlohmann::json;

template <typename T>
json encoded(const T& signal) {
  std::string text;
  logged::encode(signal, text);
  return json::parse(text);
}

// True if the instance is what the schema says; knows the words that our schemas use.
bool conforms(const json& schema, const json& instance);

bool has_type(const json& type, const json& instance) {
  if (type.is_array()) {
    return std::any_of(type.begin(), type.end(),
                       [&](const json& one) { return has_type(one, instance); });
  }
  const auto name = type.get<std::string>();
  return (name == "object" && instance.is_object()) || (name == "array" && instance.is_array()) ||
         (name == "number" && instance.is_number()) ||
         (name == "integer" && instance.is_number_integer()) ||
         (name == "string" && instance.is_string()) ||
         (name == "boolean" && instance.is_boolean()) || (name == "null" && instance.is_null());
}

bool conforms(const json& schema, const json& instance) {
  if (!has_type(schema.at("type"), instance)) return false;
  if (schema.contains("enum")) {
    const json& all = schema.at("enum");
    if (std::find(all.begin(), all.end(), instance) == all.end()) return false;
  }
  if (schema.contains("minItems") && instance.size() < schema.at("minItems").get<std::size_t>())
    return false;
  if (schema.contains("maxItems") && instance.size() > schema.at("maxItems").get<std::size_t>())
    return false;
  if (instance.is_array()) {
    return std::all_of(instance.begin(), instance.end(),
                       [&](const json& element) { return conforms(schema.at("items"), element); });
  }
  if (instance.is_object()) {
    if (schema.at("properties").size() != instance.size()) return false;
    for (const auto& [name, value] : instance.items()) {
      if (!schema.at("properties").contains(name) ||
          !conforms(schema.at("properties").at(name), value))
        return false;
    }
  }
  return true;
}

template <typename T>
void expect_conforming(const T& signal) {
  const json schema = json::parse(logged::schema<T>("title"));
  const json message = encoded(signal);
  EXPECT_TRUE(conforms(schema, message)) << schema.dump() << "\n" << message.dump();
  EXPECT_FALSE(conforms(schema, json::object({{"other", 1}})));
}

TEST(Messages, EveryMessageIsWhatItsSchemaSays) {
  test::SyntheticRun run;
  for (int i = 0; i < 800; ++i) run.step();
  expect_conforming(run.tick.reading);
  expect_conforming(run.tick.health);
  expect_conforming(run.tick.user);
  expect_conforming(run.tick.state);
  expect_conforming(run.tick.plan);
  expect_conforming(run.tick.model);
  expect_conforming(run.tick.command);
  expect_conforming(run.timing);
  expect_conforming(logged::Hierarchy{.status = 0,
                                      .levels = {{"COM", LevelStatus::missed, {}}},
                                      .active = {{"COM", "row", 3, -3, -0.25}},
                                      .missed = {{"COM", "x", 0, 0.5}},
                                      .blocked_by = {{"COM", "limits", "row", {}}},
                                      .level_switches = {{{"COM"}, {"yaw", "height"}, 0.5}}});
}

TEST(Messages, UnmeasuredValuesAreNull) {
  const json message = encoded(SensorReading());
  EXPECT_TRUE(message.at("time").is_null());
  EXPECT_TRUE(message.at("foot_force").at("LF").is_null());
}

TEST(Messages, PhasesAndModesAreWords) {
  MotionPlan plan;
  plan.feet[index(Leg::RH)].phase = LegPhase::search;
  EXPECT_EQ(encoded(plan).at("feet").at("RH").at("phase"), "search");
  JointCommand command;
  command.mode = CommandMode::damping;
  command.cause = StopCause::imu;
  EXPECT_EQ(encoded(command).at("mode"), "damping");
  EXPECT_EQ(encoded(command).at("cause"), "imu");
  EXPECT_EQ(encoded(GroupHealth{.fault = SampleFault::repeats}).at("fault"), "repeats");
  EXPECT_EQ(encoded(logged::Level{"COM", LevelStatus::cut_off, {}}).at("status"), "cut off");
}

TEST(Messages, AQuaternionBeginsWithItsScalarAndAMatrixGoesRowByRow) {
  TorsoPlan torso;
  torso.q_WB = Quat(0.1, 0.2, 0.3, 0.4);
  EXPECT_EQ(encoded(torso).at("q_WB"), json({0.1, 0.2, 0.3, 0.4}));
  MotionPlan plan;
  plan.R_WC << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  EXPECT_EQ(encoded(plan).at("R_WC"), json::parse("[[1,2,3],[4,5,6],[7,8,9]]"));
}

TEST(Messages, TheOrderOfMembersDoesNotMatter) {
  UserCommand user;
  logged::Decoder::decode(R"({"height":0.5, "yaw_rate":2, "velocity":[3,4], "walk":true})", user);
  EXPECT_EQ(user.height, 0.5);
  EXPECT_EQ(user.yaw_rate, 2.0);
  EXPECT_EQ(user.velocity, Vec2(3.0, 4.0));
  EXPECT_TRUE(user.walk);
}

TEST(Messages, MembersOfLaterVersionsArePassedOverAndMissingOnesKeepTheirValue) {
  UserCommand user{.walk = true, .velocity = Vec2(1.0, 2.0), .yaw_rate = 3.0, .height = 4.0};
  logged::Decoder::decode(
      R"({"new":{"a":[1,{}]},"walk":false,"newer":"}","height":7,"newest":null})", user);
  EXPECT_FALSE(user.walk);
  EXPECT_EQ(user.velocity, Vec2(1.0, 2.0));
  EXPECT_EQ(user.yaw_rate, 3.0);
  EXPECT_EQ(user.height, 7.0);
}

TEST(Messages, EventsKeepTheirOrderLegPlaceAndForce) {
  MotionPlan plan;
  plan.events.add(
      {.kind = PlanEvent::touchdown, .leg = Leg::RF, .place = Vec3(1.0, 2.0, 3.0), .force = 40.0});
  plan.events.add({.kind = PlanEvent::slowed});
  std::string text;
  logged::encode(plan, text);
  EXPECT_TRUE(json::parse(text).at("events").at(1).at("leg").is_null());
  MotionPlan read;
  read.events.add({.kind = PlanEvent::late});
  logged::Decoder::decode(text, read);
  ASSERT_EQ(read.events.count, 2u);
  const GaitEvent &first = read.events.items[0], &second = read.events.items[1];
  EXPECT_EQ(first.kind, PlanEvent::touchdown);
  EXPECT_EQ(first.leg, Leg::RF);
  EXPECT_EQ(first.place, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(first.force, 40.0);
  EXPECT_EQ(second.kind, PlanEvent::slowed);
  EXPECT_EQ(second.leg, std::nullopt);
  EXPECT_TRUE(std::isnan(second.force));
}

TEST(Messages, ThoseOfSixLegsNameThemInMessageAndSchema) {
  MotionPlan plan;
  plan.feet.resize(kMaxLegs);
  plan.feet[index(Leg{2})].friction = 0.25;
  plan.events.add({.kind = PlanEvent::touchdown, .leg = Leg{4}});
  const json message = encoded(plan);
  EXPECT_EQ(message.at("feet").at("LM").at("friction"), 0.25);
  EXPECT_EQ(message.at("events").at(0).at("leg"), "LH");
  EXPECT_TRUE(conforms(json::parse(logged::schema<MotionPlan>("plan", "", kMaxLegs)), message));
  MotionPlan read;
  logged::Decoder::decode(message.dump(), read, kMaxLegs);
  EXPECT_EQ(read.feet.size(), 6u);
  EXPECT_EQ(encoded(read), message);
}

TEST(Messages, TheOneEventOfAnOlderLogIsReadWithoutItsLeg) {
  MotionPlan plan;
  logged::Decoder::decode(R"({"time":1.5,"com_zmp_slack":0,"event":5})", plan);
  ASSERT_EQ(plan.events.count, 1u);
  EXPECT_EQ(plan.events.items[0].kind, PlanEvent::late);
  EXPECT_EQ(plan.events.items[0].leg, std::nullopt);
  logged::Decoder::decode(R"({"time":1.75,"com_zmp_slack":0,"event":0})", plan);
  EXPECT_TRUE(plan.events.empty());
  EXPECT_THROW(logged::Decoder::decode(R"({"events":[{"event":1,"leg":"XX"}]})", plan), JsonError);
}

TEST(Messages, WhatIsNotAMessageIsAnError) {
  for (const char* text :
       {"", "7", "[1]", "{", R"({"walk":1})", R"({"velocity":[1]})", R"({"velocity":[1,2,3]})",
        R"({"height":"tall"})", R"({"height":1)", R"({"height" 1})"}) {
    UserCommand user;
    EXPECT_THROW(logged::Decoder::decode(text, user), JsonError) << text;
  }
  JointCommand command;
  EXPECT_THROW(logged::Decoder::decode(R"({"mode":"reckless"})", command), JsonError);
}

}  // namespace
}  // namespace surefoot::logging
