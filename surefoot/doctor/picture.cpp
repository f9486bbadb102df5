#include "surefoot/doctor/picture.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/skeleton.hpp"
#include "surefoot/logging/output_files.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::doctor {
namespace {

constexpr double kWidth = 400.0, kMargin = 240.0, kTop = 40.0, kBelow = 30.0;  // pixels of a view
constexpr double kHeight = 600.0;                                              // at most
constexpr double kLine = 16.0;                                                 // of text
constexpr double kArrow = 34.0;                                                // of an axis
constexpr double kEdgeOn = 0.2;  // an axis whose share in the picture is less points to us or away
constexpr std::array<const char*, kMaxLegs> kColours{"#0072b2", "#d55e00", "#009e73",
                                                     "#aa4499", "#b8860b", "#56b4e9"};
constexpr const char* kOther = "#777777";
constexpr const char* kBlack = "#222222";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return result;
}

const char* colour_of(const DrawnLimb& limb) {
  return limb.leg ? kColours[index(*limb.leg)] : kOther;
}

/// From where the robot is looked at: the axes that point right, up and to us.
struct Side {
  const char* title;
  Vec3 right, up, near;
};

struct Point {
  double x, y;
};

/// What stands at the margin, with a line to its place.
struct Label {
  std::string text;
  const char* colour;
  Point at;
};

/// One view, drawn as SVG.
class View {
 public:
  View(const Skeleton& robot, const Side& side, double scale, double top)
      : robot_(robot), side_(side), scale_(scale) {
    low_ = high_ = {u(robot.com), v(robot.com)};
    for (const DrawnLimb& limb : robot.limbs) {
      for (const JointPlace& joint : limb.joints) stretch(joint.p, 0.0);
      stretch(limb.tip, limb.radius);
    }
    origin_ = {kMargin + 0.5 * kWidth - 0.5 * scale * (low_.x + high_.x),
               top + kTop + scale * high_.y};
    bottom_ = origin_.y - scale * low_.y + kBelow;
    text(12.0, top + 18.0, "start", kBlack, side.title);
  }

  /// Of the robot, across [m].
  [[nodiscard]] double width() const { return high_.x - low_.x; }
  [[nodiscard]] double height() const { return high_.y - low_.y; }

  void draw(bool above) {
    draw_trunk();
    for (const bool is_far : {true, false}) {
      for (const DrawnLimb& limb : robot_.limbs) {
        if (is_far_side(limb) == is_far) draw_limb(limb, is_far && !above);
      }
    }
    draw_com();
    draw_base();
    for (const DrawnLimb& limb : robot_.limbs) {
      if (above) {
        label_leg(limb);
      } else if (!is_far_side(limb)) {
        label_joints(limb);
      }
    }
    draw_labels();
  }

  [[nodiscard]] double bottom() const { return bottom_; }
  [[nodiscard]] const std::string& svg() const { return svg_; }

 private:
  [[nodiscard]] double u(const Vec3& p) const { return side_.right.dot(p); }
  [[nodiscard]] double v(const Vec3& p) const { return side_.up.dot(p); }
  [[nodiscard]] Point at(const Vec3& p) const {
    return {origin_.x + scale_ * u(p), origin_.y - scale_ * v(p)};
  }
  [[nodiscard]] bool is_far_side(const DrawnLimb& limb) const {
    return side_.near.dot(limb.tip) < 0.0;
  }
  void stretch(const Vec3& p, double radius) {
    low_ = {std::min(low_.x, u(p) - radius), std::min(low_.y, v(p) - radius)};
    high_ = {std::max(high_.x, u(p) + radius), std::max(high_.y, v(p) + radius)};
  }

