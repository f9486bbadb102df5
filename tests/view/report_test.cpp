#include "surefoot/view/report.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/evaluation/criteria.hpp"
#include "surefoot/evaluation/evaluator.hpp"
#include "surefoot/evaluation/truth_log.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/view/outcome.hpp"
#include "surefoot/view/report_numbers.hpp"
#include "surefoot/view/run_data.hpp"
#include "surefoot/view/svg.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

namespace surefoot {
namespace {

using test::contents;
using test::SyntheticRun;
using test::TemporaryFolder;
using test::write_file;

struct Options {
  double seconds = 5.0;
  std::string estimation = "sensors";
  bool truth = true;
  bool walked_down = true;
  double explained = 1.0;     // share of the ticks at which it is known what held levels back
  bool pushed = false;        // alone from 2 to 3 s, to the left
  double calibrates = 0.0;    // for so long from the beginning [s]
  Mat3 R = Mat3::Identity();  // the true world, from where the controller believes to be
  Vec3 p = Vec3::Zero();
};

GroundTruth elsewhere(GroundTruth truth, const Mat3& R, const Vec3& p) {
  truth.p_WB = R * truth.p_WB + p;
  truth.q_WB = Quat(R) * truth.q_WB;
  truth.v_WB = R * truth.v_WB;
  truth.p_WCom = R * truth.p_WCom + p;
  for (Vec3& foot : truth.p_WF) foot = R * foot + p;
  return truth;
}

// A log of a synthetic run with everything the report shows.
void record(const std::string& path, const Options& options,
            LogHeader header = SyntheticRun::header()) {
  header.estimation = options.estimation;
  Recorder recorder(path, std::move(header));
  std::optional<TruthLog> truth_log;
  if (options.truth) truth_log.emplace(recorder);
  Evaluator evaluator({});
  SyntheticRun run(1, options.walked_down ? 2.0 : 1e9);
  for (int i = 0; i < options.seconds / SyntheticRun::kPeriod; ++i) {
    run.step();
    run.tick.plan.calibration = run.tick.reading.time < options.calibrates
                                    ? CalibrationStage::turning
                                    : CalibrationStage::none;
    if (i % 100 >= 100.0 * options.explained) run.tick.hierarchy.blocking_is_known = false;
    GroundTruth truth = elsewhere(run.truth, options.R, options.p);
    if (options.pushed) {
      truth.q_WB = Quat::Identity();
      truth.xfrc_applied.assign(84, 0.0);
      if (i > 800 && i <= 1200) truth.xfrc_applied[6 + 1] = 50.0;
    }
    if (truth_log) truth_log->record(truth);
    recorder.record(run.tick);
    recorder.record(run.timing);
    evaluator.add(truth, run.tick);
    evaluator.add(run.timing);
  }
  const Metrics metrics = evaluator.metrics({.reason = "completed"});
  const Criterion limit{.metric = "com_error_max_m", .min = {}, .max = 0.0005, .equals = {}};
  recorder.close(summary_json(metrics, evaluate({limit}, metrics)));
}

std::string report_of(const Options& options) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", options);
  return contents(write_report(folder / "run.mcap", folder / "report"));
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(Report, ShowsAllFiguresAndNumbersOfARun) {
  const std::string page = report_of({});
  for (const char* text : {"<h1>synthetic</h1>",
                           "anymal_b",
                           "seed 7",
                           "COM tracking error, largest",
                           "≤ 3.4 mm, on the robot",
                           "≤ 0.5 mm  ✓ holds",
                           "(a) COM, lateral",
                           "(c) COM tracking error in the plane",
                           "(a) orientation error",
                           "(b) height error",
                           "LF hip–foot distance",
                           "RF hip–foot distance",
                           "LH hip–foot distance",
                           "RH hip–foot distance",
                           "limits 0.18 m (outside) and 0.535 m",
                           "class=\"stance\"",
                           "class=\"search\"",
                           "class=\"support\"",
                           "x [m]",
                           "torque [N·m]",
                           "7  limb limits",
                           "7  limb limit RF",
                           "(a) tilt",
                           "(c) position, drift",
                           "(a) from above",
                           "(b) from the side",
                           "touchdown",
                           "time per tick [µs]",
                           "dropped the dummy inertia"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(count(page, "<figure>"), 10);
  EXPECT_EQ(count(page, "<svg class=\"plot\""), 10);
  std::size_t before = 0;
  for (int number = 1; number <= 10; ++number) {
    const std::size_t here = page.find("<b>Figure " + std::to_string(number) + ".</b>");
    EXPECT_TRUE(here != std::string::npos && here > before) << number;
    before = here;
  }
}

std::string estimate_of(const std::string& page) {
  const std::size_t title = page.find("(a) tilt");
  if (title == std::string::npos) return "";
  const std::size_t begin = page.rfind("<svg class=\"plot\"", title);
  return page.substr(begin, page.find("</svg>", title) - begin);
}

TEST(Report, ErrorsOfTheEstimateDoNotHangOnWhereTheRobotBegan) {
  const std::string here = estimate_of(report_of({}));
  EXPECT_FALSE(here.empty());
  EXPECT_EQ(here, estimate_of(report_of({.R = rotation_about_z(2.0), .p = Vec3(3.0, -7.0, 0.5)})));
  EXPECT_NE(here,
            estimate_of(report_of({.R = Eigen::AngleAxisd(0.1, Vec3::UnitY()).toRotationMatrix()})))
      << "a tilt is none";
}

TEST(Report, WhereTheTruthIsGivenThereIsNoEstimateToShow) {
  EXPECT_EQ(estimate_of(report_of({.estimation = "truth"})), "");
}

TEST(Report, APushIsToldWithItsTimeSizeAndDirection) {
  const std::string page = report_of({.pushed = true});
  EXPECT_NE(page.find("<li>Pushed by 50 N, 90° from ahead to the left, on the base, "
                      "from 2 s to 3 s</li>"),
            std::string::npos);
  EXPECT_EQ(count(page, "Pushed by"), 1);
}

TEST(Report, EveryMetricThatACriterionMayNameHasWords) {
  const report::Outcome outcome = report::read_outcome(summary_json(Metrics(), {}), "");
  EXPECT_GT(outcome.metrics.size(), 40U);
  for (const report::Metric& metric : outcome.metrics) {
    const std::string& name = metric.name;
    if (name == "succeeded" || name == "reason" || name == "seed" || name == "version" ||
        name == "fell")
      continue;
    EXPECT_NE(report::name_of(name), name) << name;
  }
}

TEST(Report, ACriterionOfThePathIsToldInMillimetres) {
  const std::string summary = R"({"metrics": {"path_deviation_max_m": 0.007}, "criteria": [)"
                              R"({"metric": "path_deviation_max_m", "max": 0.1, "passed": true}]})";
  const std::string table = report::numbers(report::read_outcome(summary, ""));
  EXPECT_NE(table.find(">distance from the path, largest<"), std::string::npos) << table;
  EXPECT_NE(table.find(">7 mm<"), std::string::npos) << table;
  EXPECT_NE(table.find("≤ 100 mm  ✓ holds"), std::string::npos) << table;
}

TEST(Report, SaysWhatGaveWayToWhatForHowLongAndAtWhichCost) {
  const std::string page = report_of({});
  const std::size_t table = page.find("<h3>What gave way to what</h3>");
  ASSERT_NE(table, std::string::npos);
  const std::string rest = page.substr(table, page.find("</table>", table) - table);
  const std::regex row(
      "<td>10  roll and pitch</td><td>7  limb limits: RF extension</td>"
      "<td class=\"number\">([0-9.]+) s</td><td class=\"number\">([0-9.]+) %</td>"
      "<td class=\"number\">8 rad/s²</td><td class=\"number\">([0-9.]+) s</td>");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(rest, found, row)) << rest;
  EXPECT_NEAR(std::stod(found[1]), 1.76, 0.01);
  EXPECT_NEAR(std::stod(found[2]), 35.2, 0.2);
  EXPECT_NEAR(std::stod(found[3]), 3.25, 0.05);
}

TEST(Report, SaysNothingOfWhatGaveWayWhereTheLogDoesNotKnow) {
  EXPECT_EQ(report_of({.explained = 0.0}).find("What gave way"), std::string::npos);
  const std::string page = report_of({.explained = 0.25});
  EXPECT_NE(page.find("Known at 25 % of the ticks"), std::string::npos);
  const std::string flat = report_of({.walked_down = false});
  EXPECT_NE(flat.find("No level was held back"), std::string::npos);
}

TEST(Report, FiguresOfThePaperAreTheScenariosAndNoOthers) {
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  const auto page = [&](const std::string& options) {
    header.options = options;
    record(folder / "run.mcap", {.seconds = 0.1}, header);
    return contents(write_report(folder / "run.mcap", folder / "report"));
  };
  const std::string given =
      page(R"({"paper":{"com_error_max_m":null,"speed_mps":"0.07 m/s","steps_taken":12}})");
  EXPECT_NE(given.find("<td class=\"soft\">0.07 m/s</td>"), std::string::npos);
  EXPECT_NE(given.find("<td class=\"soft\">12</td>"), std::string::npos);
  EXPECT_EQ(given.find("3.4 mm"), std::string::npos);
  for (const char* none : {"", "{}", R"({"paper":null})"}) {
    EXPECT_EQ(count(page(none), "<td class=\"soft\"></td>"), count(given, "<td class=\"soft\">"))
        << none;
  }
}

TEST(Report, ShadesTheTorsosErrorsWhereTheLimbLimitsAct) {
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  // Shaded stretches of the panels (a) and (b): a panel's title is drawn behind its spans.
  const auto shaded = [&] {
    record(folder / "run.mcap", {}, header);
    const std::string page = contents(write_report(folder / "run.mcap", folder / "report"));
    const std::size_t a = page.find("(a) orientation error"), b = page.find("(b) height error");
    const std::size_t figure = page.rfind("<svg class=\"plot\"", a);
    return std::pair(count(page.substr(figure, a - figure), "class=\"search\""),
                     count(page.substr(a, b - a), "class=\"search\""));
  };
  EXPECT_EQ(shaded(), std::pair(1, 1));  // the one stretch of the synthetic adaptation
  header.limb.level = -1;
  EXPECT_EQ(shaded(), std::pair(0, 0));
}

TEST(Report, EachFigureIsAFileThatStandsAlone) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", {.seconds = 1.0});
  const std::string page = contents(write_report(folder / "run.mcap", folder / "report"));
  const std::regex link("href=\"(figures/[a-z_]+\\.svg)\" download");
  int files = 0;
  for (std::sregex_iterator found(page.begin(), page.end(), link), end; found != end; ++found) {
    const std::string image = contents(folder / "report/" + (*found)[1].str());
    EXPECT_TRUE(image.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\"")) << (*found)[1];
    EXPECT_EQ(image.find("var("), std::string::npos) << "only browsers know variables";
    EXPECT_NE(image.find(".c0 { stroke: #0072b2; }"), std::string::npos);
    ++files;
  }
  EXPECT_EQ(files, count(page, "<figure>"));
  record(folder / "run.mcap", {.seconds = 1.0, .truth = false});
  write_report(folder / "run.mcap", folder / "report");
  EXPECT_FALSE(std::filesystem::exists(folder / "report/figures/forces.svg"))
      << "of an earlier run that had it";
  EXPECT_TRUE(std::filesystem::exists(folder / "report/figures/torques.svg"));
}

TEST(Report, NoUnitOfAResidualIsCutOff) {
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  const std::string unit = "N, N·m, m/s² and rad/s², each of its own";
  header.level_units.assign(header.level_names.size(), unit);
  record(folder / "run.mcap", {.seconds = 3.0}, header);
  write_report(folder / "run.mcap", folder / "report");
  const std::string image = contents(folder / "report/figures/residuals.svg");
  const std::regex text("<text x=\"([0-9.]+)\"[^>]*>([^<]*own[^<]*)<");
  int units = 0;
  for (std::sregex_iterator found(image.begin(), image.end(), text), end; found != end; ++found) {
    EXPECT_LT(std::stod((*found)[1]) + plot::text_width((*found)[2].str()), 880.0);
    ++units;
  }
  EXPECT_GT(units, 0);
}

TEST(Report, WhatTheCalibrationIsInAndWhatNotIsTold) {
  const std::string page = report_of({.calibrates = 1.5});
  EXPECT_NE(page.find("calibrates itself on the spot (0 to 1.5 s)"), std::string::npos);
  EXPECT_GT(count(page, "class=\"calibration\""), 10);
  for (const char* row : {"<td>COM tracking error, largest</td>", "<td>largest tilt</td>"}) {
    const std::size_t at = page.find(row);
    ASSERT_NE(at, std::string::npos) << row;
    EXPECT_NE(page.substr(at, page.find("</tr>", at) - at).find(", without calibration<"),
              std::string::npos)
        << row;
  }
  EXPECT_NE(page.find("<td>largest tilt while calibrating</td>"), std::string::npos);
  const std::string none = report_of({});
  EXPECT_EQ(count(none, "class=\"calibration\""), 0);
  EXPECT_EQ(none.find("without calibration"), std::string::npos);
  EXPECT_EQ(none.find("while calibrating"), std::string::npos);
}

TEST(Report, ANumberSaysWhatItIsMeasuredOn) {
  const report::Outcome outcome = report::read_outcome(summary_json(Metrics(), {}), "");
  const std::string table = report::numbers(outcome);
  for (const char* cell :
       {"truth against plan", "truth, while it walks", "plan", "command", "wall clock"}) {
    EXPECT_NE(table.find("<td class=\"basis\">" + std::string(cell) + "<"), std::string::npos)
        << cell;
  }
  EXPECT_EQ(table.find("<td class=\"basis\"><"), std::string::npos);
}

TEST(Report, NeedsNoNetworkAndNoScript) {
  const std::string page = report_of({});
  for (const char* text :
       {"http:", "https:", "//", "<script", "<link", "<img", "@import", "url(", "src="}) {
    EXPECT_EQ(page.find(text), std::string::npos) << text;
  }
}

TEST(Report, ServesLightAndDark) {
  EXPECT_NE(report_of({.seconds = 0.5}).find("prefers-color-scheme: dark"), std::string::npos);
}

TEST(Report, StaysSmallForALongRun) { EXPECT_LT(report_of({.seconds = 25.0}).size(), 1'000'000u); }

TEST(Report, TheSameLogGivesTheSamePage) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", {.seconds = 1.0});
  const std::string first = contents(write_report(folder / "run.mcap", folder / "a"));
  EXPECT_EQ(first, contents(write_report(folder / "run.mcap", folder / "b")));
}

