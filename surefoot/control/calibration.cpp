#include "surefoot/control/calibration.hpp"

#include "surefoot/gaits/parts/calibration_motion.hpp"

namespace surefoot::control {

static_assert(estimation::KinematicCalibration::kFadeIn <= gaits::CalibrationMotion::kTakeOver);

Calibration::Calibration(const estimation::LinkMassOptions& options,
                         const model::RobotDescription& robot, double base_mass, double period)
    : kinematics_(robot, period),
      link_masses_(options, period, robot.scale, robot.num_legs()),
      com_(period, base_mass, robot.num_legs()) {}

void Calibration::update(const RobotState& state, const model::Dynamics& dynamics,
                         const Vec3& gyro_B, const LastTick& last, bool is_quiet) noexcept {
  const CalibrationStage stage = last.plan.calibration;
  const bool turning = stage == CalibrationStage::turning;
  if (turning && !is_quiet) {
    kinematics_.forget();
  } else {
    kinematics_.update(state.time, dynamics, gyro_B, last.terrain_normal_W, turning);
  }
  link_masses_.update(state.time, dynamics, last.plan.standing(), state.torque);
  com_.correct(link_masses_.shares());
  com_.update(dynamics, state.foot_force, stage, is_quiet);
}

}  // namespace surefoot::control
