#include "cli/experiments.hpp"

#include "cli/demo_page.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/evaluation/metrics.hpp"
#include "tests/config/messages.hpp"

#include <set>

namespace surefoot {
namespace {

using test::holds;

TEST(Experiments, every_one_can_be_read_and_shows_metrics_that_exist) {
  std::set<std::string> metrics, names;
  for (const auto& [name, value] : values(Metrics())) metrics.emplace(name);
  for (const Experiment& experiment : experiments()) {
    EXPECT_TRUE(names.insert(experiment.name).second) << experiment.name << " comes twice";
    const Scenario scenario = load_scenario({experiment.scenario, 1, experiment.assignments});
    EXPECT_FALSE(experiment.shown.empty()) << experiment.name;
    for (const std::string& metric : experiment.shown)
      EXPECT_TRUE(metrics.contains(metric)) << metric;
  }
}

TEST(Experiments, those_over_seeds_have_something_to_draw_and_pair) {
  std::vector<RandomDraw> first;
  for (const Experiment& experiment : experiments()) {
    if (!experiment.seeds) continue;
    const std::vector<RandomDraw> drawn =
        load_scenario({experiment.scenario, 1, experiment.assignments}).drawn;
    ASSERT_FALSE(drawn.empty()) << experiment.name;
    if (first.empty()) first = drawn;
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(drawn.at(i).value, first[i].value);
  }
  EXPECT_FALSE(first.empty());
}

TEST(DemoPage, names_links_and_escapes) {
  const std::string page = demo_page({{.name = "step <1>",
                                       .description = "a & b",
                                       .measured = "≤ 1 mm",
                                       .seeds = "3 of 4",
                                       .paper = "14 cm",
                                       .verdict = "✓",
                                       .report = "step/index.html"}},
                                     "all of it");
  EXPECT_TRUE(holds(page, "<a href=\"step/index.html\">step &lt;1&gt;</a>"));
  EXPECT_TRUE(holds(page, "a &amp; b"));
  EXPECT_TRUE(holds(page, "3 of 4"));
  EXPECT_FALSE(holds(page, "http"));
}

}  // namespace
}  // namespace surefoot
