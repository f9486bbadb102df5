#include "surefoot/view/report_page.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/whole_file.hpp"
#include "surefoot/view/svg.hpp"

#include <filesystem>

namespace surefoot::report {
namespace {

// Colours c0 … c3 (legs LF, RF, LH, RH) are those of Okabe and Ito, lighter on dark ground.
constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark;
  --ground: #ffffff; --ink: #1c1f23; --soft: #5c636b; --rule: #d9dde1; --grid: #e8ebee; --card: #f6f7f8;
  --c0: #0072b2; --c1: #d55e00; --c2: #009e73; --c3: #aa4499; --c5: #8a6d00; --bound: #7a1f1f;
  --good: #00704f; --bad: #b3261e; --stance: #5c636b1f; --search: #c9a10059;
  --g0: #ffffff; --g1: #f7f7f6; --g2: #f0f0ee; --g3: #e9e9e6; --g4: #e1e1dd; }
@media (prefers-color-scheme: dark) { :root {
  --ground: #14171a; --ink: #e8eaed; --soft: #a3abb3; --rule: #363c42; --grid: #262b30; --card: #1c2024;
  --c0: #56b4e9; --c1: #f5934e; --c2: #3fc99c; --c3: #d070c0; --c5: #e0c34a; --bound: #ff9b94;
  --good: #59d2a5; --bad: #ff8a80; --stance: #a3abb32b; --search: #d9a80059;
  --g0: #2b3137; --g1: #262b31; --g2: #20252a; --g3: #1a1e22; --g4: #0f1113; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2.5rem 1.25rem 4rem; max-width: 60rem; background: var(--ground);
  color: var(--ink); font: 16px/1.5 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 .25rem; font-weight: 650; letter-spacing: -.01em; }
h2 { font-size: 1.15rem; margin: 2.75rem 0 .75rem; font-weight: 650; }
h3 { font-size: 1rem; margin: 2rem 0 .5rem; font-weight: 650; }
p { margin: .5rem 0; max-width: 46rem; }
.lead { font-size: 1.05rem; margin: 0; }
.facts { color: var(--soft); }
.verdict { display: inline-block; margin: .75rem .5rem .25rem 0; padding: .3rem .75rem; border: 1.5px solid currentColor;
  border-radius: .4rem; font-weight: 600; }
.good { color: var(--good); } .bad { color: var(--bad); } .soft { color: var(--soft); }
.warning { border-left: 4px solid var(--bad); background: var(--card); padding: .6rem .9rem; }
table { border-collapse: collapse; width: 100%; margin: .75rem 0; font-size: .92rem;
  font-variant-numeric: tabular-nums; border-top: 2px solid var(--ink); border-bottom: 2px solid var(--ink); }
th { text-align: left; font-weight: 600; border-bottom: 1px solid var(--ink); padding: .35rem .6rem; }
td { padding: .3rem .6rem; border-bottom: 1px solid var(--grid); vertical-align: top; }
td.number, th.number { text-align: right; white-space: nowrap; }
tr.group td { border-bottom: 1px solid var(--ink); }
.troubles { margin: .5rem 0; padding: .5rem 1rem .5rem 2rem; background: var(--card); border-left: 4px solid var(--c1); }
pre { background: var(--card); padding: .6rem .9rem; overflow-x: auto; font-size: .9rem; }
td.nowrap { white-space: nowrap; }
.scroll { overflow-x: auto; }
figure { margin: 1.75rem 0 2.5rem; }
.pictures img, .pictures video { display: block; width: 100%; height: auto; border-radius: .4rem; background: var(--card); }
figcaption { font-size: .9rem; color: var(--soft); margin-top: .4rem; max-width: 50rem; }
figcaption b { color: var(--ink); }
details { margin: 1rem 0; } summary { cursor: pointer; color: var(--soft); }
a { color: var(--c0); }
svg.plot { display: block; width: 100%; height: auto; font: 12px system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
svg text { fill: var(--ink); font-variant-numeric: tabular-nums; }
svg text.tick, svg text.note { font-size: 11px; fill: var(--soft); }
svg text.note { font-style: italic; }
svg text.panel-title { font-weight: 600; }
.frame { fill: none; stroke: var(--ink); stroke-width: 1; }
.grid { fill: none; stroke: var(--grid); stroke-width: 1; }
.line { fill: none; stroke-width: 1.4; stroke-linejoin: round; stroke-linecap: butt; }
.thick { stroke-width: 5; }
.dashed { stroke-dasharray: 6 3.5; }
.dotted { stroke-dasharray: 2 3; }
.c0 { stroke: var(--c0); } .c1 { stroke: var(--c1); } .c2 { stroke: var(--c2); } .c3 { stroke: var(--c3); }
.c5 { stroke: var(--c5); } .ink { stroke: var(--ink); }
.bound { fill: none; stroke: var(--bound); stroke-width: 1.1; stroke-dasharray: 8 3 2 3; }
.stance { fill: var(--stance); } .search { fill: var(--search); }
.support { fill: none; stroke: var(--soft); stroke-opacity: .45; stroke-width: .8; }
.wide { stroke-width: 3.2; stroke-opacity: .5; } .fine { stroke-width: .9; }
.edge { fill: none; stroke: var(--ink); stroke-width: 2.2; }
.crease { fill: none; stroke: var(--ink); stroke-width: 1.2; }
.contour { fill: none; stroke: var(--soft); stroke-width: .8; }
.ground { fill: var(--soft); fill-opacity: .09; } .ground-line { fill: none; stroke: var(--ink); stroke-width: 1.8; }
.dot { stroke: var(--ground); stroke-width: 1.2; }
.f0 { fill: var(--c0); } .f1 { fill: var(--c1); } .f2 { fill: var(--c2); } .f3 { fill: var(--c3); }
.column { fill: var(--c0); fill-opacity: .75; }
.bar { fill: none; stroke-width: 9; } .b0 { stroke: var(--c0); } .b1 { stroke: var(--c1); }
.area { fill: var(--c0); fill-opacity: .35; stroke: var(--c0); stroke-width: .8; }
.restless { fill: var(--soft); fill-opacity: .15; stroke: var(--soft); stroke-opacity: .6; }
.g0 { fill: var(--g0); } .g1 { fill: var(--g1); } .g2 { fill: var(--g2); } .g3 { fill: var(--g3); } .g4 { fill: var(--g4); }
@media print { body { max-width: none; padding: 0; font-size: 11pt; } figure { break-inside: avoid; } }
)css";

}  // namespace

std::string page(std::string_view title, std::string_view body) {
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         plot::escape(title) + "</title>\n<style>" + std::string(kStyle) +
         "</style>\n</head>\n<body>\n" + std::string(body) + "</body>\n</html>\n";
}

std::string figure(int& number, const std::string& image, std::string_view caption) {
  if (image.empty()) return "";
  return "<figure>\n" + image + "<figcaption><b>Figure " + std::to_string(++number) + ".</b> " +
         plot::escape(caption) + "</figcaption>\n</figure>\n";
}

namespace {

std::string head_row(const std::vector<std::string>& head,
                     const std::vector<std::vector<Cell>>& rows) {
  std::string out = "<tr>";
  for (std::size_t i = 0; i < head.size(); ++i) {
    // A column's head stands where its cells do.
    const std::string style = rows.empty() || i >= rows[0].size() ? "" : rows[0][i].style;
    const bool right = style.find("number") != std::string::npos;
    out += std::string(right ? "<th class=\"number\">" : "<th>") + plot::escape(head[i]) + "</th>";
  }
  return out + "</tr>\n";
}

std::string table_row(const std::vector<Cell>& row, bool ends_group) {
  std::string out = ends_group ? "<tr class=\"group\">" : "<tr>";
  for (const Cell& cell : row) {
    out += cell.style.empty() ? "<td>" : "<td class=\"" + cell.style + "\">";
    out += (cell.is_html ? cell.text : plot::escape(cell.text)) + "</td>";
  }
  return out + "</tr>\n";
}

}  // namespace

std::string table(const std::vector<std::string>& head, const std::vector<std::vector<Cell>>& rows,
                  std::size_t group) {
  std::string out = "<div class=\"scroll\"><table>\n";
  if (!head.empty()) out += head_row(head, rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
    out += table_row(rows[i], i + 1 == group && group < rows.size());
  return out + "</table></div>\n";
}

void write_page(const std::string& path, std::string_view html) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw FileError(folder.string() +
                    ": can't be made; a folder where files may be written would be valid");
  }
  WholeFile file(path);
  file.stream() << html;
  file.finish();
}

}  // namespace surefoot::report
