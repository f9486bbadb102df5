#include "surefoot/logging/crc32.hpp"
#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/mcap_reader.hpp"
#include "surefoot/logging/mcap_writer.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace surefoot::logging {
namespace {

using test::contents;
using test::holds;
using test::message_of;
using test::TemporaryFolder;
using test::write_file;

struct Message {
  std::string topic;
  std::uint64_t time;
  std::string data;
  friend bool operator==(const Message&, const Message&) = default;
};

// Two topics, messages of random length; the second topic appears late.
std::vector<Message> random_messages(int count) {
  std::mt19937_64 random(5);
  std::vector<Message> messages;
  for (int i = 0; i < count; ++i) {
    std::string data(random() % 300, ' ');
    for (char& c : data) c = static_cast<char>(random() & 0xFF);
    const bool late = i > count / 2 && random() % 3 == 0;
    messages.push_back(
        {late ? "/late" : "/early", static_cast<std::uint64_t>(i) * 2'500'000, data});
  }
  return messages;
}

void write(const std::string& path, const std::vector<Message>& messages, std::size_t chunk_bytes) {
  McapWriter writer(path, {.profile = "test", .library = "test", .chunk_bytes = chunk_bytes});
  writer.add_metadata("about", {{"key", "value"}});
  writer.attach("note.txt", "text/plain", "an attachment");
  const auto schema = writer.add_schema("Any", "jsonschema", "{}");
  const auto early = writer.add_channel("/early", schema, "json", {{"a", "b"}});
  const auto late = writer.add_channel("/late", schema, "json");
  for (const Message& message : messages) {
    writer.write(message.topic == "/late" ? late : early, message.time, message.data);
  }
  writer.attach("end.txt", "text/plain", "the end");
  writer.close();
}

std::vector<Message> read(McapReader& reader) {
  std::vector<Message> messages;
  McapMessage message;
  while (reader.next(message)) {
    messages.push_back({message.channel->topic, message.log_time, std::string(message.data)});
  }
  return messages;
}

// Of a file: where its chunks begin, each with the number of messages up to its end.
std::vector<std::pair<std::uint64_t, std::size_t>> chunks_of(const std::string& path) {
  McapReader reader(path);
  McapMessage message;
  std::vector<std::pair<std::uint64_t, std::size_t>> chunks;
  for (std::size_t count = 1; reader.next(message); ++count) {
    if (chunks.empty() || chunks.back().first != reader.chunk_offset())
      chunks.emplace_back(reader.chunk_offset(), count);
    chunks.back().second = count;
  }
  return chunks;
}

TEST(Crc32, HasTheKnownCheckValue) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926u);
  EXPECT_EQ(crc32("6789", crc32("12345")), 0xCBF43926u);
  EXPECT_EQ(crc32(""), 0u);
}

TEST(Mcap, WhatWasWrittenIsRead) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(500);
  write(folder / "a.mcap", messages, 4096);
  McapReader reader(folder / "a.mcap");
  EXPECT_EQ(reader.attachments().at("note.txt"), "an attachment");
  EXPECT_EQ(reader.metadata().at("about").at("key"), "value");
  EXPECT_EQ(read(reader), messages);
  EXPECT_TRUE(reader.complete()) << reader.problem();
  EXPECT_EQ(reader.problem(), "");
  EXPECT_EQ(reader.attachments().at("end.txt"), "the end");
}

TEST(Mcap, OfAttachmentsWithOneNameTheLastThatIsWholeIsFound) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.mcap";
  McapWriter writer(path);
  for (const char* data : {"the first", "the second"}) writer.attach("end.txt", "text/plain", data);
  writer.close();
  EXPECT_EQ(McapChunks(path).attachment("end.txt"), "the second");
  EXPECT_EQ(McapChunks(path).attachment("note.txt"), "");
  for (const auto& [damaged, left] : {std::pair("the second", "the first"), {"the first", ""}}) {
    std::string bytes = contents(path);
    bytes.at(bytes.find(damaged)) ^= '\x20';
    write_file(path, bytes);
    EXPECT_EQ(McapChunks(path).attachment("end.txt"), left);
  }
}

TEST(Mcap, TheSameCallsGiveTheSameBytes) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(300);
  write(folder / "a.mcap", messages, 4096);
  write(folder / "b.mcap", messages, 4096);
  EXPECT_EQ(contents(folder / "a.mcap"), contents(folder / "b.mcap"));
}

