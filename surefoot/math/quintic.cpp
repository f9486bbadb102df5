#include "surefoot/math/quintic.hpp"

namespace surefoot {

// With s = t/T the six basis polynomials of the boundary values; those of v and a carry T and T².
HermiteWeights hermite_position(double t, double T) {
  const double s = t / T, s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
  HermiteWeights w;
  w << 1.0 - 10.0 * s3 + 15.0 * s4 - 6.0 * s5, T * (s - 6.0 * s3 + 8.0 * s4 - 3.0 * s5),
      T * T * 0.5 * (s2 - 3.0 * s3 + 3.0 * s4 - s5), 10.0 * s3 - 15.0 * s4 + 6.0 * s5,
      T * (-4.0 * s3 + 7.0 * s4 - 3.0 * s5), T * T * 0.5 * (s3 - 2.0 * s4 + s5);
  return w;
}

HermiteWeights hermite_velocity(double t, double T) {
  const double s = t / T, s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  HermiteWeights w;
  w << (-30.0 * s2 + 60.0 * s3 - 30.0 * s4) / T, 1.0 - 18.0 * s2 + 32.0 * s3 - 15.0 * s4,
      T * 0.5 * (2.0 * s - 9.0 * s2 + 12.0 * s3 - 5.0 * s4),
      (30.0 * s2 - 60.0 * s3 + 30.0 * s4) / T, -12.0 * s2 + 28.0 * s3 - 15.0 * s4,
      T * 0.5 * (3.0 * s2 - 8.0 * s3 + 5.0 * s4);
  return w;
}

HermiteWeights hermite_acceleration(double t, double T) {
  const double s = t / T, s2 = s * s, s3 = s2 * s;
  HermiteWeights w;
  w << (-60.0 * s + 180.0 * s2 - 120.0 * s3) / (T * T), (-36.0 * s + 96.0 * s2 - 60.0 * s3) / T,
      0.5 * (2.0 - 18.0 * s + 36.0 * s2 - 20.0 * s3),
      (60.0 * s - 180.0 * s2 + 120.0 * s3) / (T * T), (-24.0 * s + 84.0 * s2 - 60.0 * s3) / T,
      0.5 * (6.0 * s - 24.0 * s2 + 20.0 * s3);
  return w;
}

}  // namespace surefoot
