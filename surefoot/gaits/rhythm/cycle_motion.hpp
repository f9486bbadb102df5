#pragma once

#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/quintic.hpp"

#include <vector>

namespace surefoot {
struct Scale;
}  // namespace surefoot

namespace surefoot::gaits {

/// How the COM sways and rises in the cycle of a gait, about a point that moves steadily with the
/// robot: a pendulum of height h over the centre of load z of the feet that stand,
///
///     c̈ = (g + ḧ) / h (c − z),
///
/// once around the cycle. Where no foot stands it falls: ḧ = −g, and in the rest of the cycle ḧ is
/// so great that it comes back. Zero for a trot, whose centre of load stays, and which does not
/// fly. A part `pitch` of z's x turns the torso instead, which has a radius of gyration ρ:
///
///     θ̈ = −pitch (g + ḧ) z_x / ρ².
///
/// Without it a pair of hips would bear half of their distance times the weight.
class CycleMotion {
 public:
  CycleMotion(const PlannerOptions& options, const Scale& scale);

  /// At a phase of the cycle, in [0, 1): x and y in heading axes, and the height.
  [[nodiscard]] Motion<Vec3> at(double phase) const;
  [[nodiscard]] Motion<double> pitch_at(double phase) const;

 private:
  std::vector<Motion<Vec3>> samples_;  // even over the cycle
  std::vector<Motion<double>> pitch_;
};

}  // namespace surefoot::gaits
