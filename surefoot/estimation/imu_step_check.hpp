#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// What the legs say of a step of the IMU that `ReadingGuard` doubts.
enum class ImuStep : int {
  not_judged = 0,    ///< nobody asked
  undecided = 1,     ///< too little time has gone by
  no_witness = 2,    ///< hardly a foot stands
  confirmed = 3,     ///< the base moved as the samples say: a blow
  contradicted = 4,  ///< it went on as without the step: a fault
};

/// Holds a doubted step of the IMU against the feet that stand.
///
/// From the last tick before the step on, the base is carried along twice: by the samples as they
/// came, and by those with the last good ones in the place of what is doubted. Where a foot k
/// stands it stays where it was,
///
///     d_k = p + R h_k(q) − p_k,
///
/// and the way that leaves less of d_k is the true one. That takes no limit on how hard a robot may
/// be hit: what counts is which of the two explains the legs. A foot that slides or comes off fits
/// neither, so all have to contradict the step for it to be a fault, and most
/// to confirm it for a blow. After samples were held through a blow the believed velocity lacks
/// what they said, and for 50 ms no foot is a witness. Does not allocate.
class ImuStepCheck {
 public:
  explicit ImuStepCheck(double period) : period_(period) {}

  /// One tick. `offered`: samples as they came, `held`: with what is filled in; `is_doubted`: they
  /// differ in a step of the IMU alone; `stands` and `normal_W` as for `ImuCheck`.
  void update(const SensorReading& offered, const SensorReading& held, bool is_doubted,
              const RobotState& state, const Dynamics& dynamics, const PerLeg<bool>& stands,
              const Vec3& normal_W) noexcept;
  /// Nothing is known of this tick.
  void forget() noexcept;

  [[nodiscard]] ImuStep verdict() const { return verdict_; }

 private:
  /// The base as one of the two carries it.
  struct Way {
    Mat3 R = Mat3::Identity();
    Vec3 p = Vec3::Zero(), v = Vec3::Zero();
    Vec3 gyro = Vec3::Zero();  // of the tick before
  };

  void begin(const SensorReading& reading, const RobotState& state, const Dynamics& dynamics,
             const PerLeg<bool>& stands, const Vec3& normal_W);
  void carry(Way& way, const SensorReading& reading) const;
  void judge(const Dynamics& dynamics, const PerLeg<bool>& stands);

  double period_;
  bool has_begun_ = false;
  int doubted_ticks_ = 0;
  int unsure_ticks_ = 0;  // of the velocity, left
  Way offered_, held_;
  PerLeg<Vec3> p_WF_{};        // of the feet before the step [m]
  PerLeg<bool> is_witness_{};  // they stood then
  ImuStep verdict_ = ImuStep::not_judged;
};

}  // namespace surefoot
