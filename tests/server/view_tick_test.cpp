#include "server/view_tick.hpp"

#include "surefoot/solver/solution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace surefoot::server {
namespace {

logging::LogHeader header() {
  logging::LogHeader header;
  header.level_names = {"physics", "com_xy", "torque_minimisation"};
  header.level_units = {"N", "m/s²", "N·m"};
  return header;
}

/// A tick whose levels have these residuals and two rows each, and its frame.
struct Tick {
  TickRecord record;
  logged::Hierarchy hierarchy;
  ViewChannels channels = tick_channels(header(), simulation::GroundTruth());

  explicit Tick(std::vector<double> residuals) {
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      logged::Level& level = hierarchy.levels.emplace_back();
      level.name = header().level_names[k];
      level.report.num_rows = 2;
      level.report.residual = residuals[k];
    }
  }

  void solved(solver::SolveStatus status, int failed_level) {
    record.hierarchy.status = hierarchy.status = static_cast<std::int32_t>(status);
    hierarchy.failed_level = failed_level;
  }

  [[nodiscard]] std::string word(const std::string& name) const {
    ViewFrame frame;
    const std::optional<tasks::FrictionCone> cone;
    to_frame({.number = 0, .record = record, .hierarchy = hierarchy, .cone = cone}, channels,
             frame);
    const auto channel = std::ranges::find(channels.channels, name, &ViewChannel::name);
    return channel->values[static_cast<std::size_t>(frame.floats[channel->offset])];
  }

  [[nodiscard]] std::vector<std::string> states() const {
    std::vector<std::string> found;
    for (const std::string& level : channels.level_names)
      found.push_back(word("told.level." + level + ".state"));
    return found;
  }
};

using Words = std::vector<std::string>;

TEST(ViewTick, ALevelGivesWayFromWhatPeopleShouldSeeOn) {
  EXPECT_EQ(Tick({0.4, 0.019, 0.0}).states(), (Words{"met", "met", "minimised"}));
  EXPECT_EQ(Tick({0.6, 0.021, 300.0}).states(), (Words{"gives way", "gives way", "minimised"}));
}

TEST(ViewTick, ALevelThatIsMetMayBeAtALimitAndOneWithoutRowsAsksForNothing) {
  Tick tick({0.0, 0.0, 0.0});
  tick.hierarchy.active = {{.level = "com_xy", .row = "x", .id = 0, .state = 1, .by = 0.0}};
  tick.hierarchy.levels[0].report.num_rows = 0;
  EXPECT_EQ(tick.states(), (Words{"no rows", "at limit", "minimised"}));
}

TEST(ViewTick, OfASolveThatWasCutOffNothingIsToldOfTheLevelItWasInAndThoseBelow) {
  Tick tick({0.0, 7.0, 7.0});
  tick.solved(solver::SolveStatus::iteration_cap, 1);
  EXPECT_EQ(tick.states(), (Words{"met", "not solved", "not solved"}));
  tick.solved(solver::SolveStatus::iteration_cap, 3);
  EXPECT_EQ(tick.states(), (Words{"met", "gives way", "minimised"}))
      << "only x is not the shortest";
  EXPECT_EQ(tick.word("told.unused"), "");
}

TEST(ViewTick, OfASolutionThatCommandsNothingNoLevelIsToldAndWhy) {
  Tick tick({0.0, 7.0, 7.0});
  tick.record.command.mode = CommandMode::damping;
  tick.record.command.cause = StopCause::tilt;
  EXPECT_EQ(tick.states(), Words(3, "not solved"));
  EXPECT_EQ(tick.word("told.unused"), "The controller stopped, and what was solved was not used");
  EXPECT_EQ(tick.word("told.because"), "the torso tilted too far");
  tick.solved(solver::SolveStatus::invalid_input, -1);
  EXPECT_EQ(tick.word("told.unused"), "No hierarchy was solved");
  tick.record.command = {};
  tick.record.command.mode = CommandMode::rise;
  EXPECT_EQ(tick.word("told.because"), "it stands up");
}

}  // namespace
}  // namespace surefoot::server
