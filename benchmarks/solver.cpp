// The lexicographic solver against others on the same problems, in one process and in turn; see
// docs/benchmarks.md.

#include "benchmarks/solver/growth.hpp"
#include "benchmarks/solver/measure.hpp"
#include "benchmarks/solver/problems.hpp"
#include "benchmarks/solver/qp_cascade.hpp"
#include "benchmarks/solver/report.hpp"
#include "surefoot/base/error.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace surefoot::benchmarks {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> files, families, peers;
  bool sequence = false, list = false, growth = false, clock = false;
  std::string json;
  Amount amount;
  MeasureOptions measure;
};

CLI::Validator positive() { return CLI::Range(1, 1000000); }

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("files", arguments.files,
                 "Problems as `surefoot dump` writes them, instead of the families");
  app.add_flag("--sequence", arguments.sequence, "The files' lines are consecutive ticks");
  app.add_option("--family", arguments.families, "Only these families; see --list")->delimiter(',');
  app.add_option("--peer", arguments.peers, "Beside ours, only solvers whose name starts so")
      ->delimiter(',');
  app.add_option("--passes", arguments.measure.passes,
                 "Times each problem is solved; the least counts")
      ->check(positive())
      ->capture_default_str();
  app.add_option("--problems", arguments.amount.problems, "Of each generated family")
      ->check(positive())
      ->capture_default_str();
  app.add_option("--ticks", arguments.amount.ticks, "Of each recorded run")
      ->check(positive())
      ->capture_default_str();
  app.add_option("--limit", arguments.measure.time_limit, "Seconds until a solve counts as hung")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  app.add_option("--regularisation", QpCascade::regularisation,
                 "ε ‖z‖² of the cascades over QP solvers, whose Hessians must be definite")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--json", arguments.json, "Write all results to this file, too");
  app.add_flag("--growth", arguments.growth,
               "How our time grows with unknowns, levels, rows and active rows, instead");
  app.add_flag("--clock", arguments.clock,
               "Beside ours, ours with a clock: what telling the time of each level costs");
  app.add_flag("--list", arguments.list, "List families and solvers");
}

/// Ours, and of the others those that were asked for.
std::vector<PeerKind> chosen_peers(const Arguments& arguments) {
  std::vector<PeerKind> peers = all_peers();
  if (arguments.clock) add_ours_with_clock(peers);
  if (arguments.peers.empty()) return peers;
  std::string valid;
  for (const PeerKind& kind : peers) valid += (valid.empty() ? "" : ", ") + kind.name;
  for (const std::string& name : arguments.peers) {
    const bool exists = std::ranges::any_of(
        peers, [&](const PeerKind& kind) { return kind.name.starts_with(name); });
    if (!exists) throw UnknownNameError("no solver \"" + name + "\" here; there are " + valid);
  }
  std::erase_if(peers, [&](const PeerKind& kind) {
    return !kind.name.starts_with("our") &&
           std::ranges::none_of(arguments.peers, [&](const std::string& name) {
             return kind.name.starts_with(name);
           });
  });
  return peers;
}

std::vector<Family> chosen_families(const Arguments& arguments) {
  std::vector<Family> all = families();
  if (arguments.families.empty()) return all;
  std::vector<Family> chosen;
  std::string valid;
  for (const Family& family : all) valid += (valid.empty() ? "" : ", ") + family.name;
  for (const std::string& name : arguments.families) {
    const auto found = std::ranges::find(all, name, &Family::name);
    if (found == all.end()) {
      throw UnknownNameError("no family \"" + name + "\"; there are " + valid);
    }
    chosen.push_back(*found);
  }
  return chosen;
}

int list() {
  for (const Family& family : families()) {
    std::printf("family  %-20s %s\n", family.name.c_str(), family.about.c_str());
  }
  for (const PeerKind& kind : all_peers()) std::printf("solver  %s\n", kind.name.c_str());
  return 0;
}

void report(const SetResult& result, Json& all) {
  std::fputs(table(result).c_str(), stdout);
  std::fflush(stdout);
  all.push_back(to_json(result));
}

Json compare(const Arguments& arguments) {
  const std::vector<PeerKind> peers = chosen_peers(arguments);
  Json all = Json::array();
  for (const std::string& file : arguments.files) {
    report(measure(read_problems(file, arguments.sequence), peers, arguments.measure), all);
  }
  if (!arguments.files.empty()) return all;
  for (const Family& family : chosen_families(arguments)) {
    report(measure(family.make(arguments.amount), peers, arguments.measure), all);
  }
  return all;
}

int run(const Arguments& arguments) {
  if (arguments.list) return list();
  std::ofstream file;
  if (!arguments.json.empty()) {
    file.open(arguments.json);
    if (!file)
      throw FileError(arguments.json + ": can't be written; name a file in a folder that exists");
  }
  const Json all = arguments.growth ? measure_growth(arguments.measure.passes) : compare(arguments);
  if (!arguments.json.empty()) file << all.dump(1) << "\n";
  return 0;
}

}  // namespace
}  // namespace surefoot::benchmarks

int main(int argc, char** argv) {
  using namespace surefoot::benchmarks;
  CLI::App app("Our solver against others, on the same problems.", "benchmark_solver");
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_solver: %s\n", error.what());
    return 2;
  }
}
