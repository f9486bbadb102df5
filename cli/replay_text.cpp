#include "cli/replay_text.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/logging/clock_text.hpp"

#include <cmath>

namespace surefoot::cli {
namespace {

std::string seconds(double time) { return formatted("%.4f s", time); }

std::string built_from(const logging::LogHeader& header) {
  return "surefoot " + header.version +
         (header.commit.empty() ? ", commit not known" : ", commit " + header.commit);
}

std::string headline(const std::string& path, const logging::LogHeader& header) {
  return path + ": " + header.scenario + ", seed " + std::to_string(header.seed) + ", stack " +
         header.stack + " (" + built_from(header) + ")\n";
}

std::string number_of_ticks(long ticks) {
  return std::to_string(ticks) + (ticks == 1 ? " tick" : " ticks");
}

std::string span(long ticks, double first, double last) {
  return number_of_ticks(ticks) + ", " + seconds(first) + " to " + seconds(last);
}

std::string not_whole(const std::string& problem) {
  return problem.empty() ? "" : "The log is not whole: " + problem + ".\n";
}

std::string behind_gap(const std::optional<replay::LogGap>& gap, const std::string& done) {
  if (!gap) return "";
  const std::string to = seconds(gap->to);
  return (gap->from ? "Behind " + seconds(*gap->from) + " nothing" : "Nothing") + " could be " +
         done + (gap->from ? ": no tick from there to " : ": no tick before ") + to +
         " can be read, and a controller can't be computed again behind a gap (" +
         number_of_ticks(gap->ticks_behind) + " from then on).\n";
}

std::string not_compared(const replay::Verification& result) {
  std::string out = behind_gap(result.gap, "compared");
  if (result.may_go_on)
    out +=
        "What the run had after its last tick here could not be compared: it is not in the log.\n";
  return out;
}

std::string all_compared(const replay::Verification& result) {
  return result.is_all() && !result.is_whole() ? "All of its ticks were compared.\n" : "";
}

std::string place(const logging::LogHeader& header, const replay::TorqueDifference& difference) {
  return "tick " + std::to_string(difference.tick) + ", " + seconds(difference.time) + ", " +
         header.robot.joint_names[static_cast<std::size_t>(difference.joint)] + ": " +
         formatted("%.17g", difference.logged) + " N·m in the log, " +
         formatted("%.17g", difference.computed) + " N·m now (" +
         formatted("%.3g", difference.computed - difference.logged) + ")\n";
}

/// What was computed again, and what not.
std::string ran_again(const replay::Verification& result) {
  std::string out = result.estimated
                        ? "Estimator and controller ran again on the logged readings.\n"
                        : "The controller ran again on the logged readings and states.\n";
  std::string own;
  for (const std::string& part : result.played_back) own += (own.empty() ? "" : ", ") + part;
  if (!own.empty())
    out += "Not run again, as they are of the program that recorded the log: " + own +
           ". What they gave is the log's.\n";
  return out;
}

/// Stages with other results, in order: the first one is the place to look at.
std::string first_cause(const replay::Verification& result) {
  std::string out;
  for (const replay::MessageDifferences& topic : result.messages) {
    if (topic.ticks == 0) continue;
    out += "  " + std::string(topic.topic) + " is another one at " + std::to_string(topic.ticks) +
           " ticks, first at " + seconds(topic.first) + "\n";
  }
  return out;
}

std::string another_build(const logging::LogHeader& header) {
  const BuildInfo& build = build_info();
  if (header.version == build.version && header.commit == build.commit) return "";
  return "The log was recorded by " + built_from(header) + ", this is surefoot " +
         std::string(build.version) + ", commit " + std::string(build.commit) +
         ": another build may compute other bits.\n";
}

/// Three digits, from 100 on all before the point.
std::string residual(double value, const std::string& unit) {
  if (value < kResidualRounding) return "0";
  return formatted(value < 100.0 ? "%.3g" : "%.0f", value) + (unit.empty() ? "" : " " + unit);
}

/// Stands below the torques: says where they differ so much that the run would have been another.
std::string far_apart(const replay::StackComparison& result) {
  constexpr double kFar = 0.1;  // rms, of the limit
  std::size_t worst = 0;
  const auto share = [&](std::size_t i) {
    return result.joints[i].rms / result.header.robot.torque_limit[static_cast<Eigen::Index>(i)];
  };
  for (std::size_t i = 1; i < result.joints.size(); ++i) {
    if (share(i) > share(worst)) worst = i;
  }
  if (result.joints.empty() || !(share(worst) > kFar)) return "";
  return "Torques of " + result.header.robot.joint_names[worst] +
         formatted(
             " differ by %.0f %% of its limit (rms): with the other hierarchy the run would "
             "soon have been another.\n",
             100.0 * share(worst));
}

/// Below rounding it is 0, as a residual is.
std::string torque(const char* format, double value) {
  return std::abs(value) < kResidualRounding ? "0" : formatted(format, value) + " N·m";
}

constexpr const char* kMark = " *";

/// Time of a largest difference; marked if it is after the end of the walk.
std::string largest_at(const replay::StackComparison& result, double time) {
  const bool is_behind = result.walk_end && time >= result.walk_end->time - 1e-9;
  return seconds(time) + (is_behind ? kMark : "");
}

/// Stands below `tables` and explains their marks.
std::string walk_end(const replay::StackComparison& result, const std::string& tables) {
  if (!result.walk_end) return "";
  return (tables.find(kMark) == std::string::npos ? "From " : "* From ") +
         seconds(result.walk_end->time) +
         " on the run says nothing of its walk: " + result.walk_end->why + ".\n\n";
}

std::string joint_table(const replay::StackComparison& result) {
  std::vector<std::vector<std::string>> table{{"torque, other − logged", "rms", "largest", "at"}};
  for (std::size_t i = 0; i < result.joints.size(); ++i) {
    const replay::JointComparison& joint = result.joints[i];
    const bool is_none = std::abs(joint.largest) < kResidualRounding;
    table.push_back({result.header.robot.joint_names[i], torque("%.3g", joint.rms),
                     torque("%+.3g", joint.largest),
                     is_none ? "–" : largest_at(result, joint.time)});
  }
  return aligned(table);
}

std::string level_table(const replay::StackComparison& result) {
  std::vector<std::vector<std::string>> table{
      {"residual", "rms, logged", "other", "largest, logged", "at", "other", "at"}};
  for (const replay::LevelComparison& level : result.levels) {
    const auto shown = [&](bool is_there, double value) {
      return is_there ? residual(value, level.unit) : std::string("–");
    };
    const auto at = [&](bool is_there, double largest, double time) {
      return is_there && largest >= kResidualRounding ? largest_at(result, time) : std::string("–");
    };
    table.push_back({level.name, shown(level.in_log, level.logged_rms),
                     shown(level.in_other, level.other_rms), shown(level.in_log, level.logged_max),
                     at(level.in_log, level.logged_max, level.logged_time),
                     shown(level.in_other, level.other_max),
                     at(level.in_other, level.other_max, level.other_time)});
  }
  return aligned(table);
}

/// "3 ticks, first at 1.0000 s".
std::string counted(const replay::TickCount& count) {
  return number_of_ticks(count.ticks) +
         (count.ticks > 0 ? ", first at " + seconds(count.first) : "");
}

/// Stands above the tables: which ticks they are made of.
std::string compared(const replay::StackComparison& result) {
  if (result.compared == result.ticks) return "Both answered every tick.\n";
  return "Both answered " + number_of_ticks(result.compared) + " of " +
         std::to_string(result.ticks) + ", from which the tables are made.\n";
}

std::string unanswered(const replay::StackComparison& result) {
  std::string out;
  if (result.not_asked.ticks > 0)
    out += "Not asked at " + counted(result.not_asked) +
           ": the run planned nothing there, as its controller had no state to believe or had lost "
           "a sensor.\n";
  if (result.other_unanswered.ticks > 0)
    out += "No answer of the other hierarchy at " + counted(result.other_unanswered) + ": " +
           result.other_unanswered.why + ".\n";
  if (result.other_stopped.ticks > 0)
    out += "Its controller would have been stopped for safety at " + counted(result.other_stopped) +
           ": " + result.other_stopped.why + ". The ticks behind are asked all the same.\n";
  return out;
}

std::string optimality(const replay::StackComparison& result) {
  std::string out = "Not optimal: " + number_of_ticks(result.logged_not_optimal.ticks) +
                    " in the log, " + counted(result.other_not_optimal) +
                    (result.other_not_optimal.ticks > 0 ? ", of the other hierarchy.\n"
                                                        : " of the other hierarchy.\n");
  out += unanswered(result);
  if (result.not_reproduced.ticks > 0)
    out += "This build computes other torques for the run itself at " +
           counted(result.not_reproduced) +
           " (replay --verify says more): the plan asked with is the logged one, but the model may "
           "be another than the run's.\n";
  if (result.logged_switches > 0)
    out += "Levels were switched in the run; the other hierarchy stayed as it was.\n";
  return out;
}

}  // namespace

std::string verification_text(const std::string& path, const replay::Verification& result) {
  std::string out = headline(path, result.header);
  out += ran_again(result);
  if (result.ticks == 0) return out + not_compared(result) + not_whole(result.problem);
  out += span(result.ticks, result.first_time, result.last_time) + ": ";
  if (result.is_same()) {
    return out +
           (result.is_all() ? "every torque is the same to the bit.\n"
                            : "so far every torque is the same to the bit.\n") +
           logging::clock_text(result.clock) + not_compared(result) + all_compared(result) +
           not_whole(result.problem);
  }
  out += std::to_string(result.different_ticks) + " have another torque or mode.\n";
  if (result.first) out += "  first:   " + place(result.header, *result.first);
  if (result.largest) out += "  largest: " + place(result.header, *result.largest);
  return out + first_cause(result) + another_build(result.header) +
         logging::clock_text(result.clock) + not_compared(result) + all_compared(result) +
         not_whole(result.problem);
}

std::string comparison_text(const std::string& path, const replay::StackComparison& result) {
  const std::string tables = joint_table(result) + far_apart(result) + "\n" + level_table(result);
  return headline(path, result.header) + "Asked at each tick on the same states and plan: stack " +
         result.other + "; its torques are compared only, those of the log moved the robot.\n" +
         span(result.ticks, result.first_time, result.last_time) + "\n" + compared(result) + "\n" +
         tables + "\n" + walk_end(result, tables) + optimality(result) +
         behind_gap(result.gap, "asked") + not_whole(result.problem);
}

}  // namespace surefoot::cli
