#include "cli/python_tools.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace surefoot::cli {
namespace {

/// The Python that the launcher names; empty where the program was started without it.
std::string python() {
  const char* named = std::getenv("SUREFOOT_PYTHON");
  return named == nullptr ? "" : named;
}

std::vector<std::string> command_of(const std::string& module,
                                    const std::vector<std::string>& words) {
  std::vector<std::string> command{python(), "-m", module};
  command.insert(command.end(), words.begin(), words.end());
  return command;
}

/// Null-terminated, for execv and posix_spawn.
std::vector<char*> pointers(std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return arguments;
}

/// Runs a Python package and waits for it, without its standard output. False if it failed or could
/// not be started.
bool run_python(const std::string& package, const std::vector<std::string>& words) {
  constexpr int kKeepExisting = 0;  // the launcher may have set it
  setenv("SUREFOOT_PROGRAM", std::filesystem::read_symlink("/proc/self/exe").c_str(),
         kKeepExisting);
  std::vector<std::string> command = command_of(package, words);
  const std::vector<char*> arguments = pointers(command);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const int failure =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return false;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

void check_has_python(const std::string& option) {
  if (python().empty()) {
    throw Error(option +
                ": Python does this, and the program was started without it: use the `surefoot` of "
                "`pip install`, or bin/surefoot of the source tree");
  }
  if (access(python().c_str(), X_OK) != 0) {
    throw Error(option + ": $SUREFOOT_PYTHON is " + python() + ", which can't be started");
  }
}

void check_can_film(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".mp4") {
    throw Error(file + ": films are written as MP4; a name that ends with .mp4 would be valid");
  }
  check_has_python("--video");
}

bool film(const std::string& log, const std::string& file) {
  return run_python("surefoot_log", {"video", log, "--out", file});
}

bool write_report(const std::string& log, const std::string& folder, bool pictures) {
  std::vector<std::string> words{log, "--out", folder, "--of-run"};
  if (!pictures) words.emplace_back("--no-pictures");
  return run_python("surefoot_report", words);
}

void become_python(const std::string& option, const std::string& module,
                   const std::vector<std::string>& words) {
  check_has_python(option);
  setenv("SUREFOOT_PROGRAM", std::filesystem::read_symlink("/proc/self/exe").c_str(), 1);
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGINT);
  sigaddset(&ending, SIGTERM);
  sigprocmask(SIG_BLOCK, &ending, nullptr);
  if (runtime::interrupted()) throw Error("interrupted: no results");
  std::vector<std::string> command = command_of(module, words);
  execv(python().c_str(), pointers(command).data());
  throw Error(option + ": " + python() + " can't be started: " + std::strerror(errno));
}

}  // namespace surefoot::cli
