#include "server/log_content.hpp"

#include "surefoot/logging/log_reader.hpp"
#include "tests/cli/damaged_log.hpp"
#include "tests/support/messages.hpp"

#include <array>
#include <cstring>

namespace surefoot::server {
namespace {

using nlohmann::json;
using test::DamagedLog;
using test::holds;
using test::kTicks;
using test::SyntheticRun;

TEST_F(DamagedLog, a_whole_one_has_no_damage_and_all_its_ticks) {
  LogContent content(path());
  EXPECT_EQ(session(content).at("start"), content.start());
  EXPECT_NE(content.start(), LogContent(path()).start()) << "each start has its own";
  const json session = whole_session(content);
  EXPECT_EQ(session.at("ticks"), kTicks);
  EXPECT_EQ(session.at("damage"), json::array());
  EXPECT_EQ(frames(content, 0, kTicks).size(), kTicks);
  EXPECT_EQ(marks_of_damage(content), 0u);
}

TEST_F(DamagedLog, a_tick_is_explained_once_it_was_asked_for) {
  record(400);
  LogContent content(path());
  const auto ask = [&](const std::string& tick) {
    return content.get("/api/explain", {{"tick", tick}});
  };
  WebAnswer answer = ask("150");
  EXPECT_EQ(answer.status, 202) << "it takes its time";
  (void)ask("250");
  for (int i = 0; answer.status == 202 && i < 1000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    answer = ask("150");
  }
  ASSERT_EQ(answer.status, 200);
  const json told = json::parse(answer.body);
  EXPECT_NEAR(told.at("time"), 150 * SyntheticRun::header().control_period, 1e-9);
  EXPECT_FALSE(told.at("sentence").get<std::string>().empty());
  for (const char* wrong : {"-1", "400", "x", "1e2", ""}) {
    EXPECT_EQ(ask(wrong).status, 400) << wrong;
    EXPECT_TRUE(holds(ask(wrong).body, "0 to 399"));
  }
  EXPECT_EQ(content.get("/api/explain", {}).status, 400);
}

TEST_F(DamagedLog, why_a_run_does_not_end_where_it_should_is_told) {
  const std::string unknown =
      "how the run ended is not known: the log's file is whole, but has no summary";
  const auto end = [](const std::string& reason) {
    return R"({"metrics":{"reason":)" + reason + R"(},"criteria":[]})";
  };
  const std::string whole = ": the log's file is whole, and ends there";
  const std::vector<std::array<std::string, 3>> cases{
      {end(R"("fell")"), "", "fell"},
      {end(R"("interrupted")"), "the run was interrupted" + whole, "interrupted"},
      {end(R"("begun again")"), "the run was begun again" + whole, "begun again"},
      {end("null"), unknown, ""},
      {R"({"metrics":{},"criteria":{"fell":true}})", unknown, ""},
      {"{}", unknown, ""},
      {"", unknown, ""}};  // the program ended in an exception
  for (const auto& [summary, cut, ended] : cases) {
    SCOPED_TRACE(summary);
    record(400, "", 0, summary);
    LogContent content(summary.empty() ? path() + ".partial" : path());
    const json session = whole_session(content);
    EXPECT_EQ(session.at("cut"), cut);
    EXPECT_EQ(session.at("ended"), ended);
    EXPECT_EQ(std::ranges::count(content.notes(), cut), cut.empty() ? 0 : 1);
    EXPECT_EQ(marks_of_damage(content), 0u);
  }
}

TEST_F(DamagedLog, a_log_that_was_not_closed_says_so_and_has_a_mark_at_its_end) {
  const std::string bytes = test::contents(path());
  test::write_file(path(), bytes.substr(0, bytes.size() / 2));
  LogContent content(path());
  const json session = whole_session(content);
  logging::LogReader reader(path());
  TickRecord tick;
  while (reader.next(tick)) {
  }
  EXPECT_TRUE(reader.problem().starts_with("cut off at byte ")) << reader.problem();
  const std::string byte = std::to_string(std::stoul(reader.problem().substr(16)));
  EXPECT_EQ(session.at("cut"), "the log was never closed, or is cut off (at byte " + byte +
                                   "): what is left of it is shown");
  const json events = json::parse(content.get("/api/events", {}).body);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().at("kind"), "damage");
  const double last = 0.0025 * (session.at("ticks").get<int>() - 1);
  EXPECT_NEAR(events.back().at("time").get<double>(), last, 1e-9);
}

TEST_F(DamagedLog, a_damaged_chunk_costs_its_ticks_and_is_told) {
  damage(2);
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(session.at("ticks"), kTicks);
  ASSERT_EQ(session.at("damage").size(), 1u) << session.at("damage");
  EXPECT_TRUE(holds(session.at("damage")[0].get<std::string>(), "can't be read"));
  EXPECT_FALSE(holds(session.at("damage")[0].get<std::string>(), path()));
  EXPECT_EQ(marks_of_damage(content), 1u);
  const std::size_t left = frames(content, 0, kTicks).size();
  EXPECT_LT(left, kTicks);
  EXPECT_GT(left, kTicks / 2);
}

TEST_F(DamagedLog, also_where_it_is_the_first_that_describes_the_channels) {
  damage(0);
  LogContent content(path());
  EXPECT_EQ(whole_session(content).at("damage").size(), 1u);
  const auto read = frames(content, 0, kTicks);
  ASSERT_FALSE(read.empty());
  EXPECT_GT(read.size(), kTicks / 2);
  EXPECT_GT(read.front().tick, 0u);
}

TEST_F(DamagedLog, one_whose_clock_begins_late_begins_there) {
  constexpr int kFirst = 700;
  record(6000, "", kFirst);
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(session.at("first_tick"), kFirst);
  EXPECT_EQ(session.at("ticks"), 6000 - kFirst);
  EXPECT_EQ(session.at("damage"), json::array());
  const auto read = frames(content, kFirst, 4096);
  ASSERT_EQ(read.size(), 4096u);
  EXPECT_EQ(read.front().tick, kFirst);
  EXPECT_EQ(read.front().time, SyntheticRun::kPeriod * kFirst);
  const auto coarse = frames(content, kFirst, 512, 12);
  ASSERT_EQ(coarse.size(), (6000u - kFirst + 63) / 64);
  EXPECT_EQ(coarse.front().tick, kFirst);
  EXPECT_EQ(frames(content, kFirst, 512, 32, true).size(), 2u * ((6000 - kFirst + 31) / 32));
}

TEST_F(DamagedLog, damaged_timings_cost_no_tick) {
  damage(logging::McapChunks(path()).chunks().size() - 1);
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(frames(content, 0, kTicks).size(), kTicks);
  ASSERT_GE(session.at("damage").size(), 1u);
  EXPECT_EQ(session.at("damage")[0].get<std::string>().find("timings of"), 0u);
}

TEST_F(DamagedLog, a_chunk_whose_times_are_wrong_is_found_by_its_messages) {
  damage(2, 15);  // of its first time
  LogContent content(path());
  EXPECT_EQ(whole_session(content).at("damage").size(), 0u);
  EXPECT_EQ(frames(content, 0, kTicks).size(), kTicks);
}

TEST_F(DamagedLog, one_that_another_writer_put_into_one_long_chunk_has_all_its_ticks) {
  record(4800);  // 12 s
  const std::string rewritten = folder_ / "one_chunk.mcap";
  {
    logging::McapWriter writer(
        rewritten, {.profile = "", .chunk_bytes = 1U << 30U, .chunk_nanoseconds = UINT64_MAX / 2});
    const logging::McapReader source(path());
    for (const auto& [name, data] : source.attachments())
      writer.attach(name, "application/json", data);
    std::map<std::string, std::uint16_t> channels;
    for (const auto& [topic, data, time] : messages()) {
      if (!channels.contains(topic))
        channels[topic] =
            writer.add_channel(topic, writer.add_schema(topic, "jsonschema", "{}"), "json");
      writer.write(channels[topic], time, data);
    }
    writer.close();
  }
  ASSERT_EQ(logging::McapChunks(rewritten).chunks().size(), 1u);
  LogContent content(rewritten);
  EXPECT_EQ(session(content).at("ticks"), 4800);
  EXPECT_EQ(frames(content, 800, 4000).size(), 4000u);
}

TEST_F(DamagedLog, a_message_that_is_no_signal_costs_its_tick_and_no_more) {
  const std::string changed = with_broken_message("/state", 0, messages());
  LogContent content(changed);
  EXPECT_EQ(whole_session(content).at("damage").size(), 1u);
  const auto read = frames(content, 0, kTicks);
  EXPECT_EQ(read.size(), kTicks - 1);
  EXPECT_EQ(read.front().tick, 1u);
}

TEST_F(DamagedLog, timings_that_are_none_cost_no_tick_that_stands_in_their_chunk) {
  std::vector<Message> mixed = messages();
  std::ranges::stable_sort(mixed, {}, &Message::time);
  LogContent content(with_broken_message("/timings", kTicks / 2, mixed));
  const json session = whole_session(content);
  EXPECT_EQ(frames(content, 0, kTicks).size(), kTicks);
  ASSERT_EQ(session.at("damage").size(), 1u) << session.at("damage");
  EXPECT_EQ(session.at("damage")[0].get<std::string>().find("timings of"), 0u);
}

TEST_F(DamagedLog, a_tick_of_which_a_part_is_lost_is_lost) {
  LogContent whole(path());
  const auto all = frames(whole, 0, kTicks);
  ASSERT_EQ(all.size(), kTicks);
  const std::vector<logging::McapChunk> chunks = logging::McapChunks(path()).chunks();
  std::size_t end = 1;  // behind the ticks, where the timings begin
  while (chunks.at(end).first_time >= chunks[end - 1].first_time) ++end;
  ASSERT_GT(end, 5u);
  for (std::size_t chunk = 1; chunk < end; ++chunk) {
    damage(chunk);
    LogContent content(path());
    for (const ViewFrame& frame : frames(content, 0, kTicks)) {
      const std::vector<float>& floats = all.at(frame.tick).floats;
      ASSERT_EQ(frame.floats.size(), floats.size());
      const std::size_t size = floats.size() * sizeof(float);
      ASSERT_EQ(std::memcmp(frame.floats.data(), floats.data(), size), 0)
          << "tick " << frame.tick << " beside chunk " << chunk;
    }
    damage(chunk);  // as it was
  }
}

TEST_F(DamagedLog, a_change_whose_stack_is_no_yaml_is_told) {
  record(1200, "levels: [\n  {name: a");
  LogContent content(path());
  const json session = whole_session(content);
  ASSERT_EQ(session.at("damage").size(), 1u);
  EXPECT_TRUE(holds(session.at("damage")[0].get<std::string>(), "order of the levels"));
  EXPECT_EQ(session.at("orders").size(), 1u);
}

TEST_F(DamagedLog, nothing_that_can_be_read_is_refused_with_what_to_do) {
  const std::size_t all = logging::McapChunks(path()).chunks().size();
  for (std::size_t i = 0; i < all; ++i) damage(i);
  EXPECT_TRUE(
      holds(test::message_of([&] { const LogContent content(path()); }), "record the run anew"));
}

TEST_F(DamagedLog, long_strides_are_answered_from_the_summary_at_once) {
  record(6000);
  LogContent content(path());
  EXPECT_EQ(whole_session(content).at("ticks"), 6000);
  const auto coarse = frames(content, 0, 512, 12);
  ASSERT_EQ(coarse.size(), (6000u + 63) / 64);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const auto fine = frames(content, coarse[i].tick, 1);
    ASSERT_EQ(fine.size(), 1u);
    EXPECT_EQ(fine[0].tick, 64 * i);
    EXPECT_EQ(fine[0].active.size(), coarse[i].active.size());
  }
  EXPECT_EQ(frames(content, 0, 4096).size(), 4096u);
  EXPECT_EQ(frames(content, 0, 512, 32, true).size(), 2u * ((6000 + 31) / 32));
}

}  // namespace
}  // namespace surefoot::server
