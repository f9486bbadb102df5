#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Drawing primitives of the report: an SVG image as text. Lengths in pixels; looks are CSS classes
/// (report_style.hpp), so that one image serves light and dark.
namespace surefoot::plot {

struct Point {
  double x = 0.0, y = 0.0;
};

/// Text with <, >, & and quotes made harmless.
[[nodiscard]] std::string escape(std::string_view text);
/// At most `decimals` decimals, without trailing zeros, with a true minus sign.
[[nodiscard]] std::string decimal(double value, int decimals);
/// With two digits, for values from 0 on: "42", "0.42", "1.3·10⁻⁴".
[[nodiscard]] std::string two_digits(double value);

/// About how wide a text of the report's size is [px]; no less than it is in usual fonts.
[[nodiscard]] double text_width(std::string_view text);

enum class Anchor { start, middle, end };

class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  void line(Point from, Point to, std::string_view style);
  void rectangle(Point corner, double width, double height, std::string_view style,
                 std::string_view tip = "");
  void circle(Point centre, double radius, std::string_view style, std::string_view tip = "");
  /// `path` in SVG's path language.
  void path(std::string_view path, std::string_view style, std::string_view tip = "");
  void polygon(const std::vector<Point>& corners, std::string_view style);
  void text(Point at, std::string_view text, std::string_view style, Anchor anchor = Anchor::start);
  /// Reads upwards.
  void vertical_text(Point at, std::string_view text, std::string_view style);

  /// What is drawn until `end_clip` is cut off at this rectangle.
  void begin_clip(Point corner, double width, double height);
  void end_clip() { body_ += "</svg>\n"; }

  /// The image; `description` is read to those who can't see it.
  [[nodiscard]] std::string image(std::string_view description) const;

 private:
  void element(std::string_view text, std::string_view tip, std::string_view name);

  double width_, height_;
  std::string body_;
};

/// Commands of a path through the points: "M1 2 3 4"; a NaN interrupts it.
[[nodiscard]] std::string path_through(const std::vector<Point>& points);

}  // namespace surefoot::plot