TEST(Mcap, AChunkSpansAtMostASecondOfTheLog) {
  const TemporaryFolder folder;
  write(folder / "a.mcap", random_messages(1300), 1 << 30);  // 3.25 s at 400 Hz
  McapReader reader(folder / "a.mcap");
  McapMessage message;
  std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>>
      chunks;  // first and last time by offset
  while (reader.next(message)) {
    auto& [first, last] =
        chunks.try_emplace(reader.chunk_offset(), message.log_time, message.log_time).first->second;
    last = message.log_time;
  }
  EXPECT_EQ(chunks.size(), 4u);
  for (const auto& [offset, times] : chunks) EXPECT_LT(times.second - times.first, 1'000'000'000u);
}

TEST(Mcap, AFileCutOffAnywhereGivesAllItsWholeChunksAndSaysSo) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(200);
  write(folder / "whole.mcap", messages, 2048);
  const std::string whole = contents(folder / "whole.mcap");

  // Where each chunk ends, from the records' lengths alone, and how many messages there are so far.
  std::vector<std::pair<std::size_t, std::size_t>> chunk_ends;
  for (const auto& [start, count] : chunks_of(folder / "whole.mcap")) {
    std::size_t length = 0;
    for (std::size_t i = 8; i > 0; --i)
      length = length << 8 | static_cast<unsigned char>(whole[start + i]);
    chunk_ends.emplace_back(start + 9 + length, count);
  }
  ASSERT_GT(chunk_ends.size(), 10u);

  write_file(folder / "cut.mcap", whole);
  for (std::size_t length = whole.size() - 1; length > 499; length -= 499) {
    std::filesystem::resize_file(folder / "cut.mcap", length);
    McapReader reader(folder / "cut.mcap");
    std::size_t expected = 0;
    for (const auto& [end, count] : chunk_ends) expected = end <= length ? count : expected;
    const std::vector<Message> got = read(reader);
    ASSERT_EQ(got.size(), expected) << "cut at " << length;
    ASSERT_TRUE(std::equal(got.begin(), got.end(), messages.begin()));
    ASSERT_FALSE(reader.complete());
    ASSERT_TRUE(holds(reader.problem(), "cut off"));
  }
}

/// What a disk makes of a file that was being written when the power went.
TEST(Mcap, AnEmptyTailIsNoRecords) {
  const TemporaryFolder folder;
  write(folder / "log.mcap", random_messages(200), 2048);
  const std::string whole = contents(folder / "log.mcap");
  const auto read_of = [&](const std::string& bytes) {
    write_file(folder / "cut.mcap", bytes);
    McapReader reader(folder / "cut.mcap");
    const std::size_t count = read(reader).size();
    return std::pair(count, reader.problem());
  };
  const std::string half = whole.substr(0, whole.size() / 2);
  const auto [count, problem] = read_of(half);
  const auto [count_before_tail, problem_before_tail] = read_of(half + std::string(100000, '\0'));
  EXPECT_GT(count, 50u);
  EXPECT_EQ(count_before_tail, count);
  const std::string cut = "cut off at byte ";
  const std::size_t at = problem_before_tail.find(cut);
  ASSERT_NE(at, std::string::npos) << problem_before_tail;
  const std::size_t byte = std::stoul(problem_before_tail.substr(at + cut.size()));
  EXPECT_LT(byte, half.size() + 2048) << "the chunk that was cut ends in the tail";
}

TEST(Mcap, ADamagedByteIsNeverReadAsAMessage) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(60);
  write(folder / "whole.mcap", messages, 2048);
  const std::string whole = contents(folder / "whole.mcap");
  std::size_t shorter = 0;
  for (std::size_t place = 8; place < whole.size(); place += 251) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
    write_file(folder / "damaged.mcap", damaged);
    McapReader reader(folder / "damaged.mcap");
    // The head of a chunk and the records outside have no checksum; messages have.
    for (const Message& got : read(reader)) {
      ASSERT_NE(std::find(messages.begin(), messages.end(), got), messages.end())
          << "damaged at " << place;
    }
    shorter += reader.complete() ? 0 : 1;
  }
  EXPECT_GT(shorter, 10u);
}

// A byte of a chunk, counted from its head, is another; what stood in the chunk is lost alone.
void expect_one_chunk_lost(std::uint64_t byte) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(200);
  write(folder / "whole.mcap", messages, 2048);
  const std::string whole = contents(folder / "whole.mcap");
  const auto chunks = chunks_of(folder / "whole.mcap");
  ASSERT_GT(chunks.size(), 10u);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    std::string damaged = whole;
    damaged[chunks[i].first + byte] = static_cast<char>(damaged[chunks[i].first + byte] ^ 0x15);
    write_file(folder / "damaged.mcap", damaged);
    std::vector<Message> left = messages;
    const std::size_t first = i == 0 ? 0 : chunks[i - 1].second;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(first),
               left.begin() + static_cast<std::ptrdiff_t>(chunks[i].second));
    McapReader reader(folder / "damaged.mcap");
    ASSERT_EQ(read(reader), left) << "chunk " << i;
    ASSERT_EQ(reader.losses().size(), 1u);
    EXPECT_EQ(reader.losses()[0].offset, chunks[i].first);
    EXPECT_FALSE(reader.complete());
    EXPECT_EQ(reader.attachments().at("end.txt"), "the end");
    const std::string place = " at byte " + std::to_string(chunks[i].first) + " of ";
    EXPECT_TRUE(holds(reader.problem(), place));
  }
}

TEST(Mcap, ADamagedChunkIsLostAloneAlsoTheOneThatDescribesTheChannels) {
  expect_one_chunk_lost(200);
}

TEST(Mcap, ADamagedLengthOfAChunkCostsNothingButThatChunk) {
  for (const std::uint64_t byte : {1u, 2u, 6u}) expect_one_chunk_lost(byte);
}

