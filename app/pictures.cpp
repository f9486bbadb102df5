#include "app/pictures.hpp"

#include "app/scratch_folder.hpp"
#include "surefoot/base/error.hpp"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

namespace surefoot {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kNoLauncher =
    "the program was started without its launcher; bin/surefoot makes them";

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Where the output of a process goes; empty: where this program's goes.
struct Outputs {
  std::string out, err;
};

/// Runs the Python package surefoot_log and waits for it. Gives its exit code, −1 if it could not
/// be started or was ended.
int run_python(const std::vector<std::string>& words, const Outputs& outputs) {
  std::vector<std::string> command{pictures_python(), "-m", "surefoot_log"};
  command.insert(command.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const auto redirect = [&](int number, const std::string& file) {
    if (file.empty()) return;
    posix_spawn_file_actions_addopen(&actions, number, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
  };
  redirect(STDOUT_FILENO, outputs.out);
  redirect(STDERR_FILENO, outputs.err);
  pid_t child = -1;
  const int failure =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The last line of a process's complaints, without the program's name.
std::string complaint(const std::string& text, int status) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  if (last.empty()) return "their program ended with " + std::to_string(status);
  const std::string name = "surefoot: ";
  return last.starts_with(name) ? last.substr(name.size()) : last;
}

ReportPictures read_pictures(const fs::path& folder, const std::string& description) {
  ReportPictures pictures;
  const Json json = Json::parse(description);
  pictures.times = json.at("times").get<std::vector<double>>();
  pictures.first = json.at("span").at("first").get<double>();
  pictures.last = json.at("span").at("last").get<double>();
  pictures.has_pushes = json.at("has_pushes").get<bool>();
  pictures.notes = json.at("notes").get<std::vector<std::string>>();
  pictures.strip = contents(folder / "strip.jpg");
  pictures.clip = contents(folder / "clip.mp4");
  return pictures;
}

}  // namespace

std::string pictures_python() {
  const char* python = std::getenv("SUREFOOT_PYTHON");
  return python == nullptr ? "" : python;
}

void check_can_film(const std::string& file) {
  std::string ending = fs::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".mp4") {
    throw Error(file + ": films are written as MP4; a name that ends with .mp4 would be valid");
  }
  const std::string python = pictures_python();
  if (python.empty()) throw Error(std::string("--video: ") + kNoLauncher);
  if (access(python.c_str(), X_OK) != 0)
    throw Error("--video: $SUREFOOT_PYTHON is " + python + ", which can't be started");
}

ReportPictures make_pictures(const std::string& log) {
  ReportPictures none;
  none.why_none = kNoLauncher;
  if (pictures_python().empty()) return none;
  try {
    const ScratchFolder folder;
    const Outputs outputs{(folder.path() / "out").string(), (folder.path() / "err").string()};
    const int status = run_python({"report-pictures", log, folder.path().string()}, outputs);
    if (status == 0) return read_pictures(folder.path(), contents(outputs.out));
    none.why_none = complaint(contents(outputs.err), status);
  } catch (const std::exception& error) {
    none.why_none = error.what();
  }
  return none;
}

bool film(const std::string& log, const std::string& file) {
  return run_python({"video", log, "--out", file}, {.out = "/dev/null", .err = {}}) == 0;
}

std::string write_illustrated_report(const std::string& log, const std::string& folder,
                                     const std::function<void(const std::string&)>& is_there) {
  if (pictures_python().empty()) return write_report(log, folder, make_pictures(log));
  return write_report_before_pictures(log, folder, [&](const std::string& page) {
    if (is_there) is_there(page);
    return make_pictures(log);
  });
}

void tell_pictures_come(const std::string& page) {
  std::fprintf(stderr, "report: %s can be opened; its pictures are being made\n", page.c_str());
}

}  // namespace surefoot
