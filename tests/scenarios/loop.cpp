#include "tests/scenarios/loop.hpp"

#include "surefoot/config/scenario_file.hpp"
#include "surefoot/simulation/make_estimator.hpp"
#include "tests/support/malloc_counter.hpp"

#include <algorithm>

namespace surefoot::test {

config::Scenario scenario(const std::string& name, const std::vector<std::string>& changes,
                          std::uint64_t seed) {
  return config::load_scenario({.name_or_path = name, .seed = seed, .assignments = changes});
}

Loop::Loop(const config::Scenario& scenario)
    : scenario_(scenario),
      plant_(scenario.robot, scenario.plant),
      controller_(scenario.robot, scenario.controller,
                  simulation::make_estimator(
                      scenario.estimation,
                      {scenario.robot, scenario.controller.period, plant_, scenario.estimator})) {}

void Loop::tick() {
  SensorReading reading = plant_.read();
  const UserCommand& user = scenario_.user(reading.time);
  change_(reading);
  const MallocCounter counter;
  const JointCommand& command = controller_.step(reading, user);
  const std::size_t made = counter.count();
  allocations_ += made;
  if (made > 0) last_allocation_ = reading.time;
  plant_.write(command);
  for (const GaitEvent& event : controller_.record().plan.events) events_.push_back(event.kind);
}

void Loop::run_until(double time, const std::function<bool()>& stop) {
  while (plant_.time() < time && !stop()) tick();
}

int Loop::count(PlanEvent event) const {
  return static_cast<int>(std::ranges::count(events_, event));
}

}  // namespace surefoot::test
