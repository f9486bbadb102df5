#pragma once

#include <string>
#include <vector>

namespace surefoot {

/// A success rate with its 95 % interval, as shares; no trials: nothing was tried.
struct DemoRate {
  int successes = 0, trials = 0;
  double low = 0.0, high = 1.0;
};

/// An experiment beside the paper's.
struct DemoRow {
  std::string experiment;   ///< what was done
  std::string quantity;     ///< what was measured, with unit
  std::string paper, ours;  ///< the numbers
  bool passed = false;      ///< its criteria hold
  DemoRate rate;            ///< over the seeds, if there was more than one run
  std::string report;       ///< address of the run's report, relative to the page; empty: none
  std::string note;         ///< e.g. what ended it
};

/// Success against a parameter, such as the height of a step.
struct DemoCurve {
  struct Point {
    double x = 0.0;
    DemoRate rate;
  };
  std::string label;
  std::vector<Point> points;
};
struct DemoCurves {
  std::string title, x_label;
  std::string caption;
  std::vector<DemoCurve> curves;
};

/// The experiments of one `demo`.
struct DemoTable {
  std::string title;
  std::vector<std::string> facts;  ///< version, machine, duration
  std::vector<DemoRow> rows;
  std::vector<DemoCurves> figures;
};

/// Writes the page of all experiments: numbers beside the paper's, success rates with their
/// intervals, curves, links to the reports. Throws FileError if it can't be written.
void write_overview(const DemoTable& table, const std::string& path);

}  // namespace surefoot
