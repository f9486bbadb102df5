#pragma once

#include "surefoot/evaluation/alignment.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot::evaluation {

/// The log's channel `/truth`: simulator state unknown to the controller, with MuJoCo's qpos, qvel,
/// ctrl and xfrc_applied, so that stock MuJoCo can show and check the run. And `/alignment`: how
/// its world lies to the controller's.
class TruthLog {
 public:
  /// Adds the channels; call before the recorder's first tick.
  explicit TruthLog(logging::Recorder& recorder);

  /// Truth and tick must be of the same time.
  void record(const simulation::GroundTruth& truth, const TickRecord& tick);

 private:
  logging::Recorder& recorder_;
  logging::Recorder::Channel truth_, alignment_;
  Aligner aligner_;
};

}  // namespace surefoot::evaluation
