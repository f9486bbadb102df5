#include "surefoot/evaluation/truth_log.hpp"

#include "surefoot/logging/mcap_reader.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace surefoot::evaluation {
namespace {

using nlohmann::json;

TEST(TruthLog, TheTruthStandsOnAChannelOfItsOwnBitByBit) {
  const test::TemporaryFolder folder;
  std::vector<simulation::GroundTruth> truths;
  {
    logging::Recorder recorder(folder / "run.mcap", test::SyntheticRun::header());
    TruthLog log(recorder);
    test::SyntheticRun run;
    for (int i = 0; i < 500; ++i) {
      run.step();
      log.record(run.truth, run.tick);
      recorder.record(run.tick);
      truths.push_back(run.truth);
    }
    recorder.close();
  }
  logging::McapReader reader(folder / "run.mcap");
  logging::McapMessage message;
  std::size_t count = 0;
  while (reader.next(message)) {
    if (message.channel->topic != "/truth") continue;
    const simulation::GroundTruth& truth = truths.at(count++);
    const json logged = json::parse(message.data);
    ASSERT_EQ(logged.at("time"), truth.time);
    ASSERT_EQ(logged.at("q_SB"),
              json({truth.q_SB.w(), truth.q_SB.x(), truth.q_SB.y(), truth.q_SB.z()}));
    ASSERT_EQ(logged.at("qpos"), json(truth.qpos));
    ASSERT_EQ(logged.at("qvel"), json(truth.qvel));
    ASSERT_EQ(logged.at("ctrl"), json(truth.ctrl));
    ASSERT_EQ(logged.at("xfrc_applied"), json(truth.xfrc_applied));
    const simulation::TrueContact& contact = truth.feet[index(Leg::RH)];
    ASSERT_EQ(logged.at("feet").at("RH").at("force"),
              json({contact.force.x(), contact.force.y(), contact.force.z()}));
    ASSERT_EQ(logged.at("feet").at("RH").at("touching"), contact.touching);
  }
  EXPECT_EQ(count, 500u);
}

}  // namespace
}  // namespace surefoot::evaluation
