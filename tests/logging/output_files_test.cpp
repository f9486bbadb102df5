#include "surefoot/logging/output_files.hpp"

#include "surefoot/logging/write_lock.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <sys/resource.h>

#include <csignal>

namespace surefoot::logging {
namespace {

using test::holds;
using test::message_of;

TEST(OutputFiles, a_folder_that_can_not_be_made_is_named) {
  const test::TemporaryFolder folder;
  test::write_file(folder / "file", "in the way");
  EXPECT_TRUE(holds(message_of([&] { prepare_folder(folder / "file/report"); }), "file/report"));
  EXPECT_TRUE(holds(message_of([] { prepare_folder("/proc/report"); }), "/proc/report"));
}

TEST(OutputFiles, a_log_in_a_missing_folder_or_named_like_a_folder_is_told) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(holds(message_of([&] { check_writable_file(folder / "none/run.mcap"); }),
                    "there is no folder"));
  EXPECT_TRUE(holds(message_of([&] { check_writable_file(folder.path()); }), "is a folder"));
}

TEST(OutputFiles, checking_leaves_nothing_behind) {
  const test::TemporaryFolder folder;
  check_writable_file(folder / "run.mcap");
  prepare_folder(folder.path());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(OutputFiles, what_is_read_is_not_written) {
  const test::TemporaryFolder folder;
  test::write_file(folder / "run.mcap", "a run");
  const auto told = [&](const char* output, const char* input) {
    return message_of([&] { check_not_the_input(folder / output, folder / input); });
  };
  EXPECT_TRUE(holds(told("run.mcap", "run.mcap"), "is the log itself"));
  EXPECT_NO_THROW(check_not_the_input(folder / "ticks.csv", folder / "run.mcap"));
  EXPECT_NO_THROW(check_not_the_input(folder / "ticks.csv", "walk_flat"));
}

TEST(OutputFiles, a_place_without_room_is_told_and_nothing_is_left_there) {
  const test::TemporaryFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit none{.rlim_cur = 0, .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &none), 0);
  const std::string message = message_of([&] { check_writable_file(folder / "run.mcap"); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(holds(message, "run.mcap: can't be written: ")) << message;
  EXPECT_TRUE(holds(message, "that has room would be valid")) << message;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(OutputFiles, an_earlier_run_is_removed_and_nothing_else) {
  const test::TemporaryFolder folder;
  for (const char* file : {"index.html", "run.mcap", "run.mcap.partial", "notes.txt"}) {
    test::write_file(folder / file, "of an earlier run");
  }
  remove_outdated(folder.path(), {});
  EXPECT_FALSE(std::filesystem::exists(folder / "index.html"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run.mcap"));
  remove_outdated(folder.path(), folder / "run.mcap");
  for (const char* file : {"run.mcap", "run.mcap.partial"}) {
    EXPECT_FALSE(std::filesystem::exists(folder / file)) << file;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "notes.txt"));
  remove_outdated(folder / "none", folder / "none/run.mcap");  // nothing there is no error
}

TEST(OutputFiles, a_log_that_is_being_written_is_not_removed) {
  const test::TemporaryFolder folder;
  const WriteLock writer(folder / "run.mcap.partial", "run.mcap");
  const std::string message =
      message_of([&] { remove_outdated(folder.path(), folder / "run.mcap"); });
  EXPECT_TRUE(holds(message, "run.mcap: is being written by another run")) << message;
  EXPECT_TRUE(std::filesystem::exists(folder / "run.mcap.partial"));
}

TEST(OutputFiles, what_can_not_be_removed_is_named) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "index.html/in_the_way");
  EXPECT_TRUE(holds(message_of([&] { remove_outdated(folder.path(), {}); }), "index.html"));
}

TEST(OutputFiles, a_folder_with_something_in_it_stays) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "empty");
  std::filesystem::create_directories(folder / "full");
  test::write_file(folder / "full/notes.txt", "mine");
  for (const char* name : {"empty", "full", "none"}) remove_if_empty(folder / name);
  EXPECT_FALSE(std::filesystem::exists(folder / "empty"));
  EXPECT_TRUE(std::filesystem::exists(folder / "full"));
}

TEST(OutputFiles, the_next_log_is_none_that_is_there) {
  const test::TemporaryFolder folder;
  const std::filesystem::path log = folder / "run.mcap";
  EXPECT_EQ(next_free_log(log), folder / "run-2.mcap");
  test::write_file(folder / "run-2.mcap", "whole");
  test::write_file(folder / "run-3.mcap.partial", "cut off");
  EXPECT_EQ(next_free_log(log), folder / "run-4.mcap");
}

TEST(OutputFiles, a_file_is_written_whole_and_alone) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.json", "{}");
  EXPECT_EQ(test::contents(folder / "a.json"), "{}");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.json.partial"));
}

}  // namespace
}  // namespace surefoot::logging
