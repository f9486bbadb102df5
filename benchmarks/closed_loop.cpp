// What the controller costs beside the physics it walks in: a whole closed loop, and in every tick
// of it MuJoCo stepping the same model alone and a matrix factorization as a unit, one after the
// other in one process. No tick is left out.
//
// The loop is deterministic, so it is run several times and each tick counts with its least time:
// what other programs took from the machine drops out, what a tick really costs stays.

#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/runtime/stage_timer.hpp"
#include "surefoot/simulation/make_estimator.hpp"
#include "surefoot/simulation/plant.hpp"

#include <CLI/CLI.hpp>
#include <Eigen/QR>
#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> scenarios{"walk_flat", "step_down"};
  std::uint64_t seed = 0;
  std::vector<std::string> assignments;
  int runs = 3;
  bool json = false;
};

/// What is timed in a tick. The controller's stages come first, in their order.
enum Item {
  kEstimate,
  kModel,
  kPlan,
  kStack,
  kSolve,
  kCommand,
  kController,
  kPlant,
  kLoop,
  kPhysics,
  kQ,
  kNumItems
};

struct ItemText {
  const char* name;
  const char* what;
};
constexpr std::array<ItemText, kNumItems> kItems{
    {{"estimate", ""},
     {"model", ""},
     {"plan", ""},
     {"stack", ""},
     {"solve", ""},
     {"command", ""},
     {"controller", "all stages"},
     {"plant", "MuJoCo over one control period, with actuators, sensors and truth"},
     {"loop", "controller and plant"},
     {"physics", "MuJoCo alone: the same model from the same states, as many steps"},
     {"q", "HouseholderQR of a 30 × 30 matrix, the unit Q"}}};

/// Times of one tick [µs].
using Sample = std::array<double, kNumItems>;

template <typename Action>
double microseconds(Action&& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
      .count();
}

/// MuJoCo on the plant's model and from the plant's states, without anything of ours around it.
class PhysicsAlone {
 public:
  PhysicsAlone(const simulation::Plant& plant, double control_period)
      : model_(compile(plant.model_xml())),
        data_(mj_makeData(model_.get())),
        steps_(static_cast<int>(std::lround(control_period / model_->opt.timestep))) {}

  /// Time for the control period that begins at this state.
  double period(const simulation::GroundTruth& truth) {
    std::ranges::copy(truth.qpos, data_->qpos);
    std::ranges::copy(truth.qvel, data_->qvel);
    std::ranges::copy(truth.ctrl, data_->ctrl);
    std::ranges::copy(truth.xfrc_applied, data_->xfrc_applied);
    return microseconds([&] {
      for (int i = 0; i < steps_; ++i) mj_step(model_.get(), data_.get());
    });
  }

  [[nodiscard]] int steps() const { return steps_; }

 private:
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
    void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
  };
  using Model = std::unique_ptr<mjModel, Delete>;

  static Model compile(const std::string& xml) {
    std::array<char, 1000> reason{};
    const std::unique_ptr<mjSpec, Delete> spec(
        mj_parseXMLString(xml.c_str(), nullptr, reason.data(), static_cast<int>(reason.size())));
    Model model(spec ? mj_compile(spec.get(), nullptr) : nullptr);
    if (!model)
      throw Error(std::string("MuJoCo can't compile the plant's model: ") + reason.data());
    return model;
  }

  Model model_;
  std::unique_ptr<mjData, Delete> data_;
  int steps_;
};

/// A unit of work that travels from machine to machine.
class Unit {
 public:
  double time() {
    return microseconds([&] { qr_.compute(matrix_); });
  }

 private:
  Eigen::MatrixXd matrix_ = Eigen::MatrixXd::Random(30, 30);
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_{30, 30};
};

/// Everything of one run, wired together.
class Loop {
 public:
  explicit Loop(const config::Scenario& scenario)
      : scenario_(scenario),
        plant_(scenario.robot, scenario.plant),
        controller_(scenario.robot, scenario.controller,
                    simulation::make_estimator(
                        scenario.estimation,
                        {scenario.robot, scenario.controller.period, plant_, scenario.estimator})),
        physics_(plant_, scenario.controller.period) {
    controller_.set_stage_observer(&timer_);
  }

