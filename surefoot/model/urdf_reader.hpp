#pragma once

#include "surefoot/math/types.hpp"

#include <string>

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace surefoot::model {

/// Reads the elements of one URDF. Throws only FileErrors, which begin with file and line.
class UrdfReader {
 public:
  /// `path` of the file must outlive the reader.
  explicit UrdfReader(const std::string& path) : path_(path) {}

  /// Fills the document from the file and returns its <robot>.
  [[nodiscard]] const tinyxml2::XMLElement& robot(tinyxml2::XMLDocument& document) const;

  [[noreturn]] void fail(int line, const std::string& what) const;

  [[nodiscard]] std::string name(const tinyxml2::XMLElement& element) const;
  /// A finite number, or three, of a required attribute.
  [[nodiscard]] double number(const tinyxml2::XMLElement& element, const char* attribute) const;
  [[nodiscard]] Vec3 vector(const tinyxml2::XMLElement& element, const char* attribute) const;
  /// The <origin> of an element: rotation and position [m]; unchanged if absent.
  void read_origin(const tinyxml2::XMLElement& parent, Mat3& R, Vec3& p) const;

 private:
  const std::string& path_;
};

}  // namespace surefoot::model
