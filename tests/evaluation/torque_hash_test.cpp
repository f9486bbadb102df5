#include "surefoot/evaluation/torque_hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace surefoot::evaluation {
namespace {

std::uint64_t hash_of(const std::vector<JointVector>& torques) {
  TorqueHash hash;
  for (const JointVector& torque : torques) hash.add(torque);
  return hash.value();
}

TEST(TorqueHash, differs_with_the_last_bit_of_one_torque_and_with_the_order_of_ticks) {
  const JointVector one = JointVector::Constant(kNumLegJoints, 1.0);
  const JointVector two = JointVector::Constant(kNumLegJoints, 2.0);
  JointVector near_one = one;
  near_one[7] = std::nextafter(1.0, 2.0);
  EXPECT_EQ(hash_of({one, two}), hash_of({one, two}));
  EXPECT_NE(hash_of({one, two}), hash_of({two, one}));
  EXPECT_NE(hash_of({one}), hash_of({near_one}));
  EXPECT_NE(hash_of({one}), hash_of({one, one}));
}

}  // namespace
}  // namespace surefoot::evaluation