  Sample tick() {
    const double physics = physics_.period(plant_.truth());
    double plant = 0.0;
    const double loop = microseconds([&] {
      const SensorReading& reading = plant_.read();
      command_ = controller_.step(reading, scenario_.user(reading.time));
      plant = microseconds([&] { plant_.write(command_); });
    });
    Sample sample = stages();
    sample[kPlant] = plant;
    sample[kLoop] = loop;
    sample[kPhysics] = physics;
    sample[kQ] = unit_.time();
    return sample;
  }

  [[nodiscard]] const JointCommand& command() const { return command_; }
  [[nodiscard]] int physics_steps() const { return physics_.steps(); }

 private:
  [[nodiscard]] Sample stages() const {
    const TickTiming& t = timer_.timing();
    const double command = t.total - (t.estimate + t.model + t.plan + t.stack + t.solve);
    return {t.estimate, t.model, t.plan, t.stack, t.solve, command, t.total, 0.0, 0.0, 0.0, 0.0};
  }

  const config::Scenario& scenario_;
  simulation::Plant plant_;
  control::Controller controller_;
  PhysicsAlone physics_;
  Unit unit_;
  runtime::StageTimer timer_;
  JointCommand command_;
};

/// Stages stay those of one tick, so that they add up; the others are independent of each other.
void keep_least(Sample& least, const Sample& sample) {
  if (sample[kController] < least[kController])
    std::copy_n(sample.begin(), kController + 1, least.begin());
  for (const Item item : {kPlant, kLoop, kPhysics, kQ})
    least[item] = std::min(least[item], sample[item]);
}

struct Measurement {
  std::vector<Sample> least;      ///< of all runs, by tick
  Sample longest{};               ///< of all ticks of all runs
  int physics_steps = 0;          ///< in a control period
  int fallback_ticks = 0;         ///< whose command is not the hierarchy's optimum
  long involuntary_switches = 0;  ///< times that the machine took the processor away
};

long involuntary_switches() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_nivcsw;
}

/// One more run of the same loop; `torques` are those of the first.
void run_once(const config::Scenario& scenario, std::vector<JointVector>& torques,
              Measurement& result) {
  Loop loop(scenario);
  const bool is_first = torques.empty();
  for (std::size_t tick = 0; tick < result.least.size(); ++tick) {
    const Sample sample = loop.tick();
    keep_least(result.least[tick], sample);
    for (std::size_t i = 0; i < kNumItems; ++i)
      result.longest[i] = std::max(result.longest[i], sample[i]);
    if (is_first) {
      torques.push_back(loop.command().torque);
      result.fallback_ticks += loop.command().mode == CommandMode::optimal ? 0 : 1;
    } else if (loop.command().torque != torques[tick]) {
      throw Error("tick " + std::to_string(tick) +
                  " is not the same in every run: the loop is not deterministic");
    }
  }
  result.physics_steps = loop.physics_steps();
}

Measurement measure(const config::Scenario& scenario, int runs) {
  Measurement result;
  Sample infinite;
  infinite.fill(std::numeric_limits<double>::infinity());
  const auto ticks =
      static_cast<std::size_t>(std::ceil(scenario.duration / scenario.controller.period));
  result.least.assign(ticks, infinite);
  std::vector<JointVector> torques;
  const long before = involuntary_switches();
  for (int run = 0; run < runs; ++run) run_once(scenario, torques, result);
  result.involuntary_switches = involuntary_switches() - before;
  return result;
}

struct Distribution {
  double median = 0.0, p99 = 0.0, max = 0.0, mean = 0.0;  ///< [µs]
};

Distribution distribution(const Measurement& measurement, std::size_t item) {
  std::vector<double> times;
  for (const Sample& sample : measurement.least) times.push_back(sample[item]);
  std::ranges::sort(times);
  const auto last = static_cast<double>(times.size() - 1);
  const auto quantile = [&](double share) {
    return times[static_cast<std::size_t>(std::lround(share * last))];
  };
  double sum = 0.0;
  for (const double time : times) sum += time;
  return {quantile(0.5), quantile(0.99), times.back(), sum / static_cast<double>(times.size())};
}

/// Each number of one distribution over the other's.
Json ratio(const Distribution& of, const Distribution& to) {
  return {{"median", of.median / to.median},
          {"p99", of.p99 / to.p99},
          {"max", of.max / to.max},
          {"mean", of.mean / to.mean}};
}

