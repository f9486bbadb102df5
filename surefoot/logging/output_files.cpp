#include "surefoot/logging/output_files.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/logging/whole_file.hpp"
#include "surefoot/logging/write_lock.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace surefoot::logging {
namespace {

namespace fs = std::filesystem;

std::string reason() { return std::strerror(errno); }

void probe(const fs::path& folder, const fs::path& shown) {
  const fs::path trial = folder / (".surefoot-" + std::to_string(getpid()));
  errno = 0;
  const bool is_written = static_cast<bool>((std::ofstream(trial) << '\n').flush());
  const std::string why = reason();
  std::error_code ignored;
  fs::remove(trial, ignored);  // also where there is no room: then it is empty
  if (is_written) return;
  throw FileError(shown.string() + ": can't be written: " + why +
                  "; a place where you may write and that has room would be valid");
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) {
    throw FileError(file.string() + ": of an earlier run, can't be removed: " + error.message());
  }
}

}  // namespace

void check_writable_file(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    throw FileError(file.string() + ": is a folder; the name of a file would be valid");
  }
  if (fs::exists(file, ignored) && access(file.c_str(), W_OK) != 0) {
    throw FileError(file.string() + ": can't be written: " + reason());
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw FileError(file.string() + ": there is no folder " + folder.string() + "; make it first");
  }
  probe(folder, file);
}

void check_not_the_input(const fs::path& output, const fs::path& input) {
  std::error_code none_yet;
  if (!fs::equivalent(output, input, none_yet)) return;
  throw FileError(output.string() +
                  ": is the log itself, which would be lost; another name would be valid");
}

void check_not_being_written(const fs::path& log) {
  const fs::path partial = partial_path(log.string());
  std::error_code ignored;
  if (fs::exists(partial, ignored)) const WriteLock nobody_else(partial.string(), log.string());
}

void prepare_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": this folder can't be made: " + error.message());
  probe(folder, folder);
}

void remove_outdated(const fs::path& report_folder, const fs::path& log) {
  remove_file(report_folder / "index.html");
  if (log.empty()) return;
  check_not_being_written(log);
  remove_file(log);
  remove_file(partial_path(log.string()));
}

void remove_if_empty(const fs::path& folder) {
  std::error_code not_empty;
  if (fs::is_directory(folder, not_empty)) fs::remove(folder, not_empty);
}

fs::path next_free_log(const fs::path& log) {
  for (int number = 2;; ++number) {
    fs::path next = log;
    next.replace_filename(log.stem().string() + "-" + std::to_string(number) +
                          log.extension().string());
    if (!fs::exists(next) && !fs::exists(partial_path(next.string()))) return next;
  }
}

void write_file(const fs::path& file, const std::string& text) {
  WholeFile whole(file.string());
  whole.stream() << text;
  whole.finish();
}

}  // namespace surefoot::logging
