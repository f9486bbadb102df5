#include "surefoot/view/overview.hpp"

#include "surefoot/view/report_page.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>

namespace surefoot {
namespace {

using plot::decimal;

std::string rate_text(const DemoRate& rate) {
  if (rate.trials == 0) return "";
  return std::to_string(rate.successes) + " of " + std::to_string(rate.trials) + "  (" +
         decimal(100.0 * rate.low, 0) + "–" + decimal(100.0 * rate.high, 0) + " %)";
}

std::string experiments(const std::vector<DemoRow>& rows) {
  std::vector<std::vector<report::Cell>> cells;
  for (const DemoRow& row : rows) {
    const std::string name = plot::escape(row.experiment);
    const std::string linked =
        row.report.empty() ? name : "<a href=\"" + plot::escape(row.report) + "\">" + name + "</a>";
    cells.push_back({{linked, "", true},
                     {row.quantity},
                     {row.paper, "number"},
                     {row.ours, "number"},
                     {rate_text(row.rate), "number"},
                     {row.passed ? "✓ holds" : "✗ missed", row.passed ? "good" : "bad"},
                     {row.note, "soft"}});
  }
  return report::table(
      {"experiment", "measured", "paper", "here", "successes (95 %)", "criteria", ""}, cells);
}

// Points with their intervals; curves stand a little apart, so that their whiskers can be told.
void draw_curve(plot::Svg& svg, const plot::Frame& frame, const DemoCurve& curve, std::size_t i,
                double shift) {
  const std::string colour = std::to_string(i % 4);
  std::vector<plot::Point> line;
  for (const DemoCurve::Point& point : curve.points) {
    if (point.rate.trials == 0) continue;
    const double x = frame.px_x(point.x) + shift;
    const double share = 100.0 * point.rate.successes / point.rate.trials;
    svg.line({x, frame.px_y(100.0 * point.rate.low)}, {x, frame.px_y(100.0 * point.rate.high)},
             "whisker c" + colour);
    line.push_back({x, frame.px_y(share)});
  }
  svg.path(plot::path_through(line), "line c" + colour + (i % 2 == 0 ? "" : " dashed"));
  for (std::size_t k = 0; k < line.size(); ++k) svg.circle(line[k], 4.0, "dot f" + colour);
}

std::string curves_image(const DemoCurves& curves) {
  plot::Range x;
  for (const DemoCurve& curve : curves.curves) {
    for (const DemoCurve::Point& point : curve.points) x.add(point.x);
  }
  if (x.empty()) return "";
  const plot::Frame frame{.corner = {plot::kLeftMargin, 30.0},
                          .width = plot::kFigureWidth - plot::kLeftMargin - plot::kRightMargin,
                          .height = 230.0,
                          .x = x.padded(0.04),
                          .y = {-4.0, 104.0}};
  plot::Svg svg(plot::kFigureWidth, frame.corner.y + frame.height + 42.0);
  plot::draw_x_axis(svg, frame, curves.x_label);
  plot::draw_y_axis(svg, frame, "success [%]");
  std::vector<plot::LegendEntry> legend;
  for (std::size_t i = 0; i < curves.curves.size(); ++i) {
    const double shift =
        5.0 * (static_cast<double>(i) - 0.5 * static_cast<double>(curves.curves.size() - 1));
    draw_curve(svg, frame, curves.curves[i], i, shift);
    legend.push_back(
        {curves.curves[i].label, "line c" + std::to_string(i % 4) + (i % 2 == 0 ? "" : " dashed")});
  }
  plot::outline(svg, frame);
  plot::draw_legend(svg, frame.corner.x + frame.width, 18.0, legend);
  svg.text({frame.corner.x, 18.0}, curves.title, "panel-title");
  return svg.image(curves.title);
}

}  // namespace

void write_overview(const DemoTable& table, const std::string& path) {
  std::string body = "<h1>" + plot::escape(table.title) + "</h1>\n";
  for (const std::string& fact : table.facts)
    body += "<p class=\"facts\">" + plot::escape(fact) + "</p>\n";
  body += "<h2>Experiments beside the paper</h2>\n" + experiments(table.rows);
  int number = 0;
  for (const DemoCurves& curves : table.figures) {
    body += report::figure(number, curves_image(curves), curves.caption);
  }
  report::write_page(path, report::page(table.title, body));
}

}  // namespace surefoot
