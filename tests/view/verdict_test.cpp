#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/view/outcome.hpp"
#include "surefoot/view/report.hpp"
#include "surefoot/view/report_numbers.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot {
namespace {

using test::contents;
using test::SyntheticRun;
using test::TemporaryFolder;
using test::write_file;

TEST(Verdict, EveryCriterionAndEveryFigureOfThePaperIsInTheTable) {
  const report::Outcome outcome = report::read_outcome(
      R"({"metrics":{"goal_reached":false,"fell":false,"tick_us":{"p99":12.0},"odd_m":2.5},"criteria":[
          {"metric":"goal_reached","equals":true,"passed":false},
          {"metric":"fell","equals":false,"passed":true},
          {"metric":"tick_us.p99","max":10.0,"passed":false},
          {"metric":"odd_m","min":1.0,"passed":true}]})",
      R"({"paper":{"goal_reached":"14 cm","torso_contacts":"none"}})");
  const std::string table = report::numbers(outcome);
  for (const char* text :
       {"<td>goal reached</td>", "yes  ✗ missed", "14 cm", "<td>fell</td>", "no  ✓ holds",
        "≤ 10 µs  ✗ missed", "<td>odd_m</td>", "≥ 1  ✓ holds", "<td>torso contacts</td>", "none"}) {
    EXPECT_NE(table.find(text), std::string::npos) << text;
  }
}

constexpr const char* kNoFall = R"({"metric":"fell","equals":false,"passed":true})";

void damage_a_chunk(const std::string& path) {
  const auto chunks = McapChunks(path).chunks();
  const McapChunk& chunk = chunks.at(chunks.size() / 3);
  std::string bytes = contents(path);
  bytes.at(chunk.offset + chunk.size / 2) ^= '\x40';
  write_file(path, bytes);
}

// A log of a run that ended for this reason, with a goal, and with an event at 0.5 s and later.
std::string report_of_end(const std::string& reason, const std::string& criterion = kNoFall,
                          bool is_steered = false, bool is_damaged = false) {
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  header.options = R"({"goal":{"feet_beyond_x":0.42}})";
  Recorder recorder(folder / "run.mcap", header);
  const auto changes = recorder.add_channel("/changes", "surefoot.Change", "{}");
  if (is_steered) recorder.record(changes, 0.0, [](std::string& out) { out = "{}"; });
  SyntheticRun run;
  for (int i = 0; i < 400; ++i) {
    run.step();
    if (i == 200 || i == 300) run.tick.plan.events.add({.kind = PlanEvent::no_ground});
    recorder.record(run.tick);
    recorder.record(run.timing);
  }
  recorder.close(R"({"metrics":{"succeeded":true,"goal_reached":false,"reason":")" + reason +
                 R"("},"criteria":[)" + criterion + "]}");
  if (is_damaged) damage_a_chunk(folder / "run.mcap");
  return contents(write_report(folder / "run.mcap", folder / "report"));
}

TEST(Verdict, AGoalThatWasNotReachedStandsBesideTheVerdict) {
  const std::string page = report_of_end("ran to its end");
  EXPECT_NE(page.find("✓ the criterion holds: fell"), std::string::npos);
  EXPECT_NE(page.find("✗ goal not reached</div>"), std::string::npos);
  EXPECT_NE(page.find("beyond x = 0.42 m"), std::string::npos);
  EXPECT_NE(page.find("<b>2 ×</b> no ground within reach: foot taken back, first at 0.5 s"),
            std::string::npos);
  const std::string failure = R"({"metric":"goal_reached","equals":false,"passed":true})";
  EXPECT_NE(report_of_end("ran to its end", failure).find("not reached, as the criteria expect"),
            std::string::npos);
}

TEST(Verdict, AGoalThatACriterionMissesIsToldOnce) {
  const std::string page =
      report_of_end("ran to its end", R"({"metric":"goal_reached","equals":true,"passed":false})");
  EXPECT_NE(page.find("✗ 1 of 1 criterion missed: goal reached</div>"), std::string::npos);
  EXPECT_EQ(page.find("goal not reached"), std::string::npos);
}

