#include "surefoot/view/report_page.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/whole_file.hpp"
#include "surefoot/view/report_style.hpp"
#include "surefoot/view/svg.hpp"

#include <filesystem>

namespace surefoot::report {

std::string page(std::string_view title, std::string_view body) {
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         plot::escape(title) + "</title>\n<style>" + page_style() + "</style>\n</head>\n<body>\n" +
         std::string(body) + "</body>\n</html>\n";
}

std::string figure(int& number, const std::string& file, const std::string& image,
                   std::string_view caption) {
  if (image.empty()) return "";
  return "<figure>\n<div class=\"scroll\">" + image + "</div><figcaption><b>Figure " +
         std::to_string(++number) + ".</b> " + plot::escape(caption) +
         " <a class=\"file\" href=\"" + file + "\" download>Save as SVG</a></figcaption>\n" +
         "</figure>\n";
}

std::string svg_file(const std::string& image) {
  const std::size_t head = image.find('>') + 1;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + image.substr(4, head - 4) + "\n<style>" +
         image_style() + "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>" +
         image.substr(head);
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

void write_text(const std::string& path, std::string_view text) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw FileError(folder.string() +
                    ": can't be made; a folder where files may be written would be valid");
  }
  WholeFile file(path);
  file.stream() << text;
  file.finish();
}

}  // namespace surefoot::report
