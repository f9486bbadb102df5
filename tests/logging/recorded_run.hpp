#pragma once

#include "surefoot/base/error.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/message_codec.hpp"
#include "surefoot/logging/recorder.hpp"
#include "tests/logging/synthetic_run.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <string>
#include <vector>

namespace surefoot::test {

/// Records `ticks` of a synthetic run; the wall-clock times are slower by `delay`.
inline std::vector<TickRecord> record(const std::string& path, int ticks, double delay = 0.0,
                                      logging::RecorderOptions options = {}) {
  logging::Recorder recorder(path, SyntheticRun::header(), options);
  SyntheticRun run(3, 0.5);
  std::vector<TickRecord> recorded;
  for (int i = 0; i < ticks; ++i) {
    run.step();
    recorder.record(run.tick);
    run.timing.total += delay;
    recorder.record(run.timing);
    recorded.push_back(run.tick);
  }
  recorder.close(R"({"metrics":{}})");
  return recorded;
}

/// Equal bit by bit, as the log has it: the encoder visits every field.
template <typename T>
std::string bits(const T& signal) {
  std::string out;
  logged::encode(signal, out);
  return out;
}

inline void expect_same_blockers(const HierarchyReport& a, const HierarchyReport& b) {
  ASSERT_EQ(a.failed_level, b.failed_level);
  ASSERT_EQ(a.borderline, b.borderline);
  ASSERT_EQ(a.blocking_is_known, b.blocking_is_known);
  ASSERT_EQ(a.num_blocking, b.num_blocking);
  ASSERT_EQ(a.transition_share, b.transition_share);
  ASSERT_EQ(a.level_switch.begins, b.level_switch.begins);
  ASSERT_EQ(a.level_switch.duration, b.level_switch.duration);
  ASSERT_EQ(a.level_switch.change, b.level_switch.change);
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.num_blocking); ++i) {
    const BlockingRow &x = a.blocking[i], &y = b.blocking[i];
    ASSERT_EQ(x.level, y.level);
    ASSERT_EQ(x.by_level, y.by_level);
    ASSERT_EQ(x.id, y.id);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(x.cost), std::bit_cast<std::uint64_t>(y.cost));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(x.multiplier),
              std::bit_cast<std::uint64_t>(y.multiplier));
  }
}

inline void expect_same(const TickRecord& a, const TickRecord& b) {
  ASSERT_EQ(bits(a.reading), bits(b.reading));
  ASSERT_EQ(bits(a.user), bits(b.user));
  ASSERT_EQ(bits(a.state), bits(b.state));
  ASSERT_EQ(bits(a.plan), bits(b.plan));
  ASSERT_EQ(bits(a.model), bits(b.model));
  ASSERT_EQ(bits(a.command), bits(b.command));
  ASSERT_EQ(a.hierarchy.num_levels, b.hierarchy.num_levels);
  ASSERT_EQ(a.hierarchy.num_active, b.hierarchy.num_active);
  for (std::size_t i = 0; i < kMaxLevels; ++i) {
    const LevelReport &x = a.hierarchy.levels[i], &y = b.hierarchy.levels[i];
    ASSERT_EQ(std::bit_cast<std::uint64_t>(x.residual), std::bit_cast<std::uint64_t>(y.residual));
    ASSERT_EQ(x.num_active, y.num_active);
    ASSERT_EQ(x.degrees_of_freedom_left, y.degrees_of_freedom_left);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.hierarchy.num_active); ++i) {
    ASSERT_EQ(a.hierarchy.active[i].level, b.hierarchy.active[i].level);
    ASSERT_EQ(a.hierarchy.active[i].id, b.hierarchy.active[i].id);
    ASSERT_EQ(a.hierarchy.active[i].state, b.hierarchy.active[i].state);
    ASSERT_EQ(a.hierarchy.active[i].by, b.hierarchy.active[i].by);
  }
  ASSERT_EQ(a.hierarchy.num_missed, b.hierarchy.num_missed);
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.hierarchy.num_missed); ++i) {
    ASSERT_EQ(a.hierarchy.missed[i].level, b.hierarchy.missed[i].level);
    ASSERT_EQ(a.hierarchy.missed[i].id, b.hierarchy.missed[i].id);
    ASSERT_EQ(a.hierarchy.missed[i].by, b.hierarchy.missed[i].by);
  }
  expect_same_blockers(a.hierarchy, b.hierarchy);
}

/// Number of ticks that a log gives before its end.
inline int ticks_in(logging::LogReader& log) {
  TickRecord tick;
  int count = 0;
  while (log.next(tick)) ++count;
  return count;
}

inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace surefoot::test
