#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::estimation {

/// Verdict of the legs on a step of the IMU that `ReadingGuard` doubts.
enum class ImuStep : int {
  not_judged = 0,    ///< no step is doubted
  undecided = 1,     ///< too early
  no_witness = 2,    ///< too few stance feet
  confirmed = 3,     ///< the base moved with the samples: an impact
  contradicted = 4,  ///< the base moved as without the step: a fault
};

/// Compares a doubted step of the IMU with the stance feet.
///
/// From the tick before the step, the base is integrated twice: with the raw samples, and with the
/// last good ones instead of the doubted. A stance foot k stays in place, so
///
///     d_k = p + R h_k(q) − p_k
///
/// is smaller for the true one. This needs no limit on how hard an impact may be. A foot that
/// slides or lifts off fits neither. So a fault needs all feet against the step, an impact most
/// feet in favour. After samples were held through an impact the estimated velocity lacks their
/// effect, and for 50 ms no foot is a witness. Does not allocate.
class ImuStepCheck {
 public:
  explicit ImuStepCheck(double period) : period_(period) {}

  /// One tick. `offered`: raw samples, `held`: with replacements; `is_doubted`: they differ only by
  /// a step of the IMU; `stands` and `normal_W` as for `ImuCheck`.
  void update(const SensorReading& offered, const SensorReading& held, bool is_doubted,
              const RobotState& state, const model::Dynamics& dynamics, const PerLeg<bool>& stands,
              const Vec3& normal_W) noexcept;
  /// This tick gives no information.
  void forget() noexcept;

  [[nodiscard]] ImuStep verdict() const { return verdict_; }

 private:
  /// The base, integrated with offered or held samples.
  struct Prediction {
    Mat3 R = Mat3::Identity();
    Vec3 p = Vec3::Zero(), v = Vec3::Zero();
    Vec3 gyro = Vec3::Zero();  // of the tick before
  };

  void begin(const SensorReading& reading, const RobotState& state, const model::Dynamics& dynamics,
             const PerLeg<bool>& stands, const Vec3& normal_W);
  void integrate(Prediction& base, const SensorReading& reading) const;
  void judge(const model::Dynamics& dynamics, const PerLeg<bool>& stands);

  double period_;
  bool has_begun_ = false;
  int doubted_ticks_ = 0;
  int unsure_ticks_ = 0;  // left, with an uncertain velocity
  Prediction offered_, held_;
  PerLeg<Vec3> p_WF_{};        // of the feet before the step [m]
  PerLeg<bool> is_witness_{};  // stood at that time
  ImuStep verdict_ = ImuStep::not_judged;
};

}  // namespace surefoot::estimation
