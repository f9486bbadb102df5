#include "surefoot/replay/logged_scenario.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/data_file.hpp"

#include <cstddef>
#include <filesystem>

namespace surefoot::replay {
namespace {

namespace fs = std::filesystem;

const std::string& attachment(const logging::LogHeader& header, const std::string& name) {
  return *header.attachment(name);
}

void replace(std::string& text, const std::string& part, const std::string& other) {
  const std::size_t found = text.find(part);
  if (found != std::string::npos) text.replace(found, part.size(), other);
}

/// The robot's file, with its URDF, or that made from its MJCF, where this program finds it.
std::string robot_file(const logging::LogHeader& header, const logging::ScratchFolder& folder) {
  std::string robot = attachment(header, "robot.yaml");
  const std::size_t mjcf = robot.find("\nmjcf:");
  const std::size_t urdf = (mjcf == std::string::npos ? robot.find("\nurdf:") : mjcf) + 1;
  robot.replace(urdf, robot.find('\n', urdf) - urdf,
                "urdf: " + folder.write("robot.urdf", attachment(header, "robot.urdf")));
  return folder.write("robot.yaml", robot);
}

}  // namespace

config::Scenario logged_scenario(const logging::LogHeader& header,
                                 const logging::ScratchFolder& folder, const tasks::OwnTasks& own) {
  // JSON is YAML, so the options are a scenario file.
  return config::load_scenario(
      {folder.write("scenario.yaml", header.options),
       0,
       {"stack=" + folder.write("stack.yaml", attachment(header, "resolved_stack.yaml")),
        "robot=" + robot_file(header, folder)},
       own});
}

config::Scenario logged_scenario(const logging::LogHeader& header,
                                 const logging::ScratchFolder& folder, const std::string& stack,
                                 const tasks::OwnTasks& own) {
  const fs::path file = fs::absolute(config::find_data_file("stacks", stack));
  const std::string robot = robot_file(header, folder);
  const std::string scenario = folder.write("scenario.yaml", header.options);
  try {
    return config::load_scenario(
        {scenario, 0, {"stack=" + file.string(), "robot=" + robot, "stack_switches=[]"}, own});
  } catch (const Error& error) {
    std::string text = error.what();
    replace(text, scenario, "the log's scenario");
    replace(text, "--set stack=" + file.string() + ": stack: ", "");
    throw Error("stack " + stack + ": " + text);
  }
}

}  // namespace surefoot::replay
