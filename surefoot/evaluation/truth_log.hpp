#pragma once

#include "surefoot/logging/recorder.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot::evaluation {

/// The log's channel `/truth`: simulator state unknown to the controller, with MuJoCo's qpos, qvel,
/// ctrl and xfrc_applied, so that stock MuJoCo can show and check the run.
class TruthLog {
 public:
  /// Adds the channel; call before the recorder's first tick.
  explicit TruthLog(logging::Recorder& recorder);

  void record(const simulation::GroundTruth& truth);

 private:
  logging::Recorder& recorder_;
  logging::Recorder::Channel channel_;
};

}  // namespace surefoot::evaluation
