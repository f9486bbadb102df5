#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Keeps the contact points of stance feet in place.
///
///     J_C u̇ = −J̇_C u − kd J_C u     (Bellicoso 2016, Eq. 16; the damping is ours)
///
/// C is the lowest point of the foot sphere, with the drift of rolling without slip. The damping
/// removes velocity left by impacts and integration errors. Writes 3 rows for each leg in contact,
/// in W [m/s²]. A flat foot does not turn either: C is the centre of its sole, and 3 more rows
/// follow for its angular velocity [rad/s²].
class NoContactMotion final : public Task {
 public:
  struct Options {
    double kd = 10.0;  ///< damping of the contact point's velocity [1/s]
  };

  explicit NoContactMotion(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return rows_per_leg() * num_legs(); }
  [[nodiscard]] std::string_view name() const override { return "no_contact_motion"; }
  [[nodiscard]] std::string row_name(int id) const override;

 private:
  [[nodiscard]] int rows_per_leg() const { return has_flat_feet() ? 6 : 3; }

  Options options_;
};

}  // namespace surefoot::tasks
