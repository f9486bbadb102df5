#pragma once

#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace surefoot::test {

/// Random numbers that know their seed.
class SeededRandom : public RandomMatrices {
 public:
  explicit SeededRandom(int seed) : RandomMatrices(static_cast<std::uint64_t>(seed)), seed_(seed) {}
  [[nodiscard]] int seed() const { return seed_; }

 private:
  int seed_;
};

/// The seeds from 0 on; a failure tells which:
///
///     for (SeededRandom& random : Seeds(300)) …
class Seeds {
 public:
  struct End {
    int count;
  };
  class Round {
   public:
    Round() { start(); }
    SeededRandom& operator*() { return random_; }
    Round& operator++() {
      random_ = SeededRandom(random_.seed() + 1);
      start();
      return *this;
    }
    bool operator!=(const End& end) const { return random_.seed() < end.count; }

   private:
    void start() {
      trace_.reset();
      trace_.emplace(__FILE__, __LINE__, "seed " + std::to_string(random_.seed()));
    }
    SeededRandom random_{0};
    std::optional<testing::ScopedTrace> trace_;
  };

  explicit Seeds(int count) : count_(count) {}
  [[nodiscard]] static Round begin() { return {}; }
  [[nodiscard]] End end() const { return {count_}; }

 private:
  int count_;
};

}  // namespace surefoot::test
