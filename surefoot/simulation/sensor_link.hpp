#pragma once

#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <vector>

namespace surefoot::simulation {

/// Transmission from the sensors to the controller: delays, then faults.
///
/// A sample keeps its sample time, so that silence and delay show in the reading. Before enough
/// ticks have passed the first sample arrives. A fault of a single joint, of the gyroscope alone or
/// of the accelerometer alone leaves sample times unchanged; foot sensors have none.
class SensorLink {
 public:
  SensorLink(const SensorOptions& options, double control_period);

  /// Adds a fault between two ticks. Allocates.
  void add(const SensorFault& fault);

  /// Sends the samples of a control tick. Does not allocate.
  void transmit(const SensorReading& sampled) noexcept;
  /// The reading that arrives at this tick.
  [[nodiscard]] const SensorReading& received() const noexcept { return received_; }

 private:
  struct Fault {
    SensorFault options;
    double end;                 ///< [s]
    int delay;                  ///< of the samples of a `late` fault [ticks]
    SensorReading before = {};  ///< the last reading without the fault
  };
  [[nodiscard]] int usual_delay(FaultySensor sensor) const;
  /// Keeps samples so old from now on.
  void keep(int ticks);
  [[nodiscard]] const SensorReading& sent(int ticks_ago) const noexcept;
  void delay(const SensorReading& sampled) noexcept;
  void apply(Fault& fault) noexcept;

  double control_period_;  // [s]
  int encoder_delay_, torque_delay_, imu_delay_, foot_delay_;
  std::vector<Fault> faults_;
  std::vector<SensorReading> sent_;  // ring
  std::size_t num_sent_ = 0;
  SensorReading received_;
};

}  // namespace surefoot::simulation
