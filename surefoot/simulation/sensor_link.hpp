#pragma once

#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <vector>

namespace surefoot::simulation {

/// The way from the sensors to the controller: delays, then faults.
///
/// A sample keeps the time at which it was taken, so that silence and delay show in the reading's
/// sample times. Before the first sample there is only the first. A fault of one joint alone, of
/// the gyroscope alone or of the accelerometer alone leaves the sample times as they are; foot
/// sensors have none.
class SensorLink {
 public:
  SensorLink(const SensorOptions& options, double control_period);

  /// The samples of a control tick go out. Does not allocate.
  void transmit(const SensorReading& sampled) noexcept;
  /// What has come at this tick.
  [[nodiscard]] const SensorReading& received() const noexcept { return received_; }

 private:
  struct Fault {
    SensorFault options;
    double end;                 ///< [s]
    int delay;                  ///< of the faulty samples of a `late` one [ticks]
    SensorReading before = {};  ///< the last reading without the fault
  };
  [[nodiscard]] const SensorReading& sent(int ticks_ago) const noexcept;
  void delay(const SensorReading& sampled) noexcept;
  void apply(Fault& fault) noexcept;

  int encoder_delay_, torque_delay_, imu_delay_, foot_delay_;
  std::vector<Fault> faults_;
  std::vector<SensorReading> sent_;  // ring
  std::size_t num_sent_ = 0;
  SensorReading received_;
};

}  // namespace surefoot::simulation
