#pragma once

#include "surefoot/evaluation/evaluator.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace surefoot::test {

inline constexpr double kPeriod = 0.0025;
inline constexpr double kMass = 30.0;  // a tenth of its weight is 29.43 N

/// A run made by hand: each test changes what it is about and calls `tick`.
struct HandMadeRun {
  HandMadeRun()
      : HandMadeRun(
            {.control_period = kPeriod, .mass = kMass, .terrain_height = {}, .hip_in_base = {}}) {}
  explicit HandMadeRun(evaluation::EvaluatorOptions options) : evaluator(std::move(options)) {
    stand();
  }

  void stand() {
    truth.p_SB.z() = 0.45;
    for (simulation::TrueContact& contact : truth.feet) {
      contact = {.touching = true, .force = Vec3(0.0, 0.0, 75.0), .friction = 0.8};
    }
    tick.plan.torso.height = 0.45;
    tick.command.mode = CommandMode::optimal;
  }

  void step() {
    evaluator.add(truth, tick);
    truth.time += kPeriod;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }

  [[nodiscard]] evaluation::Metrics metrics() const {
    return evaluator.metrics(
        {.reason = "completed", .wall_seconds = 0.5, .seed = 9, .version = "1.2.3"});
  }

  void phase(Leg leg, LegPhase phase) { tick.plan.feet[index(leg)].phase = phase; }
  simulation::TrueContact& contact(Leg leg) { return truth.feet[index(leg)]; }

  evaluation::Evaluator evaluator;
  simulation::GroundTruth truth;
  TickRecord tick;
};

}  // namespace surefoot::test