TEST(Report, OfALogWithoutTruthShowsWhatTheControllerBelieved) {
  const std::string page = report_of({.seconds = 1.0, .truth = false});
  EXPECT_NE(page.find("estimated"), std::string::npos);
  EXPECT_EQ(page.find("orientation error</text>"), std::string::npos);
  EXPECT_NE(page.find("hip–foot distance"), std::string::npos);
}

TEST(Report, OfACutOffLogShowsItsBeginningAndSaysSo) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", {});
  const std::string whole = contents(folder / "run.mcap");
  write_file(folder / "cut.mcap", whole.substr(0, whole.size() / 2));
  const std::string page = contents(write_report(folder / "cut.mcap", folder / "report"));
  EXPECT_NE(page.find("The log is not whole"), std::string::npos);
  EXPECT_NE(page.find("(a) COM, lateral"), std::string::npos);
  EXPECT_EQ(report_of({.seconds = 1.0}).find("The log is not whole"), std::string::npos);
}

TEST(Report, OfALogWithoutTicksIsRefused) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", {.seconds = 0.0});
  EXPECT_THROW(write_report(folder / "run.mcap", folder / "report"), FileError);
  EXPECT_FALSE(std::filesystem::exists(folder / "report"));
}

TEST(Report, SaysHowToMakeTheRunAgain) {
  const std::string page = report_of({.seconds = 0.1});
  for (const char* text :
       {"<pre>bin/surefoot run synthetic --seed 7 --set gait.swing_duration=0.5</pre>",
        "a walk that never happened", "commit 0123456789ab", "What the seed drew: 1 value<",
        "initial.x", "−0.05", "2.5 ms, 400 Hz"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
}

TEST(Report, CaptionsPromiseOnlyWhatTheStackHas) {
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  header.limb = {};
  record(folder / "run.mcap", {.seconds = 1.0, .walked_down = false}, header);
  const std::string page = contents(write_report(folder / "run.mcap", folder / "report"));
  EXPECT_EQ(page.find("orange"), std::string::npos);
  EXPECT_NE(page.find("this stack does not limit it"), std::string::npos);
  EXPECT_NE(page.find("period 2500 µs"), std::string::npos);
}

TEST(Report, TheMapShowsTheEdgeOfTheGround) {
  EXPECT_NE(report_of({}).find("ground at −0.14 m"), std::string::npos);
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  header.terrain.erase(header.terrain.begin());
  record(folder / "run.mcap", {.seconds = 1.0}, header);
  const std::string page = contents(write_report(folder / "run.mcap", folder / "report"));
  EXPECT_EQ(page.find("class=\"edge\""), std::string::npos);
  EXPECT_NE(page.find("class=\"ground-line\""), std::string::npos);
}

TEST(Report, OfWhatIsNoLogLeavesNothing) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", {.seconds = 0.1});
  write_file(folder / "cut.mcap", contents(folder / "run.mcap").substr(0, 100));
  write_file(folder / "README.md", "# no log\n");
  for (const char* name : {"cut.mcap", "README.md", "missing.mcap"}) {
    EXPECT_THROW(write_report(folder / name, folder / "a/b"), FileError) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "a")) << name;
  }
  EXPECT_NO_THROW(write_report(folder / "run.mcap", folder / "a/b"));
}

