#include "surefoot/view/axes.hpp"

#include "surefoot/view/time_figure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace surefoot::plot {
namespace {

std::vector<std::string> labels(double low, double high, int count) {
  std::vector<std::string> result;
  for (const Tick& tick : ticks({low, high}, count)) result.push_back(tick.label);
  return result;
}

using Labels = std::vector<std::string>;

TEST(Axes, TicksAreRoundNumbersInsideTheRange) {
  EXPECT_EQ(labels(0.0, 20.0, 10),
            (Labels{"0", "2", "4", "6", "8", "10", "12", "14", "16", "18", "20"}));
  EXPECT_EQ(labels(-0.06, 0.06, 5),
            (Labels{"−0.06", "−0.04", "−0.02", "0", "0.02", "0.04", "0.06"}));
  EXPECT_EQ(labels(0.0031, 0.0049, 4), (Labels{"0.0035", "0.004", "0.0045"}));
  EXPECT_EQ(labels(1000.0, 5000.0, 4), (Labels{"1000", "2000", "3000", "4000", "5000"}));
}

TEST(Axes, AnyRangeHasSomeTicksAndNotTooMany) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-8.0, 6.0), offset(-3.0, 3.0);
  for (int i = 0; i < 2000; ++i) {
    const double span = std::pow(10.0, exponent(random));
    const Range range{offset(random) * span, 0.0};
    const Range shifted{range.low, range.low + span};
    for (const int count : {3, 5, 10}) {
      const std::vector<Tick> all = ticks(shifted, count);
      ASSERT_GE(all.size(), 1u) << shifted.low << " " << span;
      ASSERT_LE(all.size(), static_cast<std::size_t>(2 * count + 1));
      for (const Tick& tick : all) {
        ASSERT_GE(tick.value, shifted.low - 1e-6 * span);
        ASSERT_LE(tick.value, shifted.high + 1e-6 * span);
      }
    }
  }
}

TEST(Axes, ARangeOfOneValueStillHasAWidth) {
  for (const double value : {0.0, 1.0, -3e8, 1e-12}) {
    Range range;
    range.add(value);
    EXPECT_GT(range.padded(0.1).span(), 0.0) << value;
  }
  EXPECT_GT(Range().padded(0.1).span(), 0.0);
}

TEST(Axes, NotANumberIsNotInTheRange) {
  Range range;
  range.add({1.0, std::nan(""), 3.0});
  EXPECT_EQ(range.low, 1.0);
  EXPECT_EQ(range.high, 3.0);
}

Frame frame_for(const Range& x, const Range& y) {
  return {.corner = {10.0, 20.0}, .width = 800.0, .height = 100.0, .x = x, .y = y};
}

TEST(ThinnedCurve, KeepsEverySpikeOfALongNoisyCurve) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise;
  std::vector<double> x, y;
  for (int i = 0; i < 100000; ++i) {
    x.push_back(i * 0.0025);
    y.push_back(noise(random));
  }
  y[31234] = 9.0;
  y[77777] = -8.0;
  const Frame frame = frame_for({0.0, 250.0}, {-10.0, 10.0});
  const std::vector<Point> thin = thinned_curve(frame, x, y);
  EXPECT_LT(thin.size(), 3300u);
  // Each sample lies between the lowest and highest drawn point of its pixel column and its
  // neighbours.
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::abs(y[i]) < 3.5) continue;
    const Point exact = frame.at(x[i], y[i]);
    const bool drawn = std::any_of(thin.begin(), thin.end(), [&](const Point& point) {
      return std::abs(point.x - exact.x) < 1.0 &&
             (y[i] > 0.0 ? point.y <= exact.y + 0.3 : point.y >= exact.y - 0.3);
    });
    ASSERT_TRUE(drawn) << "sample " << i;
  }
}

TEST(ThinnedCurve, NeedsFewPointsForASmoothCurveAndStaysOnIt) {
  std::vector<double> x, y;
  for (int i = 0; i <= 8000; ++i) {
    x.push_back(i * 0.0025);
    y.push_back(std::sin(x.back()));
  }
  const Frame frame = frame_for({0.0, 20.0}, {-1.1, 1.1});
  const std::vector<Point> thin = thinned_curve(frame, x, y);
  EXPECT_LT(thin.size(), 200u);
  for (std::size_t i = 0; i + 1 < thin.size(); ++i) {
    const double middle = (thin[i].x + thin[i + 1].x) / 2.0;
    const double time = (middle - frame.corner.x) / frame.width * 20.0;
    EXPECT_NEAR((thin[i].y + thin[i + 1].y) / 2.0, frame.px_y(std::sin(time)), 0.4);
  }
}

TEST(ThinnedCurve, IsInterruptedWhereThereIsNoValue) {
  const double none = std::nan("");
  const auto thin = thinned_curve(frame_for({0.0, 5.0}, {0.0, 1.0}), {0, 1, 2, 3, 4, 5},
                                  {0.0, 0.5, none, none, 1.0, 0.0});
  EXPECT_EQ(path_through(thin), "M10 120 170 70M650 20 810 120");
}

TEST(Svg, TextIsMadeHarmless) {
  EXPECT_EQ(escape("<script>\"a\" & b"), "&lt;script&gt;&quot;a&quot; &amp; b");
  Svg svg(10.0, 10.0);
  svg.text({1.0, 1.0}, "<b>", "tick");
  EXPECT_EQ(svg.image("a<b").find("<b>"), std::string::npos);
}

TEST(Svg, NumbersHaveNoTrailingZerosAndATrueMinus) {
  EXPECT_EQ(decimal(-0.25, 4), "−0.25");
  EXPECT_EQ(decimal(100.0, 2), "100");
  EXPECT_EQ(decimal(-0.0001, 2), "0");
  EXPECT_EQ(decimal(std::nan(""), 2), "–");
}

TEST(TimeFigure, ShowsTitlesLabelsLegendAndBounds) {
  const std::string image = draw({.description = "what it shows",
                                  .x = {0.0, 1.0, 2.0},
                                  .panels = {{.title = "(a) title",
                                              .y_label = "error [mm]",
                                              .curves = {{"true", "line c0", {0.0, 1.0, 0.0}},
                                                         {"desired", "line c1", {0.0, 0.5, 0.0}}},
                                              .spans = {{0.5, 1.0, "stance"}},
                                              .bounds = {{1.5, "upper limit"}}}}});
  for (const char* text : {"what it shows", "(a) title", "error [mm]", ">true<", ">desired<",
                           ">upper limit<", "time [s]", "class=\"stance\"", "class=\"bound\""}) {
    EXPECT_NE(image.find(text), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace surefoot::plot
