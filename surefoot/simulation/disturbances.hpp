#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

/// Changes masses in the spec without the controller's knowledge: scales, an offset of the base's
/// centre of mass, a payload. Links fixed to the base count as base, the others as legs.
void disturb_masses(mjsBody& base, const model::RobotDescription& description,
                    const DisturbanceOptions& options);

/// The hand of a `Lift`. It starts at the point's position at the start of the lift, and ends below
/// it, so that it carries nothing when it lets go.
class Hand {
 public:
  /// `scale` of the robot.
  Hand(const Lift& lift, const Scale& scale) : lift_(lift), scale_(scale) {}

  /// Its force [N] on the point at p_W [m], which moves at v_W [m/s], at a time [s].
  [[nodiscard]] Vec3 force(double time, const Vec3& p_W, const Vec3& v_W) noexcept;
  [[nodiscard]] const Vec3& point() const { return lift_.point; }

 private:
  [[nodiscard]] double height(double time) const;

  Lift lift_;
  Scale scale_;
  Vec3 begin_ = Vec3::Constant(kNaN);  // start position [m]
};

/// Pushes and lifts. A push acts at the centre of mass of its link, or at the origin of a
/// base link whose own inertia was ignored.
class Pushes {
 public:
  /// `scale` of the robot. Throws UnknownNameError, listing the robot's links, for an unknown body.
  Pushes(const DisturbanceOptions& disturbances, const mjModel& model, const std::string& base_link,
         const Scale& scale);

  /// Adds a push, and discards those that ended long before `time` [s], which is now. Throws as the
  /// constructor.
  void add(const Push& push, double time);
  /// Names of the bodies that can be pushed.
  [[nodiscard]] std::vector<std::string> bodies() const;

  /// Sets the external forces of the next physics step. A push that covers part of the step acts
  /// with that share, so that its impulse is exact.
  void apply(double timestep, mjData& data) noexcept;

 private:
  struct Force {
    Push push;
    int body;
  };

  void lift(Hand& hand, mjData& data) const noexcept;
  [[nodiscard]] int body_of(const std::string& body, const std::string& key) const;

  const mjModel& model_;
  std::string base_link_;
  std::vector<Force> forces_;
  std::vector<Hand> hands_;
  int base_ = -1;
};

}  // namespace surefoot::simulation
