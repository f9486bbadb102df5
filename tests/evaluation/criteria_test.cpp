#include "surefoot/evaluation/criteria.hpp"

#include "surefoot/base/error.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace surefoot::evaluation {
namespace {

using nlohmann::json;
using test::holds;
using test::message_of;

Criterion limit(const std::string& metric, std::optional<double> min, std::optional<double> max) {
  return {.metric = metric, .min = min, .max = max, .equals = {}};
}
Criterion must_be(const std::string& metric, bool truth) {
  return {.metric = metric, .min = {}, .max = {}, .equals = truth};
}

Metrics some_metrics() {
  Metrics metrics;
  metrics.com_error_max_m = 0.0004;
  metrics.speed_mps = 0.1;
  metrics.steps_taken = 12;
  metrics.tick_us = {.median = 200.0, .p99 = 400.0, .max = 900.0};
  return metrics;
}

bool passes(const Criterion& criterion) {
  return evaluate({criterion}, some_metrics()).at(0).passed;
}

TEST(Criteria, LimitsAreInclusive) {
  EXPECT_TRUE(passes(limit("com_error_max_m", {}, 0.0004)));
  EXPECT_FALSE(passes(limit("com_error_max_m", {}, 0.00039)));
  EXPECT_TRUE(passes(limit("speed_mps", 0.1, {})));
  EXPECT_FALSE(passes(limit("speed_mps", 0.11, {})));
  EXPECT_TRUE(passes(limit("steps_taken", 12, 12)));
  EXPECT_FALSE(passes(limit("steps_taken", 13, 20)));
  EXPECT_FALSE(passes(limit("steps_taken", 1, 11)));
}

TEST(Criteria, TruthsAndMembersOfDistributionsCanBeJudged) {
  EXPECT_TRUE(passes(must_be("fell", false)));
  EXPECT_FALSE(passes(must_be("fell", true)));
  EXPECT_TRUE(passes(limit("tick_us.p99", {}, 400.0)));
  EXPECT_FALSE(passes(limit("tick_us.max", {}, 400.0)));
}

TEST(Criteria, WhatWasNotMeasuredNeverPasses) {
  EXPECT_FALSE(passes(limit("limb_extension_max_m", {}, 10.0)));
  EXPECT_FALSE(passes(limit("limb_extension_max_m", -10.0, {})));
}

TEST(Criteria, AGoalThatThereIsNotIsNeitherReachedNorMissed) {
  EXPECT_FALSE(passes(must_be("goal_reached", true)));
  EXPECT_FALSE(passes(must_be("goal_reached", false)));
  EXPECT_TRUE(json::parse(to_json(some_metrics())).at("goal_reached").is_null());
  Metrics metrics = some_metrics();
  metrics.goal_reached = true;
  EXPECT_TRUE(evaluate({must_be("goal_reached", true)}, metrics).at(0).passed);
}

TEST(Criteria, AnUnknownMetricIsNamedWithThoseThatExist) {
  for (const char* name : {"com_error", "tick_us", "succeeded", "reason", ""}) {
    const std::string message = message_of([&] { check(limit(name, {}, 1.0)); });
    EXPECT_TRUE(holds(message, "\"" + std::string(name) + "\""));
    EXPECT_TRUE(holds(message, "com_error_max_m"));
    EXPECT_TRUE(holds(message, "tick_us.p99"));
  }
}

TEST(Criteria, ALimitOfTheWrongKindIsRefused) {
  EXPECT_THROW(check(limit("fell", {}, 0.0)), Error);
  EXPECT_THROW(check(must_be("speed_mps", true)), Error);
  EXPECT_THROW(check(limit("speed_mps", {}, {})), Error);
  EXPECT_NO_THROW(check(must_be("fell", false)));
}

TEST(Criteria, AllMustPass) {
  const auto results = evaluate(
      {limit("com_error_max_m", {}, 0.0005), must_be("fell", false), limit("steps_taken", 1, 20)},
      some_metrics());
  EXPECT_TRUE(all_passed(results));
}

TEST(Criteria, OneMissedIsEnough) {
  EXPECT_FALSE(
      all_passed(evaluate({must_be("fell", false), limit("speed_mps", 1.0, {})}, some_metrics())));
}

TEST(Metrics, EveryNameOfTheProgramsOutputIsThere) {
  const json metrics = json::parse(to_json(some_metrics()));
  for (const char* name : {"succeeded",
                           "fell",
                           "duration_s",
                           "distance_m",
                           "speed_mps",
                           "com_error_max_m",
                           "com_error_rms_m",
                           "edge_landings",
                           "base_height_error_rms_m",
                           "orientation_error_rms_rad",
                           "torque_max_nm",
                           "torque_step_max_nm",
                           "friction_margin_min",
                           "foot_slip_max_m",
                           "limb_extension_max_m",
                           "penetration_max_m",
                           "tick_us",
                           "solve_us",
                           "realtime_factor",
                           "seed",
                           "version"}) {
    EXPECT_TRUE(metrics.contains(name)) << name;
  }
  EXPECT_EQ(metrics.at("tick_us"), json({{"median", 200.0}, {"p99", 400.0}, {"max", 900.0}}));
  EXPECT_TRUE(metrics.at("limb_extension_max_m").is_null());
}

TEST(Metrics, TheSummaryHoldsMetricsAndCriteria) {
  const Metrics metrics = some_metrics();
  const json summary =
      json::parse(summary_json(metrics, evaluate({limit("speed_mps", 0.2, {})}, metrics)));
  EXPECT_EQ(summary.at("metrics").at("steps_taken"), 12);
  EXPECT_EQ(summary.at("criteria"),
            json::parse(R"([{"metric":"speed_mps","min":0.2,"value":0.1,"passed":false}])"));
}

}  // namespace
}  // namespace surefoot::evaluation
