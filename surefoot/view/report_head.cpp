#include "surefoot/view/report_head.hpp"

#include "surefoot/signals/plan_event.hpp"
#include "surefoot/view/report_numbers.hpp"
#include "surefoot/view/report_page.hpp"
#include "surefoot/view/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot::report {
namespace {

using plot::decimal;
using plot::escape;

std::string badge(const char* style, const std::string& text) {
  return std::string("<div class=\"verdict ") + style + "\">" + escape(text) + "</div>\n";
}

std::string warning(const std::string& text) {
  return "<p class=\"warning\">" + escape(text) + "</p>\n";
}

std::string end_time(const RunData& run) {
  return decimal(run.ticks.back().time + run.header.control_period, 2) + " s";
}

// How often something happened, and when first.
struct Happening {
  std::string what;
  int count = 0;
  double first = 0.0;
};

Happening count(const RunData& run, const std::string& what,
                bool (*happens)(const TickSample& tick, int), int argument) {
  Happening result{.what = what};
  for (const TickSample& tick : run.ticks) {
    if (happens(tick, argument) && result.count++ == 0) result.first = tick.time;
  }
  return result;
}

std::vector<Happening> troubles(const RunData& run) {
  constexpr std::array kEvents{PlanEvent::no_ground, PlanEvent::lost_contact,
                               PlanEvent::lift_off_aborted, PlanEvent::collision,
                               PlanEvent::caught};
  std::vector<Happening> result;
  for (const PlanEvent event : kEvents) {
    result.push_back(count(
        run, std::string(name(event)),
        [](const TickSample& tick, int number) {
          return tick.plan.events.has(static_cast<PlanEvent>(number));
        },
        static_cast<int>(event)));
  }
  result.push_back(count(
      run, "tick whose command is not the hierarchy's optimum",
      [](const TickSample& tick, int) { return tick.mode != CommandMode::optimal; }, 0));
  std::erase_if(result, [](const Happening& one) { return one.count == 0; });
  return result;
}

std::string trouble_list(const RunData& run) {
  const std::vector<Happening> list = troubles(run);
  if (list.empty()) return "";
  std::string out = "<ul class=\"troubles\">\n";
  for (const Happening& one : list) {
    out += "<li><b>" + std::to_string(one.count) + " ×</b> " + escape(one.what) +
           (one.count > 1 ? ", first at " : ", at ") + decimal(one.first, 4) + " s</li>\n";
  }
  return out + "</ul>\n";
}

// In the order of their begin; by hand there can be many.
std::string push_list(const RunData& run) {
  constexpr std::size_t kMost = 12;
  if (run.applied.empty()) return "";
  const std::vector<std::string> bodies = body_names(run.header);
  std::string out = "<ul class=\"pushes\">\n";
  for (std::size_t i = 0; i < std::min(run.applied.size(), kMost); ++i) {
    const AppliedForce& force = run.applied[i];
    out += "<li>Pushed by " + escape(applied_force_text(force, bodies)) + ", from " +
           decimal(force.from, 2) + " s to " +
           (std::isnan(force.to) ? "the end" : decimal(force.to, 2) + " s") + "</li>\n";
  }
  if (run.applied.size() > kMost)
    out += "<li>and " + std::to_string(run.applied.size() - kMost) + " times more</li>\n";
  return out + "</ul>\n";
}

std::string criteria_badge(const Outcome& outcome) {
  std::string missed;
  int count = 0;
  for (const Requirement& criterion : outcome.criteria) {
    if (criterion.passed.value_or(true)) continue;
    missed += (count++ == 0 ? "" : "; ") + name_of(criterion.metric);
  }
  const std::size_t all = outcome.criteria.size();
  if (count > 0)
    return badge("bad", "✗ " + std::to_string(count) + " of " + std::to_string(all) +
                            (all == 1 ? " criterion" : " criteria") + " missed: " + missed);
  if (!outcome.succeeded) return badge("bad", "✗ the run did not succeed");
  if (all == 0) return badge("soft", "no criteria to judge by");
  if (all == 2) return badge("good", "✓ both criteria hold");
  return badge("good", all == 1 ? "✓ the criterion holds: " + name_of(outcome.criteria[0].metric)
                                : "✓ all " + std::to_string(all) + " criteria hold");
}

// Criteria may ask for less than the scenario's goal, or for its failure; where they ask for it,
// theirs is the badge.
std::string goal_badge(const Outcome& outcome) {
  if (outcome.goal.empty() || outcome.goal_reached) return "";
  const Requirement* criterion = outcome.criterion("goal_reached");
  if (criterion != nullptr && !criterion->passed.value_or(true)) return "";
  const bool expected = criterion != nullptr && criterion->equals == false;
  return expected ? badge("soft", "goal not reached, as the criteria expect")
                  : badge("bad", "✗ goal not reached");
}

std::string ending(const RunData& run, const Outcome& outcome) {
  std::string text = "Ended after " + end_time(run);
  if (!outcome.reason.empty()) text += ": " + outcome.reason;
  text += ".";
  if (!outcome.goal.empty()) text += " Goal: " + outcome.goal + ".";
  return "<p>" + escape(text) + "</p>\n";
}

std::string cut_warning(const RunData& run, const Outcome& outcome) {
  if (!run.problem.empty())
    return warning("The log is not whole: " + run.problem +
                   ". This shows what could be read of it, to " + end_time(run) + ".");
  if (outcome.interrupted)
    return warning("The run was " + outcome.reason + " at " + end_time(run) +
                   ", so this shows only its beginning, and its criteria are not judged.");
  return outcome.known ? ""
                       : warning(
                             "The log holds no summary: its run did not end in the usual way. "
                             "This shows it to " +
                             end_time(run) + ".");
}

std::string steered(const RunData& run) {
  if (run.num_changes == 0) return "";
  return warning("The run was steered by hand: " + std::to_string(run.num_changes) +
                 (run.num_changes == 1 ? " change or push" : " changes and pushes") +
                 " while it ran, so this is no verdict on the scenario alone.");
}

// By the command alone another run is had.
std::string left_out(const RunData& run, const Outcome& outcome) {
  std::string out;
  if (outcome.interrupted || !outcome.known)
    out += "<p>That run goes on where this log ends.</p>\n";
  else if (!run.problem.empty())
    out += "<p>What of it was changed by hand may be missing here: the log is damaged.</p>\n";
  if (run.num_changes > 0)
    out += "<p>It is without what was changed and pushed by hand (" +
           std::to_string(run.num_changes) + (run.num_changes == 1 ? " time" : " times") +
           ", on /changes): <code>replay --verify</code> on the log repeats that.</p>\n";
  return out;
}

std::string drawn_values(const LogHeader& header) {
  if (header.drawn.empty()) return "";
  std::vector<std::vector<Cell>> rows;
  for (const LogDraw& draw : header.drawn) rows.push_back({{draw.path}, {decimal(draw.value, 6)}});
  return "<details><summary>What the seed drew: " + std::to_string(rows.size()) +
         (rows.size() == 1 ? " value" : " values") + "</summary>\n" + table({}, rows) +
         "</details>\n";
}

}  // namespace

