#pragma once

#include <filesystem>
#include <string>

namespace surefoot::logging {

/// A folder for files that only another reader understands; gone with the object.
class ScratchFolder {
 public:
  /// Throws FileError if none can be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Path of a new file with this text.
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

}  // namespace surefoot::logging