TEST(Report, AFolderThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", {.seconds = 0.1});
  write_file(folder / "file", "");
  for (const std::string& place : {folder / "file", folder / "file/report"}) {
    try {
      write_report(folder / "run.mcap", place);
      FAIL() << place;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
  }
}

TEST(Report, NamesFromALogAreMadeHarmless) {
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  header.scenario = "<b>bold</b>";
  header.level_names[3] = "<i>slanted</i>";
  record(folder / "run.mcap", {.seconds = 0.5}, header);
  const std::string page = contents(write_report(folder / "run.mcap", folder / "report"));
  EXPECT_EQ(page.find("<b>bold"), std::string::npos);
  EXPECT_EQ(page.find("<i>"), std::string::npos);
}

TEST(RunData, RowsAreActiveInStretchesOfTime) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", {});
  const RunData run = read_run(folder / "run.mcap");
  EXPECT_EQ(run.ticks.size(), 2000u);
  EXPECT_TRUE(run.has_truth);
  double limb_time = 0.0;
  int stretches = 0;
  for (const ActiveTime& time : run.active) {
    EXPECT_LT(time.from, time.to);
    if (time.level != 6 || time.id != 1) continue;
    limb_time += time.to - time.from;
    ++stretches;
  }
  // sin² of the synthetic adaptation, 2.5 s long, is above 0.2 for 1 − 2 asin(√0.2)/π of it.
  EXPECT_EQ(stretches, 1);
  EXPECT_NEAR(limb_time, 2.5 * (1.0 - 2.0 * std::asin(std::sqrt(0.2)) / kPi), 0.006);
}

