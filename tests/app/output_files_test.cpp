#include "app/output_files.hpp"

#include "tests/config/messages.hpp"
#include "tests/logging/temporary_folder.hpp"

namespace surefoot {
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

TEST(OutputFiles, a_seed_stands_before_the_extension) {
  EXPECT_EQ(with_seed("out/run.mcap", 7), "out/run-seed7.mcap");
}

TEST(OutputFiles, a_file_is_written_whole_and_alone) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.json", "{}");
  EXPECT_EQ(test::contents(folder / "a.json"), "{}");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.json.partial"));
}

}  // namespace
}  // namespace surefoot
