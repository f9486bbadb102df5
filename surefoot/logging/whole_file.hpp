#pragma once

#include <fstream>
#include <string>

namespace surefoot::logging {

/// Writes a file completely or not at all: under a unique name, renamed at the end. If two write
/// the same file, the last one wins.
class WholeFile {
 public:
  explicit WholeFile(std::string path);
  /// Without `finish`, removes the file.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Its name until `finish`, for those that write by name.
  [[nodiscard]] const std::string& partial() const { return partial_; }
  /// Renames the file. Throws FileError, with its name, if it could not be written.
  void finish();

 private:
  std::string path_, partial_;
  std::ofstream stream_;
};

}  // namespace surefoot::logging