TEST(RunData, LevelsThatWereNotSolvedHaveNeitherResidualNorRowsAtTheirBounds) {
  const TemporaryFolder folder;
  {
    Recorder recorder(folder / "run.mcap", SyntheticRun::header());
    SyntheticRun run(1, -1.0);  // in which rows of level 6 are active, and one holds level 9 back
    for (int i = 0; i < 4; ++i) {
      run.step();
      if (i >= 2) run.tick.hierarchy.status = 1;
      if (i >= 2) run.tick.hierarchy.failed_level = i == 2 ? 6 : 11;
      recorder.record(run.tick);
    }
    recorder.close("{}");
  }
  const RunData run = read_run(folder / "run.mcap");
  for (std::size_t i = 0; i < run.ticks.size(); ++i) {
    const TickSample& tick = run.ticks[i];
    EXPECT_EQ(std::isnan(tick.residuals[6]), i == 2) << i;
    EXPECT_FALSE(std::isnan(tick.residuals[5])) << i;
    EXPECT_EQ(tick.active.empty(), i == 2) << i;
  }
  EXPECT_EQ(run.active.front().to, run.ticks[2].time);
  EXPECT_EQ(run.gave_way.front().num_ticks, 3);
}

TEST(RunData, EachTickHasItsOwnTruth) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", {.seconds = 1.0});
  for (const TickSample& tick : read_run(folder / "run.mcap").ticks) {
    ASSERT_EQ(tick.truth.time, tick.time);
    ASSERT_EQ(tick.truth.p_WCom, tick.model.p_WCom);  // the synthetic run believes the truth
  }
}

TEST(RunData, PlansAreWhereTheStandingFeetAre) {
  const TemporaryFolder folder;
  const Mat3 R = rotation_about_z(0.4);
  const Vec3 p(0.5, -2.0, 0.1);
  record(folder / "here.mcap", {.seconds = 3.0});
  record(folder / "there.mcap", {.seconds = 3.0, .R = R, .p = p});
  const RunData here = read_run(folder / "here.mcap"), there = read_run(folder / "there.mcap");
  for (std::size_t i = 0; i < here.ticks.size(); ++i) {
    const TickSample &a = here.ticks[i], &b = there.ticks[i];
    ASSERT_LT((R.topLeftCorner<2, 2>() * a.desired_com + p.head<2>() - b.desired_com).norm(), 1e-9);
    ASSERT_LT((R * a.R_belief - b.R_belief).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace surefoot
