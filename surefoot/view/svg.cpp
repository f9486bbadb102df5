#include "surefoot/view/svg.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace surefoot::plot {
namespace {

// A coordinate: a tenth of a pixel is enough.
std::string px(double value) {
  const double rounded = std::round(10.0 * value) / 10.0;
  std::array<char, 32> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), rounded == 0.0 ? 0.0 : rounded).ptr;
  return {text.data(), end};
}

std::string attribute(std::string_view name, double value) {
  return " " + std::string(name) + "=\"" + px(value) + "\"";
}

std::string css(std::string_view style) { return " class=\"" + std::string(style) + "\""; }

std::string superscript(int number) {
  constexpr std::array<const char*, 10> kDigits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string digits;
  for (const char digit : std::to_string(std::abs(number)))
    digits += kDigits[static_cast<std::size_t>(digit - '0')];
  return (number < 0 ? "⁻" : "") + digits;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

// Letters are bytes that do not continue a UTF-8 sequence.
double text_width(std::string_view text) {
  constexpr double kLetter = 6.3;
  return kLetter * static_cast<double>(std::ranges::count_if(text, [](char c) {
           return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
         }));
}

std::string decimal(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), std::abs(value),
                                 std::chars_format::fixed, decimals)
                       .ptr;
  std::string digits(text.data(), end);
  if (digits.find('.') != std::string::npos) {
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
  }
  return value < 0.0 && digits != "0" ? "−" + digits : digits;
}

std::string two_digits(double value) {
  const int power = value > 0.0 ? static_cast<int>(std::floor(std::log10(value))) : 0;
  if (power >= -2) return decimal(value, std::max(0, 1 - power));
  return decimal(value / std::pow(10.0, power), 1) + "·10" + superscript(power);
}

void Svg::element(std::string_view text, std::string_view tip, std::string_view name) {
  body_ += text;
  if (tip.empty()) {
    body_ += "/>\n";
  } else {
    body_ += "><title>" + escape(tip) + "</title></" + std::string(name) + ">\n";
  }
}

void Svg::line(Point from, Point to, std::string_view style) {
  path("M" + px(from.x) + " " + px(from.y) + " " + px(to.x) + " " + px(to.y), style);
}

void Svg::rectangle(Point corner, double width, double height, std::string_view style,
                    std::string_view tip) {
  element("<rect" + attribute("x", corner.x) + attribute("y", corner.y) +
              attribute("width", width) + attribute("height", height) + css(style),
          tip, "rect");
}

void Svg::circle(Point centre, double radius, std::string_view style, std::string_view tip) {
  element("<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) +
              attribute("r", radius) + css(style),
          tip, "circle");
}

void Svg::path(std::string_view path, std::string_view style, std::string_view tip) {
  if (path.empty()) return;
  element("<path d=\"" + std::string(path) + "\"" + css(style), tip, "path");
}

void Svg::polygon(const std::vector<Point>& corners, std::string_view style) {
  path(path_through(corners) + "z", style);
}

void Svg::text(Point at, std::string_view text, std::string_view style, Anchor anchor) {
  constexpr std::array<std::string_view, 3> kAnchors{"", " text-anchor=\"middle\"",
                                                     " text-anchor=\"end\""};
  body_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + css(style);
  body_ += kAnchors[static_cast<std::size_t>(anchor)];
  body_ += ">" + escape(text) + "</text>\n";
}

void Svg::vertical_text(Point at, std::string_view text, std::string_view style) {
  body_ += "<text text-anchor=\"middle\" transform=\"translate(" + px(at.x) + " " + px(at.y) +
           ") rotate(-90)\"" + css(style) + ">" + escape(text) + "</text>\n";
}

void Svg::begin_clip(Point corner, double width, double height) {
  const std::string box = px(corner.x) + " " + px(corner.y) + " " + px(width) + " " + px(height);
  body_ += "<svg" + attribute("x", corner.x) + attribute("y", corner.y) +
           attribute("width", width) + attribute("height", height) + " viewBox=\"" + box + "\">\n";
}

std::string Svg::image(std::string_view description) const {
  return "<svg class=\"plot\"" + attribute("width", width_) + attribute("height", height_) +
         " viewBox=\"0 0 " + px(width_) + " " + px(height_) + "\" role=\"img\" aria-label=\"" +
         escape(description) + "\">\n" + body_ + "</svg>\n";
}

std::string path_through(const std::vector<Point>& points) {
  std::string out;
  bool pen_down = false;
  for (const Point& point : points) {
    if (std::isnan(point.x) || std::isnan(point.y)) {
      pen_down = false;
      continue;
    }
    out += pen_down ? " " : "M";
    out += px(point.x) + " " + px(point.y);
    pen_down = true;
  }
  return out;
}

}  // namespace surefoot::plot
