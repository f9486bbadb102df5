// Reads a log and writes what Figs. 4 and 6 of Bellicoso 2016 draw as a table: the centre of mass
// against its plan, and how the legs' lengths, the height and the pitch adapt to the ground.
//
//     10_read_a_log run.mcap > figures.csv      (10_read_a_log.py draws them)
#include "surefoot/closed_loop.hpp"
#include "surefoot/log.hpp"
#include "surefoot/scenario.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

namespace fs = std::filesystem;

/// A walk down the paper's step, recorded.
std::string recorded_run() {
  const std::string path = (fs::temp_directory_path() / "surefoot_10_read_a_log.mcap").string();
  const auto scenario = surefoot::config::load_scenario({"step_down", 0, {}});
  (void)surefoot::closed_loop::run_closed_loop(scenario, {.record_path = path});
  return path;
}

double pitch_of(const surefoot::Mat3& R) { return std::asin(-R(2, 0)); }

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : recorded_run();
  surefoot::logging::LogReader log(path);
  surefoot::TickRecord tick;
  std::printf(
      "time,com_x,com_y,com_x_plan,com_y_plan,leg_LF,leg_RF,leg_LH,leg_RH,"
      "height,height_plan,pitch,pitch_plan\n");
  double largest = 0.0, deepest = INFINITY;
  while (log.next(tick)) {
    if (!tick.model.p_WCom.allFinite()) continue;  // nothing was solved in this tick
    const surefoot::Vec2 com = tick.model.p_WCom.head<2>();
    std::printf("%.4f,%.5f,%.5f,%.5f,%.5f", tick.state.time, com.x(), com.y(), tick.plan.com.p.x(),
                tick.plan.com.p.y());
    for (const surefoot::Leg leg : tick.plan.feet.legs()) {
      const std::size_t k = index(leg);
      std::printf(",%.5f", (tick.model.p_WF[k] - tick.model.p_WH[k]).norm());
    }
    std::printf(",%.5f,%.5f,%.5f,%.5f\n", tick.state.p_WB.z(), tick.plan.torso.height,
                pitch_of(tick.state.R_WB()), pitch_of(tick.plan.torso.q_WB.toRotationMatrix()));
    largest = std::max(largest, (com - tick.plan.com.p).norm());
    deepest = std::min(deepest, tick.state.p_WB.z());
  }
  std::fprintf(stderr, "COM off its plan by at most %.1f mm; base down to %.3f m\n", 1e3 * largest,
               deepest);
  if (argc == 1) fs::remove(path);
  return largest < 0.02 && log.problem().empty() ? 0 : 1;
}
