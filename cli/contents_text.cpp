#include "cli/contents_text.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/explain/outcome.hpp"
#include "surefoot/logging/clock_text.hpp"

namespace surefoot::cli {
namespace {

using Json = nlohmann::ordered_json;
using Table = std::vector<std::vector<std::string>>;

std::string size(std::uint64_t bytes) {
  const auto count = static_cast<double>(bytes);
  if (bytes < 1000) return formatted("%.0f B", count);
  return bytes < 1'000'000 ? formatted("%.1f kB", 1e-3 * count)
                           : formatted("%.1f MB", 1e-6 * count);
}

std::string result(const LogContents& contents) {
  const explain::Outcome outcome = explain::read_outcome(contents.summary);
  if (!outcome.known) return "not known: the log has no summary";
  if (outcome.interrupted) return "the run was " + outcome.reason + "; not judged";
  const char* verdict = !outcome.judged     ? "not judged, too short: "
                        : outcome.succeeded ? "succeeded: "
                                            : "did not succeed: ";
  return verdict + std::to_string(outcome.held) + " of " + std::to_string(outcome.num_criteria) +
         " criteria hold; ended: " + outcome.reason;
}

std::string duration(const LogContents& contents) {
  if (contents.ticks == 0) return "no tick";
  const double period = contents.header.control_period;
  return formatted("%.4g s: ", contents.last_time - contents.first_time + period) +
         std::to_string(contents.ticks) +
         formatted(" ticks of %.4g ms, at %.4f to %.4f s", 1e3 * period, contents.first_time,
                   contents.last_time);
}

std::string drawn(const logging::LogHeader& header) {
  std::string out;
  for (const logging::LogDraw& draw : header.drawn)
    out += (out.empty() ? "" : ", ") + draw.path + formatted(" %.4g", draw.value);
  return out;
}

std::string own_parts(const logging::LogHeader& header) {
  std::string out;
  for (const std::string& part : header.own_parts) out += (out.empty() ? "" : ", ") + part;
  return out + (out.empty() ? "" : ": the command above alone gives another run");
}

std::string steered(const LogContents& contents) {
  if (contents.changes == 0) return "";
  return (contents.problem.empty() ? "" : "at least ") + std::to_string(contents.changes) +
         (contents.changes == 1 ? " change or push" : " changes and pushes") +
         " while it ran (/changes): the command above alone gives another run; replay --verify "
         "repeats this one";
}

std::string lost(const LogContents& contents) {
  if (contents.losses.empty()) return "";
  std::uint64_t bytes = 0;
  for (const logging::McapLoss& loss : contents.losses) bytes += loss.size;
  const bool is_one = contents.losses.size() == 1;
  return std::to_string(contents.lost_ticks) + (contents.lost_ticks == 1 ? " tick" : " ticks") +
         ", in " + std::to_string(contents.losses.size()) + (is_one ? " place" : " places") +
         " of the file (" + size(bytes) + ")";
}

Json losses_json(const std::vector<logging::McapLoss>& losses) {
  Json json = Json::array();
  for (const logging::McapLoss& loss : losses) {
    json.push_back({{"offset", loss.offset}, {"bytes", loss.size}, {"why", loss.why}});
    if (!loss.has_times) continue;
    json.back()["first_time"] = 1e-9 * static_cast<double>(loss.first_time);
    json.back()["last_time"] = 1e-9 * static_cast<double>(loss.last_time);
  }
  return json;
}

std::string facts(const LogContents& contents) {
  const logging::LogHeader& header = contents.header;
  Table rows{
      {"scenario", header.scenario + ", seed " + std::to_string(header.seed) +
                       (header.description.empty() ? "" : ": " + header.description)},
      {"robot",
       header.robot.name + ", stack " + header.stack + ", estimation " + header.estimation},
      {"result", result(contents)},
      {"duration", duration(contents)},
      {"lost", lost(contents)},
      {"recorded by", "surefoot " + header.version +
                          (header.commit.empty() ? "" : ", commit " + header.commit) +
                          "; log version " + header.log_version},
      {"", header.is_newer() ? "this program knows version " + std::string(logging::kLogVersion) +
                                   ": what is new since then is passed over"
                             : ""},
      {"again by", header.command},
      {"own parts", own_parts(header)},
      {"", contents.problem.empty() || !contents.summary.empty()
               ? ""
               : "that run goes on where this log ends"},
      {"steered", steered(contents)},
      {"drawn", drawn(header)}};
  for (const std::string& note : header.notes) rows.push_back({"note", note});
  std::string out;
  for (const std::vector<std::string>& row : rows)
    if (!row[1].empty()) out += row[0] + std::string(13 - row[0].size(), ' ') + row[1] + "\n";
  return out;
}

std::string topics(const LogContents& contents) {
  Table table{{"topic", "messages", "bytes", "bytes a message", "from", "to"}};
  for (const TopicContents& topic : contents.topics) {
    const auto each = static_cast<double>(topic.bytes) / static_cast<double>(topic.messages);
    table.push_back({topic.topic, std::to_string(topic.messages), size(topic.bytes),
                     formatted("%.0f", each), formatted("%.4f s", topic.first_time),
                     formatted("%.4f s", topic.last_time)});
  }
  return aligned(table);
}

std::string attachments(const LogContents& contents) {
  Table table{{"attachment", "bytes"}};
  for (const AttachmentContents& one : contents.attachments)
    table.push_back({one.name, size(one.bytes)});
  return aligned(table);
}

Json result_json(const LogContents& contents) {
  const Json summary = Json::parse(contents.summary, nullptr, false);
  return summary.is_object() && !summary.empty() ? summary : Json(nullptr);
}

}  // namespace

std::string contents_text(const std::string& path, const LogContents& contents) {
  std::string out =
      path + ": " + size(contents.file_bytes) +
      (contents.problem.empty() ? ", the file is whole\n" : ", the file is not whole\n");
  if (!contents.problem.empty()) out += "  " + contents.problem + "\n";
  out += "\n" + facts(contents) + "\n";
  if (const std::string clock = logging::clock_text(contents.clock); !clock.empty())
    out += clock + "\n";
  if (!contents.topics.empty()) out += topics(contents) + "\n";
  return out + attachments(contents);
}

Json contents_json(const std::string& path, const LogContents& contents) {
  const logging::LogHeader& header = contents.header;
  Json json = {{"log", path},
               {"bytes", contents.file_bytes},
               {"whole", contents.problem.empty()},
               {"scenario", header.scenario},
               {"description", header.description},
               {"seed", header.seed},
               {"robot", header.robot.name},
               {"stack", header.stack},
               {"estimation", header.estimation},
               {"version", header.version},
               {"commit", header.commit},
               {"log_version", header.log_version},
               {"command", header.command},
               {"control_period", header.control_period},
               {"ticks", contents.ticks},
               {"first_time", contents.first_time},
               {"last_time", contents.last_time}};
  json["drawn"] = Json::object();
  for (const logging::LogDraw& draw : header.drawn) json["drawn"][draw.path] = draw.value;
  json["topics"] = Json::object();
  for (const TopicContents& topic : contents.topics)
    json["topics"][topic.topic] = {{"schema", topic.schema},
                                   {"messages", topic.messages},
                                   {"bytes", topic.bytes},
                                   {"first_time", topic.first_time},
                                   {"last_time", topic.last_time}};
  json["attachments"] = Json::object();
  for (const AttachmentContents& one : contents.attachments)
    json["attachments"][one.name] = one.bytes;
  logging::add_clock(contents.clock, json);
  json["summary"] = result_json(contents);
  if (!contents.problem.empty()) json["problem"] = contents.problem;
  if (!contents.losses.empty())
    json["lost"] = {{"ticks", contents.lost_ticks}, {"places", losses_json(contents.losses)}};
  return json;
}

}  // namespace surefoot::cli