// Its index, which says where the next chunk is, was cut off as well.
TEST(Mcap, WithoutAnIndexTheChunkBehindADamagedOneIsFoundByItsHead) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(200);
  write(folder / "log.mcap", messages, 2048);
  const auto chunks = chunks_of(folder / "log.mcap");
  std::string bytes = contents(folder / "log.mcap");
  bytes.resize(bytes.size() - 9);
  bytes[chunks[3].first + 2] ^= '\x15';
  write_file(folder / "log.mcap", bytes);
  McapReader reader(folder / "log.mcap");
  EXPECT_EQ(read(reader).size(), messages.size() - (chunks[3].second - chunks[2].second));
}

TEST(Mcap, ChunksWithinAnAttachmentAreNone) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(200);
  write(folder / "inner.mcap", random_messages(50), 2048);
  {
    McapWriter writer(folder / "outer.mcap", {.profile = "test", .library = "test"});
    writer.attach("inner.mcap", "application/octet-stream", contents(folder / "inner.mcap"));
    const auto channel =
        writer.add_channel("/outer", writer.add_schema("Any", "jsonschema", "{}"), "json");
    for (const Message& message : messages) writer.write(channel, message.time, message.data);
    writer.close();
  }
  std::string bytes = contents(folder / "outer.mcap");
  const std::size_t attachment = bytes.find("inner.mcap") - 4 - 16 - 9;
  ASSERT_EQ(bytes[attachment], '\x09');
  bytes[attachment + 6] ^= '\x15';  // of its length
  write_file(folder / "outer.mcap", bytes);
  McapReader reader(folder / "outer.mcap");
  const std::vector<Message> got = read(reader);
  ASSERT_EQ(got.size(), messages.size());
  for (const Message& message : got) ASSERT_EQ(message.topic, "/outer");
  ASSERT_EQ(reader.losses().size(), 1u);
}

TEST(Mcap, ABadSchemaDoesNotKeepTheChannelsBehindItFromBeingLearnt) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(200);
  write(folder / "log.mcap", messages, 2048);
  const auto chunks = chunks_of(folder / "log.mcap");
  std::string bytes = contents(folder / "log.mcap");
  bytes[chunks[0].first + 200] ^= '\x15';                  // which describes the channels
  bytes[bytes.rfind("jsonschema") - 4 - 3 - 1] ^= '\x7F';  // length of the name of their schema
  write_file(folder / "log.mcap", bytes);
  McapReader reader(folder / "log.mcap");
  EXPECT_EQ(read(reader).size(), messages.size() - chunks[0].second);
}

TEST(Mcap, OfAFileWithoutItsEndItIsSaidWhatIsLost) {
  const TemporaryFolder folder;
  write(folder / "log.mcap", random_messages(200), 2048);
  const std::string whole = contents(folder / "log.mcap");
  const auto problem_of = [&](std::size_t length) {
    write_file(folder / "cut.mcap", whole.substr(0, length));
    McapReader reader(folder / "cut.mcap");
    (void)read(reader);
    return reader.problem();
  };
  const std::uint64_t last = chunks_of(folder / "log.mcap").back().first;
  const std::string at_last = "cut off at byte " + std::to_string(last);
  EXPECT_EQ(problem_of(last),
            at_last + ": what came behind it is lost, everything before it was read");
  EXPECT_EQ(problem_of(last + 20), problem_of(last));
  EXPECT_TRUE(holds(problem_of(whole.size() - 1), ", behind all of the run: only the index"));
}

TEST(Mcap, AChunkIsReadAlsoWhereItsOpcodeIsDamaged) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = random_messages(200);
  write(folder / "a.mcap", messages, 2048);
  std::string bytes = contents(folder / "a.mcap");
  for (const auto& [offset, count] : chunks_of(folder / "a.mcap")) bytes[offset] = '\x19';
  write_file(folder / "a.mcap", bytes);
  McapReader reader(folder / "a.mcap");
  EXPECT_EQ(read(reader), messages);
}

TEST(Mcap, FilesThatAreNoneAreRefusedByName) {
  const TemporaryFolder folder;
  write_file(folder / "empty.mcap", "");
  write_file(folder / "foreign.mcap", "%PDF-1.7 something else entirely");
  const auto message = [](const std::string& path) {
    return message_of([&] { McapReader reader(path); });
  };
  EXPECT_EQ(message(folder / "empty.mcap").find(folder / "empty.mcap: the file is empty"), 0u);
  EXPECT_EQ(message(folder / "foreign.mcap").find(folder / "foreign.mcap: not an MCAP file"), 0u);
  EXPECT_EQ(message(folder / "missing.mcap").find(folder / "missing.mcap: no such file"), 0u);
  EXPECT_EQ(message(folder.path()).find(folder.path() + ": is a folder"), 0u);
  EXPECT_TRUE(
      holds(message_of([&] { McapWriter writer(folder / "missing/a.mcap"); }), "missing/a.mcap"));
}

}  // namespace
}  // namespace surefoot::logging
