#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The HTML around the report's figures: one file, no scripts, no network, light and dark.
namespace surefoot::report {

/// A whole page; title and text are escaped, `body` is HTML.
[[nodiscard]] std::string page(std::string_view title, std::string_view body);

/// A numbered figure with its caption and a link to its file; empty if the image is empty. Counts
/// `number` up.
[[nodiscard]] std::string figure(int& number, const std::string& file, const std::string& image,
                                 std::string_view caption);

/// An image of the page as a file of its own, in light colours and without variables, which
/// programs other than browsers read as well.
[[nodiscard]] std::string svg_file(const std::string& image);

/// A table cell as text, or as HTML.
struct Cell {
  std::string text;
  std::string style = {};  ///< CSS classes
  bool is_html = false;
};
/// `head` may be empty; the first `group` rows are set apart by a rule from those below.
[[nodiscard]] std::string table(const std::vector<std::string>& head,
                                const std::vector<std::vector<Cell>>& rows, std::size_t group = 0);

/// Writes a file whole or not at all: under another name first. Makes the folder if there
/// is none. Throws FileError.
void write_text(const std::string& path, std::string_view text);

}  // namespace surefoot::report
