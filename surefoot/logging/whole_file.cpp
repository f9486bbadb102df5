#include "surefoot/logging/whole_file.hpp"

#include "surefoot/base/error.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace surefoot::logging {

WholeFile::WholeFile(std::string path)
    : path_(std::move(path)),
      partial_(path_ + "." + std::to_string(getpid()) + ".partial"),
      stream_(partial_, std::ios::binary) {}

WholeFile::~WholeFile() {
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

void WholeFile::finish() {
  errno = 0;
  stream_.close();
  std::error_code error(stream_ ? 0 : errno, std::generic_category());
  if (stream_) std::filesystem::rename(partial_, path_, error);
  if (stream_ && !error) return;
  throw FileError(path_ + ": can't be written" + (error ? ": " + error.message() : "") +
                  "; a folder that may be written and has room would be valid");
}

}  // namespace surefoot::logging
