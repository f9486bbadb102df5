#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <string>
#include <vector>

namespace surefoot::closed_loop {

/// Count of a fault of a sensor, of a safe command mode or of a vain command, in a run.
struct TroubleCount {
  std::string what;    ///< "IMU stopped", "command mode: sit", "arm 0: can't get to its target"
  int count = 0;       ///< number of times that it began
  double first = 0.0;  ///< time of its first begin [s]
};

/// Counts, tick by tick, faults of sensors that had given a good sample before, and the modes of
/// the safety ladder that end a walk; also commands to reach that are in vain: the arm or frame is
/// not there, or its reference has come to the target and after 1 s it is still 3 cm off, at
/// scale 1.
class TroubleCounter {
 public:
  /// Throws Error where `RobotModel` does.
  explicit TroubleCounter(const model::RobotDescription& robot);

  void add(double time, const TickRecord& record, const simulation::GroundTruth& truth);

  /// In the order of their first times.
  [[nodiscard]] const std::vector<TroubleCount>& counts() const { return counts_; }

 private:
  /// Where an arm's tip or a frame is, in truth, and where it is planned to be, in B; or why it is
  /// nowhere.
  struct Reach {
    std::string name;
    Vec3 is = Vec3::Constant(kNaN), planned = Vec3::Constant(kNaN);
    std::string why_not{};
  };

  [[nodiscard]] Reach arm_reach(const TickRecord& record,
                                const simulation::GroundTruth& truth) const;
  [[nodiscard]] Reach frame_reach(const TickRecord& record, const simulation::GroundTruth& truth);
  [[nodiscard]] std::string vain_reach(const TickRecord& record,
                                       const simulation::GroundTruth& truth);

  std::vector<std::string> joints_;
  Scale scale_;
  model::RobotModel model_;
  model::Frames frames_;
  std::vector<std::string> before_;
  double off_since_ = kNaN;  // how long it has been off a target that the plan came to [s]
  std::vector<TroubleCount> counts_;
};

}  // namespace surefoot::closed_loop
