#pragma once

#include "surefoot/config/scenario_file.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace surefoot::test {

/// walk_flat with some keys laid over it.
class TrialScenario : public testing::Test {
 protected:
  config::Scenario read(const std::string& text, std::uint64_t seed = 0,
                        const std::vector<std::string>& assignments = {}) {
    write_file(folder_ / "trial.yaml", "base: walk_flat\n" + text);
    return config::load_scenario({folder_ / "trial.yaml", seed, assignments});
  }

  std::string complaint(const std::string& text, const std::vector<std::string>& assignments = {}) {
    return message_of([&] { (void)read(text, 0, assignments); });
  }

  TemporaryFolder folder_;
};

}  // namespace surefoot::test
