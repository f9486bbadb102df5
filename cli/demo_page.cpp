#include "cli/demo_page.hpp"

namespace surefoot {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Surefoot: the paper's experiments</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; max-width: 80rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
h1 { font-size: 1.5rem; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .45rem .7rem; border-bottom: 1px solid #ddd; }
th { border-bottom: 2px solid #666; }
td small { color: #666; }
.ok { color: #14703c; } .bad { color: #b3261e; }
</style>
</head>
<body>
<h1>The paper's experiments</h1>
)";

/// Text with <, >, & and quotes made harmless.
std::string escape(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const char* entity = c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : nullptr;
    if (c == '"') entity = "&quot;";
    entity == nullptr ? out += c : out += entity;
  }
  return out;
}

std::string cell(const std::string& content) { return "<td>" + content + "</td>"; }

std::string linked(const DemoRow& row) {
  if (row.report.empty()) return escape(row.name);
  return "<a href=\"" + escape(row.report) + "\">" + escape(row.name) + "</a>";
}

std::string verdict(const DemoRow& row) {
  const std::string style = row.verdict == "✓" ? "ok" : row.verdict == "✗" ? "bad" : "";
  return "<span class=\"" + style + "\">" + escape(row.verdict) + "</span>";
}

}  // namespace

std::string demo_page(const std::vector<DemoRow>& rows, const std::string& summary) {
  std::string page = kHead;
  page += "<p>" + escape(summary) +
          "</p>\n<table>\n<tr><th>experiment</th><th>measured</th>"
          "<th>random seeds</th><th></th><th>paper</th></tr>\n";
  for (const DemoRow& row : rows) {
    page += "<tr>" + cell(linked(row) + "<br><small>" + escape(row.description) + "</small>") +
            cell(escape(row.measured)) + cell(escape(row.seeds)) + cell(verdict(row)) +
            cell(escape(row.paper)) + "</tr>\n";
  }
  return page + "</table>\n</body>\n</html>\n";
}

}  // namespace surefoot
