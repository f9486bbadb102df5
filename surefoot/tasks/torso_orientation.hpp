#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Gains of the two torso orientation tasks.
struct TorsoOrientationOptions {
  double kp = 200.0;        ///< [1/s²]
  double kd = 28.0;         ///< [1/s]
  double max_error = 0.05;  ///< limit of the orientation error [rad]
};

/// The torso follows its desired orientation about one or two axes of the control frame C.
///
///     C_J_R u̇ = C_ẇ_ref + kd (C_w_ref − C_w) + kp φ − C_J̇_R u,   φ = C_log(q_ref q⁻¹)
///
/// (Bellicoso 2016, Eq. 18, with the rotational Jacobian and a feed-forward.) C is constant between
/// touchdowns, so it has no rate. [rad/s²]
class TorsoOrientation : public Task {
 public:
  using Options = TorsoOrientationOptions;

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return num_axes_; }

 protected:
  TorsoOrientation(const Options& options, int first_axis, int num_axes)
      : options_(options), first_axis_(first_axis), num_axes_(num_axes) {}

 private:
  Options options_;
  int first_axis_;
  int num_axes_;
};

/// The row about the z axis of C.
class TorsoYaw final : public TorsoOrientation {
 public:
  explicit TorsoYaw(const Options& options) : TorsoOrientation(options, 2, 1) {}
  [[nodiscard]] std::string_view name() const override { return "torso_yaw"; }
  [[nodiscard]] std::string row_name(int id) const override;
};

/// The rows about the x and y axes of C.
class TorsoRollPitch final : public TorsoOrientation {
 public:
  explicit TorsoRollPitch(const Options& options) : TorsoOrientation(options, 0, 2) {}
  [[nodiscard]] std::string_view name() const override { return "torso_roll_pitch"; }
  [[nodiscard]] std::string row_name(int id) const override;
};

}  // namespace surefoot::tasks
