// Reads a log and draws Figs. 4 (balance) and 6 (terrain adaptation) of Bellicoso 2016 from it as
// PDF. Numbers are read here; figures are drawn by the program, which must be on the PATH.
//
//     10_read_a_log run.mcap
#include "surefoot/closed_loop.hpp"
#include "surefoot/log.hpp"
#include "surefoot/scenario.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace fs = std::filesystem;

/// A walk down the paper's step, recorded.
std::string recorded_run(const fs::path& folder) {
  const std::string path = (folder / "run.mcap").string();
  const auto scenario = surefoot::config::load_scenario(
      {"step_down", 0, {"duration=9", "planner.calibration.duration=0", "criteria=none"}});
  (void)surefoot::closed_loop::run_closed_loop(scenario, {.record_path = path});
  return path;
}

int main(int argc, char** argv) {
  const fs::path folder = fs::temp_directory_path() / "surefoot_10_read_a_log";
  fs::create_directories(folder);
  const std::string path = argc > 1 ? argv[1] : recorded_run(folder);
  surefoot::logging::LogReader log(path);
  surefoot::TickRecord tick;
  double largest = 0.0, deepest = INFINITY;
  while (log.next(tick)) {
    if (!tick.model.p_WCom.allFinite()) continue;  // nothing was solved in this tick
    largest = std::max(largest, (tick.model.p_WCom.head<2>() - tick.plan.com.p).norm());
    deepest = std::min(deepest, tick.state.p_WB.z());
  }
  std::printf("COM off its plan by at most %.1f mm; base down to %.3f m\n", 1e3 * largest, deepest);

  const std::string command =
      "surefoot report '" + path + "' --no-pictures --out '" + folder.string() + "'";
  if (std::system(command.c_str()) != 0) return 1;
  bool is_drawn = true;
  for (const char* figure : {"com_tracking.pdf", "terrain_adaptation.pdf"}) {
    std::printf("%s\n", (folder / "figures" / figure).c_str());
    is_drawn = is_drawn && fs::exists(folder / "figures" / figure);
  }
  return is_drawn && largest < 0.02 && log.problem().empty() ? 0 : 1;
}
