#include "cli/process_pool.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <stdexcept>

namespace surefoot {
namespace {

std::vector<JobOutcome> outcomes_of(const std::vector<Job>& jobs, int at_once) {
  std::vector<JobOutcome> outcomes(jobs.size());
  std::size_t finished = 0;
  run_in_processes(jobs, at_once, [&](std::size_t job, const JobOutcome& outcome) {
    outcomes[job] = outcome;
    ++finished;
  });
  EXPECT_EQ(finished, jobs.size());
  return outcomes;
}

TEST(ProcessPool, every_job_gives_its_output_in_its_place) {
  std::vector<Job> jobs;
  for (int i = 0; i < 7; ++i) jobs.emplace_back([i] { return "job " + std::to_string(i); });
  for (const int at_once : {1, 2, 20}) {
    const std::vector<JobOutcome> outcomes = outcomes_of(jobs, at_once);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      EXPECT_EQ(outcomes[i].output, "job " + std::to_string(i));
      EXPECT_EQ(outcomes[i].failure, "");
    }
  }
}

TEST(ProcessPool, a_crash_is_a_failure_of_its_job_alone) {
  const std::vector<JobOutcome> outcomes = outcomes_of({[] { return std::string("before"); },
                                                        []() -> std::string {
                                                          raise(SIGKILL);
                                                          return "never";
                                                        },
                                                        [] { return std::string("after"); }},
                                                       2);
  EXPECT_EQ(outcomes[0].output, "before");
  EXPECT_EQ(outcomes[1].failure, "the process was ended by: Killed");
  EXPECT_EQ(outcomes[2].output, "after");
}

TEST(ProcessPool, what_a_job_throws_is_its_failure) {
  const std::vector<JobOutcome> outcomes =
      outcomes_of({[]() -> std::string { throw std::runtime_error("no ground"); }}, 1);
  EXPECT_EQ(outcomes[0].failure, "no ground");
  EXPECT_EQ(outcomes[0].output, "");
}

TEST(ProcessPool, output_longer_than_a_pipe_arrives_whole) {
  const std::vector<JobOutcome> outcomes = outcomes_of(
      {[] { return std::string(3'000'000, 'a'); }, [] { return std::string(2'000'000, 'b'); }}, 2);
  EXPECT_EQ(outcomes[0].output, std::string(3'000'000, 'a'));
  EXPECT_EQ(outcomes[1].output, std::string(2'000'000, 'b'));
}

TEST(ProcessPool, jobs_run_in_other_processes) {
  EXPECT_NE(outcomes_of({[] { return std::to_string(getpid()); }}, 1)[0].output,
            std::to_string(getpid()));
}

}  // namespace
}  // namespace surefoot
