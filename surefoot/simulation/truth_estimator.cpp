#include "surefoot/simulation/truth_estimator.hpp"

namespace surefoot::simulation {

const RobotState& TruthEstimator::update(const SensorReading& reading,
                                         const TickContext& context) noexcept {
  state_.time = reading.time;
  state_.p_WB = truth_.p_SB;
  state_.q_WB = truth_.q_SB;
  state_.v_WB = truth_.v_SB;
  state_.w_WB_B = truth_.w_SB_B;
  state_.qd = truth_.qd;
  state_.q = reading.q + context.joint_lag * state_.qd;
  state_.torque = reading.torque;
  return state_;
}

}  // namespace surefoot::simulation
