#include "surefoot/evaluation/landing.hpp"

#include "surefoot/signals/sensor_reading.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::evaluation {
namespace {

constexpr double kDegree = kPi / 180.0;

// 14 cm lower from x = 1 m on.
double step(double x, double) { return x < 1.0 ? 0.0 : -0.14; }

TerrainHeight slope(double angle) {
  return [angle](double x, double) { return std::tan(angle) * x; };
}
Vec3 slope_normal(double angle) { return {-std::sin(angle), 0.0, std::cos(angle)}; }

bool on_step(double x, double y = 0.3) {
  return is_edge_landing(step, {x, y, step(x, y)}, Vec3::UnitZ());
}

TEST(EdgeLanding, IsWithinTwoCentimetresOfAStep) {
  for (const double distance : {-0.0195, -0.012, -0.004, 0.0, 0.004, 0.012, 0.0195}) {
    EXPECT_TRUE(on_step(1.0 + distance)) << distance;
  }
  for (const double distance : {-0.5, -0.1, -0.021, 0.021, 0.1, 0.5})
    EXPECT_FALSE(on_step(1.0 + distance)) << distance;
}

TEST(EdgeLanding, IsFoundAtAnyDirectionOfTheStep) {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const Vec2 across(std::cos(degrees * kDegree), std::sin(degrees * kDegree));
    const TerrainHeight terrain = [&](double x, double y) {
      return across.dot(Vec2(x, y)) < 0.0 ? 0.0 : 0.05;
    };
    const auto lands_on_edge = [&](double distance) {
      const Vec2 p = distance * across;
      return is_edge_landing(terrain, {p.x(), p.y(), terrain(p.x(), p.y())}, Vec3::UnitZ());
    };
    EXPECT_TRUE(lands_on_edge(0.018));
    EXPECT_TRUE(lands_on_edge(-0.018));
    EXPECT_FALSE(lands_on_edge(0.022));
    EXPECT_FALSE(lands_on_edge(-0.022));
  }
}

TEST(EdgeLanding, IsNotASlopeHoweverSteep) {
  for (const double angle : {0.0, 15.0, 30.0, 45.0, 60.0}) {
    EXPECT_FALSE(
        is_edge_landing(slope(angle * kDegree), {0.3, 0.1, 0.0}, slope_normal(angle * kDegree)))
        << angle;
  }
}

TEST(EdgeLanding, IsAContactNormalThatLeansFromTheTerrains) {
  const double slope_angle = 10.0 * kDegree;
  const auto lands_on_edge = [&](double lean) {
    return is_edge_landing(slope(slope_angle), {0.0, 0.0, 0.0},
                           slope_normal(slope_angle + lean * kDegree));
  };
  EXPECT_FALSE(lands_on_edge(14.0));
  EXPECT_FALSE(lands_on_edge(-14.0));
  EXPECT_TRUE(lands_on_edge(16.0));
  EXPECT_TRUE(lands_on_edge(-16.0));
}

TEST(EdgeLanding, IsNotASmallUnevenness) {
  const TerrainHeight terrain = [](double x, double) { return x < 0.0 ? 0.0 : 0.01; };
  EXPECT_FALSE(is_edge_landing(terrain, {-0.01, 0.0, 0.0}, Vec3::UnitZ()));
}

TEST(EdgeLanding, IsWhereTheTerrainEnds) {
  const TerrainHeight terrain = [](double x, double) { return x < 1.0 ? 0.0 : kNaN; };
  EXPECT_TRUE(is_edge_landing(terrain, {0.99, 0.0, 0.0}, Vec3::UnitZ()));
  EXPECT_FALSE(is_edge_landing(terrain, {0.9, 0.0, 0.0}, Vec3::UnitZ()));
}

TEST(EdgeLanding, IsOnTopOfAPole) {
  const TerrainHeight terrain = [](double x, double y) {
    return std::hypot(x, y) < 0.008 ? 0.1 : 0.0;
  };
  EXPECT_TRUE(is_edge_landing(terrain, {0.002, 0.0, 0.1}, Vec3::UnitZ()));
}

TEST(EdgeLanding, IsWithinACentimetreOfAStepForARobotHalfAsLarge) {
  const auto lands_on_edge = [](double x) {
    return is_edge_landing(step, {x, 0.3, step(x, 0.3)}, Vec3::UnitZ(), {.length = 0.5});
  };
  EXPECT_TRUE(lands_on_edge(1.008));
  EXPECT_FALSE(lands_on_edge(1.012));
}

}  // namespace
}  // namespace surefoot::evaluation