std::string title(const LogHeader& header) {
  std::string out = "<h1>" + escape(header.scenario) + "</h1>\n";
  if (!header.description.empty())
    out += "<p class=\"lead\">" + escape(header.description) + "</p>\n";
  return out + "<p class=\"facts\">" + escape(header.robot.name) + " · stack " +
         escape(header.stack) + " · estimation " + escape(header.estimation) + " · seed " +
         std::to_string(header.seed) + "</p>\n";
}

std::string verdict(const RunData& run, const Outcome& outcome) {
  std::string out = cut_warning(run, outcome);
  if (outcome.known && !outcome.interrupted)
    out += criteria_badge(outcome) + goal_badge(outcome) + ending(run, outcome) + steered(run);
  out += push_list(run) + trouble_list(run);
  for (const std::string& note : run.header.notes)
    out += "<p class=\"soft\">" + escape(note) + "</p>\n";
  return out;
}

std::string provenance(const RunData& run, const Outcome& outcome) {
  const LogHeader& header = run.header;
  std::string out = "<h2>How to make it again</h2>\n";
  if (!header.command.empty())
    out += "<pre>" + escape(header.command) + "</pre>\n" + left_out(run, outcome);
  const double period = header.control_period;
  std::vector<std::vector<Cell>> rows{
      {{"surefoot"}, {header.version + (header.commit.empty() ? "" : ", commit " + header.commit)}},
      {{"robot"}, {header.robot.name + ", " + decimal(header.robot.mass, 2) + " kg"}},
      {{"stack"}, {header.stack}},
      {{"control period"}, {decimal(1e3 * period, 3) + " ms, " + decimal(1.0 / period, 1) + " Hz"}},
      {{"seed"},
       {std::to_string(header.seed) +
        (header.seed == 0 ? " (nominal: the scenario's random values are not drawn)" : "")}}};
  return out + table({}, rows) + drawn_values(header);
}

}  // namespace surefoot::report
