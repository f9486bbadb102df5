#pragma once

#include <filesystem>
#include <string>

namespace surefoot::logging {

/// A temporary folder, for readers that need files. Removed with the object.
class ScratchFolder {
 public:
  /// Throws FileError if it can't be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a file with this text; returns its path.
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

}  // namespace surefoot::logging
