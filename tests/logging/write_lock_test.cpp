#include "surefoot/logging/write_lock.hpp"

#include "surefoot/base/error.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>

namespace surefoot::logging {
namespace {

std::string refusal(const std::string& path) {
  try {
    const WriteLock lock(path, "run.mcap");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST(WriteLock, ASecondWriterIsRefusedAndToldWhoTheFirstIs) {
  const test::TemporaryFolder folder;
  for (const std::string& path : {folder / "run.mcap.partial", folder.path()}) {
    std::optional<WriteLock> first;
    first.emplace(path, path);
    EXPECT_EQ(refusal(path), "run.mcap: is being written by another run (process " +
                                 std::to_string(getpid()) +
                                 "); wait for it, or choose another name");
    first.reset();
    EXPECT_EQ(refusal(path), "");
  }
}

TEST(WriteLock, AFileThatGotAnotherNameIsNotTheOneThatIsLocked) {
  const test::TemporaryFolder folder;
  const WriteLock first(folder / "run.mcap.partial", "run.mcap");
  std::filesystem::rename(folder / "run.mcap.partial", folder / "run.mcap");
  EXPECT_EQ(refusal(folder / "run.mcap.partial"), "");
  EXPECT_NE(refusal(folder / "run.mcap"), "");
}

TEST(WriteLock, WhereNothingCanBeMadeNothingIsSaid) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(refusal(folder / "none/run.mcap"), "");
}

}  // namespace
}  // namespace surefoot::logging
