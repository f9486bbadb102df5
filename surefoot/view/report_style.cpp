#include "surefoot/view/report_style.hpp"

namespace surefoot::report {
namespace {

// Colours c0 … c3 (legs LF, RF, LH, RH) are those of Okabe and Ito, lighter on dark ground.
constexpr std::string_view kLight = R"css(
  --ground: #ffffff; --ink: #1c1f23; --soft: #5c636b; --rule: #d9dde1; --grid: #e8ebee; --card: #f6f7f8;
  --c0: #0072b2; --c1: #d55e00; --c2: #009e73; --c3: #aa4499; --c5: #8a6d00; --bound: #7a1f1f;
  --good: #00704f; --bad: #b3261e; --stance: #5c636b; --search: #c9a100;
  --g0: #ffffff; --g1: #f7f7f6; --g2: #f0f0ee; --g3: #e9e9e6; --g4: #e1e1dd;)css";
constexpr std::string_view kDark = R"css(
  --ground: #14171a; --ink: #e8eaed; --soft: #a3abb3; --rule: #363c42; --grid: #262b30; --card: #1c2024;
  --c0: #56b4e9; --c1: #f5934e; --c2: #3fc99c; --c3: #d070c0; --c5: #e0c34a; --bound: #ff9b94;
  --good: #59d2a5; --bad: #ff8a80; --stance: #a3abb3; --search: #d9a800;
  --g0: #2b3137; --g1: #262b31; --g2: #20252a; --g3: #1a1e22; --g4: #0f1113;)css";
constexpr std::string_view kPage = R"css(
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
.good { color: var(--good); } .bad { color: var(--bad); } .soft, .basis { color: var(--soft); }
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
.pictures img, .pictures video { display: block; max-width: 100%; height: auto; border-radius: .4rem; background: var(--card); }
figcaption { font-size: .9rem; color: var(--soft); margin-top: .4rem; max-width: 50rem; }
figcaption b { color: var(--ink); }
.file { white-space: nowrap; }
details { margin: 1rem 0; } summary { cursor: pointer; color: var(--soft); }
a { color: var(--c0); }
svg.plot { display: block; width: 100%; min-width: 42rem; height: auto; font: 12px system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
)css";
constexpr std::string_view kPlot = R"css(
text { fill: var(--ink); font-variant-numeric: tabular-nums; }
text.tick, text.note { font-size: 11px; fill: var(--soft); }
text.note { font-style: italic; }
text.panel-title { font-weight: 600; }
.frame { fill: none; stroke: var(--ink); stroke-width: 1; }
.grid { fill: none; stroke: var(--grid); stroke-width: 1; }
.line { fill: none; stroke-width: 1.4; stroke-linejoin: round; stroke-linecap: butt; }
.thick { stroke-width: 5; }
.dashed { stroke-dasharray: 6 3.5; }
.dotted { stroke-dasharray: 2 3; }
.c0 { stroke: var(--c0); } .c1 { stroke: var(--c1); } .c2 { stroke: var(--c2); } .c3 { stroke: var(--c3); }
.c5 { stroke: var(--c5); } .ink { stroke: var(--ink); }
.bound { fill: none; stroke: var(--bound); stroke-width: 1.1; stroke-dasharray: 8 3 2 3; }
.stance { fill: var(--stance); fill-opacity: .14; } .search { fill: var(--search); fill-opacity: .35; }
.calibration { fill: var(--c5); fill-opacity: .7; }
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
)css";
constexpr std::string_view kPrint = R"css(
@media print { body { max-width: none; padding: 0; font-size: 11pt; } figure { break-inside: avoid; }
  svg.plot { min-width: 0; } .file, video { display: none; } }
)css";
// Of an image that stands alone.
constexpr std::string_view kAlone = R"css(
text { font-family: "Helvetica Neue", Arial, sans-serif; font-size: 12px; })css";

// Value of a variable of the page in light colours.
std::string_view light(std::string_view name) {
  const std::size_t begin = kLight.find(std::string(name) + ": ") + name.size() + 2;
  return kLight.substr(begin, kLight.find(';', begin) - begin);
}

}  // namespace

std::string page_style() {
  std::string style = ":root { color-scheme: light dark;";
  style += std::string(kLight) + " }\n@media (prefers-color-scheme: dark) { :root {";
  style += std::string(kDark) + " } }";
  return style + std::string(kPage) + std::string(kPlot) + std::string(kPrint);
}

std::string image_style() {
  constexpr std::string_view kVariable = "var(";
  std::string style = std::string(kAlone) + std::string(kPlot);
  for (std::size_t at = style.find(kVariable); at != std::string::npos;
       at = style.find(kVariable, at)) {
    const std::size_t end = style.find(')', at), name = at + kVariable.size();
    style.replace(at, end + 1 - at, light(style.substr(name, end - name)));
  }
  return style;
}

}  // namespace surefoot::report
