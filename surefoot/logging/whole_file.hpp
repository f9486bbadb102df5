#pragma once

#include <fstream>
#include <string>

namespace surefoot {

/// Writes a file that is there whole or not at all: under a name that no other process writes to,
/// which it changes at the end. Of two that write the same file the last one's is kept.
class WholeFile {
 public:
  explicit WholeFile(std::string path);
  /// Without `finish` before nothing is left.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Gives the file its name. Throws FileError, naming it, if it could not be written.
  void finish();

 private:
  std::string path_, partial_;
  std::ofstream stream_;
};

}  // namespace surefoot