  void line(Point a, Point b, const char* colour, double width, double opacity = 1.0) {
    svg_ += formatted(
        "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\" stroke-width=\"%.1f\" "
        "stroke-linecap=\"round\" opacity=\"%.2f\"/>\n",
        a.x, a.y, b.x, b.y, colour, width, opacity);
  }
  void circle(Point c, double radius, const char* fill, const char* stroke, double opacity = 1.0) {
    svg_ += formatted(
        "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\" stroke=\"%s\" "
        "stroke-width=\"1.5\" opacity=\"%.2f\"/>\n",
        c.x, c.y, radius, fill, stroke, opacity);
  }
  void text(double x, double y, const char* anchor, const char* colour, const std::string& words) {
    svg_ += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\">", x, y, anchor,
                      colour) +
            escaped(words) + "</text>\n";
  }

  /// A closed line through where the limbs leave the base.
  void draw_trunk() {
    const std::ptrdiff_t num_legs = std::ranges::count_if(
        robot_.limbs, [](const DrawnLimb& limb) { return limb.leg.has_value(); });
    if (num_legs == 0) return;
    std::vector<std::ptrdiff_t> around{0};  // to the hind leg on the right, and back on the left
    for (std::ptrdiff_t right = 1; right < num_legs; right += 2) around.push_back(right);
    for (std::ptrdiff_t left = num_legs - 2; left >= 0; left -= 2) around.push_back(left);
    const auto hip = [&](std::ptrdiff_t limb) {
      return at(robot_.limbs[static_cast<std::size_t>(limb)].joints.front().p);
    };
    for (std::size_t i = 1; i < around.size(); ++i)
      line(hip(around[i - 1]), hip(around[i]), kOther, 5.0, 0.35);
  }

  void draw_limb(const DrawnLimb& limb, bool is_pale) {
    const double opacity = is_pale ? 0.25 : 1.0;
    const char* colour = colour_of(limb);
    Point before = at(limb.joints.front().p);
    for (const JointPlace& joint : limb.joints) {
      line(before, at(joint.p), colour, 3.0, opacity);
      before = at(joint.p);
    }
    line(before, at(limb.tip), colour, 3.0, opacity);
    if (limb.radius > 0.0) circle(at(limb.tip), scale_ * limb.radius, "none", colour, opacity);
    if (is_pale) return;
    for (const JointPlace& joint : limb.joints) draw_axis(joint, colour);
  }

  /// An arrow along the axis; ⊙ where it points to us, ⊗ where it points away.
  void draw_axis(const JointPlace& joint, const char* colour) {
    const Point p = at(joint.p);
    const Point d{u(joint.axis), -v(joint.axis)};
    const double length = std::hypot(d.x, d.y);
    if (length < kEdgeOn) {
      circle(p, 6.0, "#ffffff", colour);
      if (side_.near.dot(joint.axis) > 0.0) return circle(p, 2.0, colour, colour);
      line({p.x - 4.0, p.y - 4.0}, {p.x + 4.0, p.y + 4.0}, colour, 1.5);
      return line({p.x - 4.0, p.y + 4.0}, {p.x + 4.0, p.y - 4.0}, colour, 1.5);
    }
    const Point tip{p.x + kArrow * d.x, p.y + kArrow * d.y};
    line(p, tip, colour, 1.5);
    for (const double side : {-1.0, 1.0}) {
      line(tip,
           {tip.x - (7.0 * d.x + side * 3.5 * d.y) / length,
            tip.y - (7.0 * d.y - side * 3.5 * d.x) / length},
           colour, 1.5);
    }
    circle(p, 3.0, colour, colour);
  }

  void draw_com() {
    const Point p = at(robot_.com);
    circle(p, 7.0, "#ffffff", kBlack);
    line({p.x - 7.0, p.y}, {p.x + 7.0, p.y}, kBlack, 1.5);
    line({p.x, p.y - 7.0}, {p.x, p.y + 7.0}, kBlack, 1.5);
    labels_.push_back({formatted("centre of mass, %.2f kg", robot_.mass), kBlack, p});
  }

  void draw_base() {
    constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      const JointPlace axis{"", Vec3::Zero(), Vec3::Unit(i)};
      if (std::hypot(u(axis.axis), v(axis.axis)) < kEdgeOn) continue;
      draw_axis(axis, kBlack);
      const Point p = at(Vec3::Zero());
      text(p.x + 1.35 * kArrow * u(axis.axis), p.y - 1.35 * kArrow * v(axis.axis) + 4.0, "middle",
           kBlack, kNames[static_cast<std::size_t>(i)]);
    }
  }

  void label_joints(const DrawnLimb& limb) {
    const char* colour = colour_of(limb);
    for (const JointPlace& joint : limb.joints)
      labels_.push_back({joint.name, colour, at(joint.p)});
    if (limb.foot.empty()) return;
    labels_.push_back(
        {limb.foot + formatted(", r %.0f mm", 1e3 * limb.radius), colour, at(limb.tip)});
  }

  void label_leg(const DrawnLimb& limb) {
    const std::string name = limb.name.empty() ? limb.joints.front().name : limb.name;
    labels_.push_back({name, colour_of(limb), at(limb.tip)});
  }

  /// At the left and the right margin, ordered as their places are, without overlap.
  void draw_labels() {
    const double middle = kMargin + 0.5 * kWidth;
    std::ranges::stable_sort(labels_, {}, [](const Label& label) { return label.at.y; });
    for (const bool is_left : {true, false}) {
      double y = -kInfinity;
      const double x = is_left ? kMargin - kArrow - 6.0 : kMargin + kWidth + kArrow + 6.0;
      for (const Label& label : labels_) {
        if ((label.at.x < middle) != is_left) continue;
        y = std::max(y + kLine, label.at.y);
        line(label.at, {x, y}, label.colour, 0.6, 0.6);
        text(is_left ? x - 4.0 : x + 4.0, y + 4.0, is_left ? "end" : "start", label.colour,
             label.text);
      }
      bottom_ = std::max(bottom_, y + kLine);
    }
  }

  const Skeleton& robot_;
  const Side& side_;
  double scale_;
  Point low_{}, high_{}, origin_{};
  double bottom_ = 0.0;
  std::string svg_;
  std::vector<Label> labels_;
};

}  // namespace

std::string picture(const Diagnosis& robot) {
  const Skeleton skeleton = skeleton_of(robot);
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const std::array<Side, 3> sides{Side{"from the right", x, z, -y}, Side{"from the left", -x, z, y},
                                  Side{"from above", x, y, z}};
  const View whole_robot(skeleton, sides[0], 1.0, 0.0);
  const double scale =
      1.0 / std::max({whole_robot.width() / kWidth, whole_robot.height() / kHeight, 1e-5});
  double top = kLine;
  std::string views;
  for (const Side& side : sides) {
    View view(skeleton, side, scale, top);
    view.draw(&side == &sides.back());
    views += view.svg();
    top = view.bottom();
  }
  const double whole = kWidth + 2.0 * kMargin;
  return formatted(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
             "font-family=\"sans-serif\" font-size=\"12\" fill=\"none\">\n",
             whole, top + kLine) +
         "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + views + "</svg>\n";
}

std::filesystem::path write_picture(const Diagnosis& robot,
                                    const std::filesystem::path& robot_file) {
  std::filesystem::path file = robot_file;
  file.replace_extension(".svg");
  logging::write_file(file, picture(robot));
  return file;
}

}  // namespace surefoot::doctor
