#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/evaluation/command_judge.hpp"
#include "surefoot/evaluation/contact_loss_judge.hpp"
#include "surefoot/evaluation/effort_judge.hpp"
#include "surefoot/evaluation/estimate_judge.hpp"
#include "surefoot/evaluation/landing.hpp"
#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/evaluation/path_judge.hpp"
#include "surefoot/evaluation/slip_judge.hpp"
#include "surefoot/evaluation/touchdown_judge.hpp"
#include "surefoot/model/belief_frame.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::evaluation {

struct EvaluatorOptions {
  double control_period = 0.0025;  ///< [s]
  double mass = kNaN;              ///< of the robot [kg]; NaN: no friction margin
  Scale scale{};                   ///< of the robot
  TerrainHeight terrain_height;    ///< empty: edge landings are not counted
  /// Hip H in B at joint angles (HAA, HFE, KFE) of a leg; empty: no limb extension.
  std::function<Vec3(Leg, const Vec3&)> hip_in_base;
};

/// End of a run, as the program knows it.
struct RunEnd {
  std::string reason;  ///< replaced after a fall
  double wall_seconds = kNaN;
  std::uint64_t seed = 0;
  std::string version = {};
  std::optional<bool> goal_reached = {};  ///< empty without a goal
};

/// Judges a run tick by tick.
class Evaluator {
 public:
  explicit Evaluator(EvaluatorOptions options)
      : options_(std::move(options)),
        touchdowns_(options_.scale),
        losses_(options_.scale),
        slips_(options_.control_period, options_.scale),
        path_(options_.control_period),
        command_(options_.control_period, options_.scale),
        effort_(options_.control_period, options_.mass, options_.scale) {}

  /// Truth and tick must be of the same time.
  void add(const simulation::GroundTruth& truth, const TickRecord& tick);
  void add(const TickTiming& timing);

  /// True from the tick of the fall on.
  [[nodiscard]] bool fell() const { return metrics_.fell; }
  /// "fell at 3.2025 s: …"; empty without a fall.
  [[nodiscard]] const std::string& fall() const { return fall_; }

  /// Leaves `succeeded` empty: it depends on the criteria.
  [[nodiscard]] Metrics metrics(const RunEnd& end) const;

 private:
  struct Foot {
    bool was_contact = true;
    bool landing_seen = true;  // landing of this stance was judged, or preceded the run
    double slip = 0.0;         // in this stance [m]
    double search = 0.0;       // in this swing [s]
  };
  struct Squares {
    double sum = 0.0;
    int count = 0;
    void add(double value);
    [[nodiscard]] double root_mean() const;
  };

  void judge_plan(const simulation::GroundTruth& truth, const TickRecord& tick);
  void add_off_its_feet(const simulation::GroundTruth& truth, const TickRecord& tick);
  void add_progress(const simulation::GroundTruth& truth, const TickRecord& tick);
  void add_walk(const simulation::GroundTruth& truth, const TickRecord& tick);
  void add_com(const simulation::GroundTruth& truth, const TickRecord& tick);
  void add_torso(const simulation::GroundTruth& truth, const TickRecord& tick);
  void add_frames(const TickRecord& tick);
  void add_reach(const simulation::GroundTruth& truth, const TickRecord& tick);
  void add_foot(Leg leg, const simulation::GroundTruth& truth, const FootPlan& plan);
  void add_stance(Foot& foot, const simulation::TrueContact& contact);
  void add_friction(const simulation::TrueContact& contact, double normal_force);
  void add_body_contacts(const simulation::GroundTruth& truth);
  /// `may_lie`: the robot sits down after a sensor fault, or stands up. `hangs`: lifted, at any
  /// height and tilt, but not with the torso on the ground.
  void check_fall(const simulation::GroundTruth& truth, bool may_lie, bool hangs);

  EvaluatorOptions options_;
  Metrics metrics_;  // those that are final at every tick
  model::BeliefFrame frame_;
  EstimateJudge estimate_;
  TouchdownJudge touchdowns_;
  ContactLossJudge losses_;
  SlipJudge slips_;
  PathJudge path_;
  CommandJudge command_;
  EffortJudge effort_;
  std::string fall_;
  int ticks_ = 0;
  Vec3 start_ = Vec3::Zero(), end_ = Vec3::Zero();            // base
  Vec3 walk_start_ = Vec3::Zero(), walk_end_ = Vec3::Zero();  // base, while walking is commanded
  int walk_ticks_ = 0;
  Squares com_error_, height_error_, orientation_error_;
  double sway_min_ = 0.0, sway_max_ = 0.0;
  std::optional<MotionPlan> plan_before_;  // empty after a restart of the plan
  ReachCommand reach_;                     // of the tick before
  double reach_begin_ = kNaN;              // [s]
  std::array<Foot, kMaxLegs> feet_{};
  double footprint_height_ = kNaN;
  bool torso_touched_ = false;
  int shanks_touched_ = 0;                        // a bit a leg
  std::vector<double> tick_times_, solve_times_;  // [µs]
};

}  // namespace surefoot::evaluation