TEST(Verdict, OfARunThatWasInterruptedOrBegunAgainIsNotJudged) {
  for (const std::string reason : {"interrupted", "begun again"}) {
    const std::string page = report_of_end(reason);
    EXPECT_NE(page.find("class=\"warning\">The run was " + reason + " at 1 s"), std::string::npos);
    EXPECT_NE(page.find("(not judged)"), std::string::npos);
    EXPECT_EQ(page.find("class=\"verdict"), std::string::npos);
    EXPECT_EQ(page.find("✓"), std::string::npos);
  }
}

TEST(Verdict, BesideTheCommandStandsWhatItLeavesOut) {
  constexpr const char *kCut = "goes on where this log ends", *kByHand = "pushed by hand";
  const std::string whole = report_of_end("ran to its end"), cut = report_of_end("interrupted"),
                    steered = report_of_end("ran to its end", kNoFall, true);
  EXPECT_EQ(whole.find(kCut), std::string::npos);
  EXPECT_EQ(whole.find(kByHand), std::string::npos);
  EXPECT_NE(cut.find(kCut), std::string::npos);
  EXPECT_NE(steered.find(kByHand), std::string::npos);
}

TEST(Verdict, ThatARunWasSteeredByHandStandsBesideItsVerdict) {
  constexpr const char* kSteered =
      "class=\"warning\">The run was steered by hand: 1 change or push ";
  const std::string steered = report_of_end("ran to its end", kNoFall, true);
  EXPECT_LT(steered.find(kSteered), steered.find("<h2>"));
  for (const std::string& page :
       {report_of_end("ran to its end"), report_of_end("interrupted", kNoFall, true)})
    EXPECT_EQ(page.find(kSteered), std::string::npos) << "where nothing is judged";
}

TEST(Verdict, OfALogThatIsDamagedWithinItIsSaidWhatMayBeMissing) {
  constexpr const char *kNotWhole = "class=\"warning\">The log is not whole: ",
                       *kByHand = "may be missing here: the log is damaged",
                       *kCut = "goes on where this log ends";
  const std::string damaged = report_of_end("ran to its end", kNoFall, false, true);
  EXPECT_NE(damaged.find(kNotWhole), std::string::npos);
  EXPECT_NE(damaged.find(kByHand), std::string::npos);
  EXPECT_EQ(damaged.find(kCut), std::string::npos) << "its end is there";
  EXPECT_NE(damaged.find("✓ the criterion holds: fell"), std::string::npos);
  const std::string whole = report_of_end("ran to its end");
  for (const char* text : {kNotWhole, kByHand}) EXPECT_EQ(whole.find(text), std::string::npos);
}

TEST(Verdict, ASummaryOfAnotherShapeIsNone) {
  const std::string options = R"({"criteria":{"fell":false},"goal":{"feet_beyond_x":1}})";
  for (const char* summary :
       {"", "{}", "no", "[]", R"({"metrics":{},"criteria":{"fell":true}})",
        R"({"metrics":{"reason":null},"criteria":[]})", R"({"metrics":[],"criteria":[]})",
        R"({"metrics":{"reason":"fell"},"criteria":[{"metric":"fell","passed":"no"}]})"}) {
    SCOPED_TRACE(summary);
    const report::Outcome outcome = report::read_outcome(summary, options);
    EXPECT_FALSE(outcome.known);
    EXPECT_TRUE(outcome.metrics.empty() && outcome.reason.empty());
    EXPECT_EQ(outcome.criteria.size(), 1u);
    EXPECT_NE(outcome.goal, "");
  }
  EXPECT_TRUE(report::read_outcome(R"({"metrics":{},"criteria":[]})", R"({"goal":[]})").known);
  EXPECT_EQ(report::read_outcome("", R"({"goal":{"feet_beyond_x":"far"}})").goal, "");
}

}  // namespace
}  // namespace surefoot
