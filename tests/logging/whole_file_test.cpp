#include "surefoot/logging/whole_file.hpp"

#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace surefoot::logging {
namespace {

TEST(WholeFile, OfTwoProcessesThatWriteItTheFileIsThatOfOne) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.json";
  WholeFile ours(path);
  ours.stream() << "ours, begun" << std::flush;
  const pid_t other = fork();
  if (other == 0) {
    WholeFile theirs(path);
    theirs.stream() << "theirs";
    theirs.finish();
    _exit(0);
  }
  ASSERT_EQ(waitpid(other, nullptr, 0), other);
  EXPECT_EQ(test::contents(path), "theirs");
  ours.stream() << " and ended";
  ours.finish();
  EXPECT_EQ(test::contents(path), "ours, begun and ended");
}

TEST(WholeFile, WithoutAnEndThereIsNone) {
  const test::TemporaryFolder folder;
  test::write_file(folder / "a.json", "before");
  test::write_file(folder / "a.json.partial", "of another");
  {
    WholeFile(folder / "a.json").stream() << "half of";
  }
  EXPECT_EQ(test::contents(folder / "a.json"), "before");
  EXPECT_EQ(test::contents(folder / "a.json.partial"), "of another");
  std::filesystem::remove(folder / "a.json");
  std::filesystem::remove(folder / "a.json.partial");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WholeFile, WhatCanNotBeWrittenIsNamed) {
  const test::TemporaryFolder folder;
  WholeFile file(folder / "none/a.json");
  file.stream() << "{}";
  EXPECT_EQ(test::message_of([&] { file.finish(); }).find(folder / "none/a.json: can't be written"),
            0u);
}

}  // namespace
}  // namespace surefoot::logging