Json to_json(const config::Scenario& scenario, int runs, const Measurement& measurement) {
  std::array<Distribution, kNumItems> items;
  Json times;
  for (std::size_t i = 0; i < kNumItems; ++i) {
    items[i] = distribution(measurement, i);
    times[kItems[i].name] = {{"median", items[i].median},
                             {"p99", items[i].p99},
                             {"max", items[i].max},
                             {"mean", items[i].mean},
                             {"longest_of_all_runs", measurement.longest[i]}};
  }
  const Distribution& controller = items[kController];
  const double q = items[kQ].median;
  std::array<double, 3> load{};
  getloadavg(load.data(), static_cast<int>(load.size()));
  return {{"version", build_info().version},
          {"scenario", scenario.name},
          {"seed", scenario.seed},
          {"ticks", measurement.least.size()},
          {"runs", runs},
          {"fallback_ticks", measurement.fallback_ticks},
          {"physics_steps", measurement.physics_steps},
          {"us", std::move(times)},
          {"controller_per_physics", ratio(controller, items[kPhysics])},
          {"loop_per_physics", ratio(items[kLoop], items[kPhysics])},
          {"controller_per_q", ratio(controller, {q, q, q, q})},
          {"realtime_factor", 1e6 * scenario.controller.period / items[kLoop].mean},
          {"involuntary_switches", measurement.involuntary_switches},
          {"load_average", load}};
}

void print_row(const Json& json, const ItemText& item, const char* indent) {
  const Json& times = json["us"][item.name];
  std::printf("  %s%-*s %9.2f %9.2f %9.2f %9.2f %9.2f  %s\n", indent, indent[0] == '\0' ? 12 : 10,
              item.name, times["median"].get<double>(), times["p99"].get<double>(),
              times["max"].get<double>(), times["mean"].get<double>(),
              times["longest_of_all_runs"].get<double>(), item.what);
}

void print_ratio(const Json& ratio, const char* name) {
  std::printf("  %-20s %6.2f median %8.2f p99 %8.2f max %8.2f mean\n", name,
              ratio["median"].get<double>(), ratio["p99"].get<double>(), ratio["max"].get<double>(),
              ratio["mean"].get<double>());
}

void print_table(const Json& json) {
  std::printf(
      "surefoot %s, %s, seed %d: %d ticks, all of them, each the least of %d identical runs\n\n",
      json["version"].get<std::string>().c_str(), json["scenario"].get<std::string>().c_str(),
      json["seed"].get<int>(), json["ticks"].get<int>(), json["runs"].get<int>());
  std::printf("  %-12s %9s %9s %9s %9s %9s\n", "µs a tick ", "median", "p99", "max", "mean",
              "any run");
  print_row(json, kItems[kController], "");
  for (std::size_t stage = 0; stage < kController; ++stage) print_row(json, kItems[stage], "  ");
  for (std::size_t i = kPlant; i < kNumItems; ++i) print_row(json, kItems[i], "");
  std::printf("\n");
  print_ratio(json["controller_per_physics"], "controller / physics");
  print_ratio(json["loop_per_physics"], "loop / physics");
  print_ratio(json["controller_per_q"], "controller / Q");
  std::printf("  %.1f times real time; %d ticks without the optimum\n",
              json["realtime_factor"].get<double>(), json["fallback_ticks"].get<int>());
  std::printf("  the processor was taken away %ld times; load average %.1f\n\n",
              json["involuntary_switches"].get<long>(), json["load_average"][0].get<double>());
}

void run(const Arguments& arguments) {
  for (const std::string& name : arguments.scenarios) {
    const config::Scenario scenario = config::load_scenario(
        {.name_or_path = name, .seed = arguments.seed, .assignments = arguments.assignments});
    const Json json = to_json(scenario, arguments.runs, measure(scenario, arguments.runs));
    if (arguments.json) {
      std::printf("%s\n", json.dump().c_str());
    } else {
      print_table(json);
    }
  }
}

}  // namespace
}  // namespace surefoot

int main(int argc, char** argv) {
  surefoot::Arguments arguments;
  CLI::App app("The whole closed loop against MuJoCo stepping the same model alone");
  app.add_option("scenarios", arguments.scenarios, "Names of scenarios, or files")
      ->capture_default_str();
  app.add_option("--seed", arguments.seed, "Of the scenarios")->capture_default_str();
  app.add_option("--set", arguments.assignments, "path.to.key=value: change a key of the scenarios")
      ->take_all()
      ->expected(1);
  app.add_option("--runs", arguments.runs, "Identical runs; each tick counts with its least time")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--json", arguments.json, "Print one JSON object a line instead of tables");
  CLI11_PARSE(app, argc, argv);
  try {
    surefoot::run(arguments);
    return 0;
  } catch (const surefoot::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
