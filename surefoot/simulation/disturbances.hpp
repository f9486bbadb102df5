#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

/// Gives the robot in the spec masses that the controller's model does not know: scales, an offset
/// of the base's centre of mass, a payload. What is fixed to the base link counts as base, the rest
/// as legs.
void disturb_masses(mjsBody& base, const RobotDescription& description,
                    const DisturbanceOptions& options);

/// The hand of a `Lift`. It begins where the point is at the start of the lift, and comes down
/// deeper than that by a slack, so that it holds nothing when it lets go.
class Hand {
 public:
  explicit Hand(const Lift& lift) : lift_(lift) {}

  /// Its force on the point, which is at p_W and moves by v_W, at a time: [m], [m/s], [s], [N].
  [[nodiscard]] Vec3 force(double time, const Vec3& p_W, const Vec3& v_W) noexcept;
  [[nodiscard]] const Vec3& point() const { return lift_.point; }

 private:
  [[nodiscard]] double height(double time) const;

  Lift lift_;
  Vec3 begin_ = Vec3::Constant(kNaN);  // where it took hold [m]
};

/// Pushes by their time, and what lifts and pulls beside them. A push acts at the centre of mass of
/// the link it is given for; at the origin of the base link if that link's own inertia was dropped.
class Pushes {
 public:
  /// Throws UnknownNameError, with the robot's links, for a body that does not exist.
  Pushes(const DisturbanceOptions& disturbances, const mjModel& model,
         const std::string& base_link);

  /// One more; those that are long over at `time` [s], which is now, are forgotten. Throws as the
  /// constructor.
  void add(const Push& push, double time);
  /// In the place of what pulled before. Throws as the constructor.
  void set(const Pull& pull);
  /// What there is to push, by name.
  [[nodiscard]] std::vector<std::string> bodies() const;

  /// Sets the external forces of the physics step that comes: a push that covers only a part of the
  /// step acts with that share, so that its impulse is exact.
  void apply(double timestep, mjData& data) noexcept;

 private:
  struct Force {
    Push push;
    int body;
  };

  void lift(Hand& hand, mjData& data) const noexcept;
  void apply_pull(mjData& data) const noexcept;
  [[nodiscard]] int body_of(const std::string& body, const std::string& key) const;

  const mjModel& model_;
  std::string base_link_;
  std::vector<Force> forces_;
  std::vector<Hand> hands_;
  int base_ = -1;
  Pull pull_;
  int pulled_ = -1;            // body that `pull_` acts on; −1: none
  std::vector<int> released_;  // bodies that it acted on before
};

}  // namespace surefoot::simulation
