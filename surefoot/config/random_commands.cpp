#include "surefoot/config/random_commands.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::config {
namespace {

double drawn(const Scenario& scenario, const std::string& name, double min, double max) {
  return min + (max - min) * uniform_of(scenario.seed, "random_commands." + name);
}

TimedCommand random_command(const Scenario& scenario, int k) {
  const RandomCommands& random = scenario.random_commands;
  const std::string name = std::to_string(k) + ".";
  TimedCommand command{.time = random.from + k * random.period, .user = {.walk = true}};
  command.user.velocity.x() =
      drawn(scenario, name + "x", random.velocity_min.x(), random.velocity_max.x());
  command.user.velocity.y() =
      drawn(scenario, name + "y", random.velocity_min.y(), random.velocity_max.y());
  command.user.yaw_rate = drawn(scenario, name + "yaw_rate", -random.yaw_rate, random.yaw_rate);
  const auto num_gaits = static_cast<double>(scenario.controller.gaits.size());
  if (random.gaits && num_gaits > 0.0) {
    const double place = std::floor(drawn(scenario, name + "gait", 0.0, num_gaits));
    command.user.gait = static_cast<int>(std::min(place, num_gaits - 1.0));
  }
  return command;
}

}  // namespace

void add_random_commands(Scenario& scenario) {
  const RandomCommands& random = scenario.random_commands;
  if (std::isnan(random.from)) return;
  std::erase_if(scenario.commands,
                [&](const TimedCommand& own) { return own.time >= random.from && own.time > 0.0; });
  const int count = static_cast<int>(std::ceil((scenario.duration - random.from) / random.period));
  for (int k = 0; k < count; ++k) scenario.commands.push_back(random_command(scenario, k));
}

}  // namespace surefoot::config
