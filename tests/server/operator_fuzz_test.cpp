#include "server/live_feed.hpp"
#include "server/log_content.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/logging/recorder.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/server/live_test_run.hpp"
#include "tests/support/damaged_bytes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace surefoot::server {
namespace {

/// A message of every type, each once as a page sends it.
std::vector<std::string> good_messages() {
  const auto message = [](const std::string& members) {
    return R"({"id":1,"token":"t",)" + members + "}";
  };
  return {
      message(R"("type":"pause")"),
      message(R"("type":"resume")"),
      message(R"("type":"step","ticks":3)"),
      message(R"("type":"speed","factor":4)"),
      message(R"("type":"push","body":"base","impulse":[0,20,0],"duration":0.2)"),
      message(R"("type":"walk","walk":true,"velocity":[0.1,0.05],"yaw_rate":0.1,"height":-0.02)"),
      message(R"("type":"walk","by":"scenario")"),
      message(R"("type":"gain","level":"com_xy","task":"com_xy","name":"kp","value":150)"),
      message(R"("type":"order","levels":["equations_of_motion","torque_limits"])"),
      message(R"("type":"friction","value":0.4)"),
  };
}

bool is_within(const OperatorWishes& wishes, const ViewLimits& limits) {
  const auto is_force = [&](const Vec3& force) {
    return force.norm() <= limits.push_force * (1.0 + 1e-9);
  };
  bool good = wishes.speed >= limits.slowest && wishes.speed <= limits.fastest &&
              wishes.steps >= 0 && wishes.steps <= 4000 &&
              wishes.control.friction >= limits.friction_min &&
              wishes.control.friction <= limits.friction_max;
  for (const simulation::Push& push : wishes.pushes) {
    good = good && is_force(push.force) && push.duration > 0.0 &&
           push.duration <= limits.push_duration;
  }
  if (wishes.walk) {
    good = good && wishes.walk->velocity.cwiseAbs().maxCoeff() <= limits.walk_velocity &&
           std::abs(wishes.walk->yaw_rate) <= limits.walk_yaw_rate &&
           std::abs(wishes.walk->height) <= limits.walk_height;
  }
  return good;
}

TEST(OperatorFuzz, whatever_a_page_says_what_is_wanted_of_the_run_stays_within_the_limits) {
  const ViewLimits limits;
  LiveOperator wishes(config::load_scenario({"walk_flat_ideal", 0, {"stack=terrain_adaptation"}}),
                      limits);
  wishes.begin({"base", "LF_SHANK"});
  const std::vector<std::string> messages = good_messages();
  std::mt19937 random(13);
  OperatorWishes wanted;
  int understood = 0, taken = 0;
  for (int trial = 0; trial < test::trials(6000); ++trial) {
    const std::string& good = messages[random() % messages.size()];
    const ViewMessage message = read_message(test::damaged_values(good, random));
    if (!message.error.empty()) continue;
    ++understood;
    taken += wishes.command(message.command).empty() ? 1 : 0;
    if (wishes.take(wanted)) {
      ASSERT_TRUE(is_within(wanted, limits)) << trial;
    }
  }
  EXPECT_GT(understood, 1000) << "they come as far as the operator";
  EXPECT_GT(taken, 300);
  EXPECT_LT(taken, understood);
}

TEST(OperatorFuzz, a_run_that_is_asked_for_anything_goes_on_within_the_limits) {
  test::LiveTestRun run({"duration=2"});
  const std::vector<std::string> messages = good_messages();
  std::mt19937 random(14);
  for (long tick = 20; tick < 780; tick += 3) {
    run.at(tick, [&] {
      const std::string text = test::damaged_values(messages[random() % messages.size()], random);
      const ViewMessage message = read_message(text);
      if (message.error.empty()) (void)run.feed.command(message.command);
      (void)run.feed.status(3);
      (void)run.wishes.command({.type = ViewCommandType::resume});
      (void)run.wishes.command({.type = ViewCommandType::speed, .factor = 8.0});
    });
  }
  const closed_loop::RunResult result = run.run();
  EXPECT_NE(result.ending, closed_loop::Ending::reset);
  const std::vector<double> x = run.of("truth.xfrc_applied", 6),
                            y = run.of("truth.xfrc_applied", 7);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_LE(std::hypot(x[i], y[i]), 300.0 + 1e-3) << i;
}

TEST(LogContentFuzz, requests_that_make_no_sense_get_an_answer) {
  const test::TemporaryFolder folder;
  {
    logging::Recorder recorder(folder / "run.mcap", test::SyntheticRun::header());
    test::SyntheticRun synthetic(3);
    for (int i = 0; i < 600; ++i) {
      synthetic.step();
      recorder.record(synthetic.tick);
    }
    recorder.close();
  }
  LogContent content(folder / "run.mcap");
  std::mt19937 random(15);
  const std::vector<std::string> paths{"/api/session", "/api/events", "/api/frames", "/api/mesh/0",
                                       "/api/robot.urdf"};
  const std::vector<std::string> numbers{"0",
                                         "1",
                                         "599",
                                         "600",
                                         "4096",
                                         "4097",
                                         "1073741823",
                                         "2147483647",
                                         "2147483648",
                                         "4294967295",
                                         "18446744073709551616",
                                         "-1",
                                         "",
                                         "1e3",
                                         " 1",
                                         "nan"};
  int answered = 0;
  for (int trial = 0; trial < test::trials(1500); ++trial) {
    WebContent::Query query;
    for (const char* key : {"from", "count", "stride", "min_max"}) {
      std::string value = numbers[random() % numbers.size()];
      if (random() % 8 == 0) value = test::damaged(value + "17", random);
      if (random() % 3 != 0) query[key] = value;
    }
    std::string path = paths[random() % paths.size()];
    if (random() % 4 == 0) path = test::damaged(path, random);
    const WebAnswer answer = content.get(path, query);
    ASSERT_TRUE(answer.status == 200 || answer.status == 400 || answer.status == 404)
        << path << " " << answer.status;
    answered += answer.status == 200 ? 1 : 0;
  }
  EXPECT_GT(answered, 200);
}

TEST(LogContentFuzz, a_log_whose_bytes_make_no_sense_is_shown_or_refused) {
  const test::TemporaryFolder folder;
  {
    logging::Recorder recorder(folder / "good.mcap", test::SyntheticRun::header());
    test::SyntheticRun synthetic(4);
    for (int i = 0; i < 30; ++i) {
      synthetic.step();
      recorder.record(synthetic.tick);
      recorder.record(synthetic.timing);
    }
    recorder.close();
  }
  const std::string good = test::contents(folder / "good.mcap");
  std::mt19937 random(16);
  int shown = 0, refused = 0;
  for (int trial = 0; trial < test::trials(150); ++trial) {
    const std::string path = folder / "bad.mcap";
    test::write_file(path, test::damaged(good, random));
    try {
      LogContent content(path);
      EXPECT_EQ(content.get("/api/session", {}).status, 200);
      EXPECT_EQ(content.get("/api/frames", {{"from", "0"}, {"count", "64"}}).status, 200);
      ++shown;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "");
      ++refused;
    }
  }
  EXPECT_GT(shown, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace surefoot::server
