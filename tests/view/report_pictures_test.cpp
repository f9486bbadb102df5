#include "surefoot/view/report_pictures.hpp"

#include "surefoot/logging/recorder.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <string>

namespace surefoot {
namespace {

using test::contents;
using test::SyntheticRun;
using test::TemporaryFolder;

void record_some_ticks(const std::string& path) {
  Recorder recorder(path, SyntheticRun::header());
  SyntheticRun run;
  for (int i = 0; i < 40; ++i) {
    run.step();
    recorder.record(run.tick);
  }
  recorder.close();
}

std::string page_with(const ReportPictures& pictures) {
  const TemporaryFolder folder;
  record_some_ticks(folder / "run.mcap");
  return contents(write_report(folder / "run.mcap", folder / "report", pictures));
}

ReportPictures some() {
  return {.strip = "a strip", .times = {1.5, 2.25}, .clip = "a clip", .first = 1.0, .last = 3.0};
}

TEST(Base64, AreTheExamplesOfRfc4648) {
  EXPECT_EQ(report::base64(""), "");
  EXPECT_EQ(report::base64("f"), "Zg==");
  EXPECT_EQ(report::base64("fo"), "Zm8=");
  EXPECT_EQ(report::base64("foo"), "Zm9v");
  EXPECT_EQ(report::base64("foob"), "Zm9vYg==");
  EXPECT_EQ(report::base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(report::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(report::base64("\xff\xfe\xfb"), "//77");
}

TEST(ReportPictures, AreExplainedAsFarAsTheyGo) {
  constexpr const char* kPush = "the yellow arrow";
  ReportPictures pictures = some();
  EXPECT_EQ(page_with(pictures).find(kPush), std::string::npos) << "nothing pushes";
  pictures.has_pushes = true;
  EXPECT_NE(page_with(pictures).find(kPush), std::string::npos);
}

TEST(ReportPictures, StandInThePageItselfWithTheirTimes) {
  const std::string page = page_with(some());
  EXPECT_NE(page.find("src=\"data:image/jpeg;base64,YSBzdHJpcA==\""), std::string::npos);
  EXPECT_NE(page.find("src=\"data:video/mp4;base64,YSBjbGlw\""), std::string::npos);
  EXPECT_NE(page.find("at 1.50 s, 2.25 s"), std::string::npos);
  EXPECT_NE(page.find("1.00 s to 3.00 s of the run"), std::string::npos);
  EXPECT_LT(page.find("<h2>Pictures</h2>"), page.find("<h2>Numbers</h2>"));
  EXPECT_EQ(page.find("No pictures"), std::string::npos);
}

TEST(ReportPictures, TheirPageIsThereBeforeThemAndSaysThatTheyCome) {
  const TemporaryFolder folder;
  record_some_ticks(folder / "run.mcap");
  std::string early;
  const std::string path =
      write_report_before_pictures(folder / "run.mcap", folder / "report", [&](const auto& page) {
        early = contents(page);
        return some();
      });
  EXPECT_NE(early.find("They are being made"), std::string::npos);
  EXPECT_NE(early.find("<h2>Numbers</h2>"), std::string::npos);
  EXPECT_EQ(early.find("data:image"), std::string::npos);
  EXPECT_EQ(contents(path), contents(write_report(folder / "run.mcap", folder / "same", some())));
}

TEST(ReportPictures, APageThatFindsNoRoomForThemStaysWithoutAndSaysWhy) {
  const TemporaryFolder folder;
  record_some_ticks(folder / "run.mcap");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{.rlim_cur = 2'000'000, .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  const std::string path = write_report_before_pictures(
      folder / "run.mcap", folder / "report",
      [](const auto&) { return ReportPictures{.clip = std::string(3'000'000, 'c')}; });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  const std::string page = contents(path);
  EXPECT_NE(page.find("No pictures: "), std::string::npos);
  EXPECT_NE(page.find("can't be written"), std::string::npos);
  EXPECT_EQ(page.find("They are being made"), std::string::npos);
}

TEST(ReportPictures, NeedNothingFromOutside) {
  const std::string page = page_with(some());
  for (const char* text : {"http:", "https:", "<script", "<link", "@import", "url("}) {
    EXPECT_EQ(page.find(text), std::string::npos) << text;
  }
}

TEST(ReportPictures, WhyThereAreNoneIsSaidAndEscaped) {
  const std::string page = page_with({.why_none = "no renderer <here> & now"});
  EXPECT_NE(page.find("No pictures: no renderer &lt;here&gt; &amp; now"), std::string::npos);
  EXPECT_EQ(page.find("<figure class=\"pictures\">"), std::string::npos);
}

TEST(ReportPictures, NobodyAskedForLeaveNoTrace) {
  EXPECT_EQ(page_with({}).find("Pictures</h2>"), std::string::npos);
}

TEST(ReportPictures, NotesStandBelowThem) {
  ReportPictures pictures = some();
  pictures.notes = {"LF_HIP is shown as the physics has it"};
  const std::string page = page_with(pictures);
  EXPECT_GT(page.find("LF_HIP is shown"), page.find("<video"));
  EXPECT_NE(page.find("LF_HIP is shown"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
