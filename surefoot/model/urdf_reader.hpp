#pragma once

#include "surefoot/math/types.hpp"

#include <string>
#include <utility>

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace surefoot::model {

/// Reads the elements of one URDF. Throws only FileErrors, which begin with file and line.
class UrdfReader {
 public:
  /// `text`: of the URDF, if it was made from the MJCF at `path`.
  explicit UrdfReader(std::string path, std::string text = "")
      : path_(std::move(path)), text_(std::move(text)) {}

  /// Fills the document and returns its <robot>.
  [[nodiscard]] const tinyxml2::XMLElement& robot(tinyxml2::XMLDocument& document) const;

  /// Where an element stands in the file at `path`.
  [[nodiscard]] int line(const tinyxml2::XMLElement& element) const;

  [[noreturn]] void fail(int line, const std::string& what) const;

  [[nodiscard]] std::string name(const tinyxml2::XMLElement& element) const;
  /// A finite number, or three, of a required attribute.
  [[nodiscard]] double number(const tinyxml2::XMLElement& element, const char* attribute) const;
  [[nodiscard]] Vec3 vector(const tinyxml2::XMLElement& element, const char* attribute) const;
  /// The <origin> of an element: rotation and position [m]; unchanged if absent.
  void read_origin(const tinyxml2::XMLElement& parent, Mat3& R, Vec3& p) const;

 private:
  std::string path_, text_;
};

/// Name of the element that holds all of an XML file. Throws FileError if it can't be read or is
/// not XML; `format`: how the message calls it.
[[nodiscard]] std::string root_of_xml(const std::string& path, const char* format);

}  // namespace surefoot::model
