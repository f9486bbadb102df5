#include "surefoot/logging/mend_log.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/mcap_reader.hpp"
#include "surefoot/logging/mcap_writer.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace surefoot::logging {
namespace {

using test::contents;
using test::TemporaryFolder;
using test::write_file;

void write_log(const std::string& path) {
  McapWriter writer(path, {.profile = "test", .library = "test", .chunk_bytes = 4096});
  writer.attach("header.json", "application/json", "{}");
  const auto schema = writer.add_schema("Any", "jsonschema", R"({"type":"object"})");
  const auto channel = writer.add_channel("/state", schema, "json", {{"a", "b"}});
  for (std::uint64_t i = 0; i < 2000; ++i)
    writer.write(channel, i * 2'500'000, "{\"number\":" + std::to_string(i) + "}");
  writer.add_metadata("about", {{"key", "value"}});
  writer.attach("summary.json", "application/json", "{\"metrics\":{}}");
  writer.close();
}

struct Content {
  std::vector<std::string> messages;
  std::string schema, problem;
  std::map<std::string, std::string> attachments;
  std::map<std::string, std::map<std::string, std::string>> metadata;
};

Content read(const std::string& path) {
  McapReader reader(path);
  Content content;
  for (McapMessage message; reader.next(message);) {
    content.messages.push_back(message.channel->topic + std::to_string(message.log_time) +
                               std::string(message.data));
    content.schema = message.channel->schema.name + message.channel->schema.encoding +
                     message.channel->schema.data + message.channel->metadata.at("a");
  }
  content.problem = reader.problem();
  content.attachments = reader.attachments();
  content.metadata = reader.metadata();
  return content;
}

TEST(MendLog, WhatCanBeReadOfADamagedOrCutOffFileIsWrittenAsAWholeOne) {
  const TemporaryFolder folder;
  const std::string log = folder / "run.mcap", mended = folder / "mended.mcap";
  write_log(log);
  const std::string whole = contents(log);
  const McapChunk third = McapChunks(log).chunks().at(2);
  std::string turned = whole;
  turned.at(third.offset + third.size / 2) ^= '\xFF';
  for (const std::string& bytes : {whole, turned, whole.substr(0, whole.size() / 2)}) {
    write_file(log, bytes);
    const Content expected = read(log);
    EXPECT_EQ(mend_log(log, mended), expected.problem);
    EXPECT_EQ(expected.problem.empty(), bytes == whole);
    const Content found = read(mended);
    EXPECT_EQ(found.messages, expected.messages);
    EXPECT_EQ(found.schema, R"(Anyjsonschema{"type":"object"}b)");
    EXPECT_EQ(found.attachments, expected.attachments);
    EXPECT_EQ(found.metadata, expected.metadata);
    EXPECT_EQ(found.problem, "");
    EXPECT_GT(McapChunks(mended).chunks().size(), 1U) << "it has an index";
  }
}

TEST(MendLog, WhatIsNoLogLeavesNoFile) {
  const TemporaryFolder folder;
  write_file(folder / "text.mcap", "this is no log");
  EXPECT_THROW((void)mend_log(folder / "text.mcap", folder / "mended.mcap"), FileError);
  EXPECT_THROW((void)mend_log(folder / "none.mcap", folder / "mended.mcap"), FileError);
  EXPECT_FALSE(std::filesystem::exists(folder / "mended.mcap"));
}

}  // namespace
}  // namespace surefoot::logging
