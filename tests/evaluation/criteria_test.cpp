#include "surefoot/evaluation/criteria.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/evaluation/metric_table.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

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
  return evaluate({criterion}, some_metrics(), Extent::whole).at(0).passed.value();
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
  EXPECT_TRUE(
      evaluate({must_be("goal_reached", true)}, metrics, Extent::whole).at(0).passed.value());
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
      some_metrics(), Extent::whole);
  EXPECT_EQ(all_passed(results), true);
}

TEST(Criteria, OneMissedIsEnough) {
  EXPECT_EQ(all_passed(evaluate({must_be("fell", false), limit("speed_mps", 1.0, {})},
                                some_metrics(), Extent::whole)),
            false);
}

/// Of a run that was too short for the criterion.
std::optional<bool> judged_early(const Criterion& criterion, const Metrics& metrics) {
  return evaluate({criterion}, metrics, Extent::part).at(0).passed;
}

TEST(Criteria, OfAPartOfARunOnlyThatIsJudgedWhichTheRestCouldNotChange) {
  Metrics metrics = some_metrics();
  metrics.goal_reached = false;
  metrics.friction_margin_min = 0.1;
  EXPECT_EQ(judged_early(must_be("goal_reached", true), metrics), std::nullopt);
  EXPECT_EQ(judged_early(must_be("fell", false), metrics), std::nullopt);
  EXPECT_EQ(judged_early(limit("speed_mps", 0.2, {}), metrics), std::nullopt);
  EXPECT_EQ(judged_early(limit("com_error_max_m", {}, 0.1), metrics), std::nullopt);
  EXPECT_EQ(judged_early(limit("limb_extension_max_m", {}, 0.1), metrics), std::nullopt);
  EXPECT_EQ(judged_early(limit("com_error_max_m", {}, 0.0001), metrics), false);
  EXPECT_EQ(judged_early(limit("friction_margin_min", 0.2, {}), metrics), false);
  EXPECT_EQ(judged_early(limit("friction_margin_min", 0.05, {}), metrics), std::nullopt);
  EXPECT_EQ(judged_early(limit("steps_taken", 12, {}), metrics), true);
  EXPECT_EQ(judged_early(limit("steps_taken", 12, 20), metrics), std::nullopt);
  metrics.goal_reached = metrics.fell = true;
  EXPECT_EQ(judged_early(must_be("goal_reached", true), metrics), true);
  EXPECT_EQ(judged_early(must_be("fell", false), metrics), false);
}

TEST(Criteria, WhatIsMissedCountsMoreThanWhatIsNotJudged) {
  const auto of = [](const std::vector<Criterion>& criteria) {
    return all_passed(evaluate(criteria, some_metrics(), Extent::part));
  };
  const Criterion open = must_be("fell", false), held = limit("steps_taken", 1, {});
  EXPECT_EQ(of({open, held}), std::nullopt);
  EXPECT_EQ(of({open, held, limit("com_error_max_m", {}, 0.0)}), false);
  EXPECT_EQ(of({held}), true);
}

TEST(Metrics, AreAllInTheProgramsOutput) {
  const json metrics = json::parse(to_json(some_metrics()));
  for (const Metric& metric : metric_table())
    EXPECT_TRUE(metrics.contains(std::string(metric.name))) << metric.name;
  EXPECT_EQ(metrics.size(), metric_table().size()) << "a name stands twice";
  EXPECT_EQ(metrics.at("tick_us"), json({{"median", 200.0}, {"p99", 400.0}, {"max", 900.0}}));
  EXPECT_TRUE(metrics.at("limb_extension_max_m").is_null());
  EXPECT_TRUE(metrics.at("succeeded").is_null());
}

/// The unit at the end of a name, as people read it: with its scale.
std::map<std::string, std::vector<ShownUnit>> units_by_ending() {
  const double degrees = 180.0 / kPi;
  return {{"_m", {{"m"}, {"mm", 1e3}}}, {"_mps", {{"m/s"}}},
          {"_rad", {{"°", degrees}}},   {"_radps", {{"°/s", degrees}, {"rad/s"}}},
          {"_nm", {{"N·m"}}},           {"_us", {{"µs"}}},
          {"_s", {{"s"}, {"ms", 1e3}}}};
}

TEST(Metrics, AreShownInAUnitThatFitsTheirName) {
  const auto units = units_by_ending();
  for (const Metric& metric : metric_table()) {
    const std::string ending(
        metric.name.substr(std::min(metric.name.rfind('_'), metric.name.size())));
    const auto found = units.find(ending);
    if (found == units.end()) {
      EXPECT_EQ(metric.unit.scale, 1.0) << metric.name;
      continue;
    }
    EXPECT_TRUE(std::ranges::any_of(found->second, [&](const ShownUnit& unit) {
      return unit.name == metric.unit.name && unit.scale == metric.unit.scale;
    })) << metric.name;
  }
}

TEST(Metrics, TenAreToldFirst) {
  EXPECT_EQ(std::ranges::count(metric_table(), Place::among_the_first, &Metric::place), 10);
}

TEST(Metrics, TheSummaryHoldsMetricsAndCriteria) {
  const Metrics metrics = some_metrics();
  const json summary = json::parse(
      summary_json(metrics, evaluate({limit("speed_mps", 0.2, {})}, metrics, Extent::whole)));
  EXPECT_EQ(summary.at("metrics").at("steps_taken"), 12);
  EXPECT_EQ(summary.at("criteria"),
            json::parse(R"([{"metric":"speed_mps","min":0.2,"value":0.1,"passed":false}])"));
  const json part = json::parse(
      summary_json(metrics, evaluate({limit("speed_mps", 0.2, {})}, metrics, Extent::part)));
  EXPECT_TRUE(part.at("criteria")[0].at("passed").is_null());
}

}  // namespace
}  // namespace surefoot::evaluation
