#pragma once

#include "surefoot/base/error.hpp"

#include <filesystem>
#include <string>
#include <utility>

namespace surefoot::config {

/// A robot's description is not there.
class MissingDescription : public FileError {
 public:
  MissingDescription(const std::string& message, std::string remedy)
      : FileError(message), remedy_(std::move(remedy)) {}
  /// What installs it; empty if that is not known.
  [[nodiscard]] const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

/// A robot's URDF or MJCF.
struct DescriptionFile {
  std::string path;
  std::string urdf;  ///< made from an MJCF; empty: the file is a URDF
};

/// Finds a file by its `package://` name, or by its path from `folder`. Throws MissingDescription,
/// with the places tried, if there is none.
[[nodiscard]] std::string find_description(const std::string& name,
                                           const std::filesystem::path& folder);

/// The URDF made from the MJCF at `path`, which was found by `name`. Throws FileError if it can't
/// be read.
[[nodiscard]] std::string urdf_of_mjcf_named(const std::string& name, const std::string& path);

/// Finds and reads a file of either kind. Throws FileError if there is none.
[[nodiscard]] DescriptionFile read_description(const std::string& name);

}  // namespace surefoot::config
