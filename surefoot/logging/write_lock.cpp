#include "surefoot/logging/write_lock.hpp"

#include "surefoot/base/error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>

namespace surefoot::logging {
namespace {

constexpr mode_t kDefaultMode = 0666;  // before umask

int open_to_lock(const std::string& path) {
  struct stat there{};
  const bool is_folder = stat(path.c_str(), &there) == 0 && S_ISDIR(there.st_mode);
  return open(path.c_str(), O_RDONLY | O_CLOEXEC | (is_folder ? 0 : O_CREAT), kDefaultMode);
}

/// The file may have been renamed before it was locked.
bool has_this_name(int file, const std::string& path) {
  struct stat locked{}, named{};
  return fstat(file, &locked) == 0 && stat(path.c_str(), &named) == 0 &&
         locked.st_ino == named.st_ino && locked.st_dev == named.st_dev;
}

/// " (process 4711)" of the lock's holder, if the kernel shows it.
std::string holder(int file) {
  struct stat locked{};
  if (fstat(file, &locked) != 0) return "";
  const std::string inode = ":" + std::to_string(locked.st_ino);
  std::ifstream locks("/proc/locks");  // "3: FLOCK  ADVISORY  WRITE 4711 00:2f:1234567 0 EOF"
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advice, access, process, place;
    words >> number >> kind >> advice >> access >> process >> place;
    if (kind == "FLOCK" && place.ends_with(inode)) return " (process " + process + ")";
  }
  return "";
}

}  // namespace

WriteLock::WriteLock(const std::string& path, const std::string& shown) {
  while ((file_ = open_to_lock(path)) >= 0) {
    const bool is_taken = flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!is_taken && has_this_name(file_, path)) return;
    const std::string who = is_taken ? holder(file_) : "";
    close(file_);
    if (!is_taken) continue;
    throw FileError(shown + ": is being written by another run" + who +
                    "; wait for it, or choose another name");
  }
}

WriteLock::~WriteLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace surefoot::logging
