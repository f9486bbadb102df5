#include "surefoot/model/urdf_reader.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <string_view>

namespace surefoot::model {
namespace {

using tinyxml2::XMLElement;

/// The first element that xacro should have replaced; nullptr if there is none.
const XMLElement* of_xacro(const XMLElement& element) {
  if (std::string_view(element.Name()).starts_with("xacro:")) return &element;
  for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (const XMLElement* found = of_xacro(*child)) return found;
  }
  return nullptr;
}

constexpr const char* kRunXacro = "run xacro first: xacro FILE > robot.urdf";

/// Advice on a text that xacro should have replaced.
std::string advice_for(const std::string& text) {
  return text.find("${") == std::string::npos ? "" : std::string("; ") + kRunXacro;
}

template <std::size_t N>
std::array<double, N> numbers(const UrdfReader& reader, const XMLElement& element,
                              const char* attribute) {
  const char* given = element.Attribute(attribute);
  const std::string text = given == nullptr ? "" : given;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  std::array<double, N> values{};
  for (double& value : values) stream >> value;  // reads neither "nan" nor "inf"
  std::string rest;
  if (!stream.fail() && !(stream >> rest)) return values;
  reader.fail(reader.line(element),
              std::string("<") + element.Name() + "> needs " + attribute + "=\"" +
                  (N == 1 ? "a finite number" : "three finite numbers") +
                  (given == nullptr ? "\", and has none" : "\", not \"" + text + "\"") +
                  advice_for(text));
}

/// What is wrong with an XML file, in words.
std::string fault_of(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "the file is empty, or no text";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "the element that begins here is not closed by an end tag of its name";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute here is not written as name=\"value\", or stands twice";
    case tinyxml2::XML_ERROR_PARSING:
      return "an element here is not closed, or text stands outside of elements";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment that begins with <!-- here does not end with -->";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
    case tinyxml2::XML_ERROR_PARSING_CDATA:
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
    case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
      return "what begins with < here does not end with >";
    default:
      return document.ErrorName();
  }
}

void load_xml(const std::string& path, const char* format, tinyxml2::XMLDocument& document) {
  if (std::filesystem::is_directory(path))
    throw FileError(path + ": a folder; give the " + format + " in it");
  if (!std::ifstream(path))
    throw FileError(path + ": the " + format + " can't be read; does the file exist?");
  if (document.LoadFile(path.c_str()) == tinyxml2::XML_SUCCESS) return;
  throw FileError(path + ":" + std::to_string(std::max(1, document.ErrorLineNum())) +
                  ": not well-formed XML: " + fault_of(document));
}

}  // namespace

std::string root_of_xml(const std::string& path, const char* format) {
  tinyxml2::XMLDocument document;
  load_xml(path, format, document);
  const XMLElement* root = document.RootElement();
  return root == nullptr ? "" : root->Name();
}

const XMLElement& UrdfReader::robot(tinyxml2::XMLDocument& document) const {
  if (text_.empty()) {
    load_xml(path_, "URDF", document);
  } else {
    document.Parse(text_.c_str(), text_.size());
  }
  const XMLElement* robot = document.FirstChildElement("robot");
  if (robot == nullptr) {
    const bool is_mjcf = document.FirstChildElement("mujoco") != nullptr;
    fail(1, std::string("not a URDF: the file has no <robot>") +
                (is_mjcf ? "; an MJCF stands under `mjcf:`" : ""));
  }
  if (const XMLElement* second = robot->NextSiblingElement()) {
    fail(line(*second), std::string("<") + second->Name() +
                            "> stands behind the <robot>; a URDF has one <robot>, with all in it");
  }
  if (const XMLElement* macro = of_xacro(*robot)) {
    fail(line(*macro),
         std::string("<") + macro->Name() + "> does not belong in a URDF; " + kRunXacro);
  }
  return *robot;
}

int UrdfReader::line(const XMLElement& element) const {
  if (text_.empty()) return element.GetLineNum();
  const tinyxml2::XMLNode* node = &element;
  while (node != nullptr && node->ToElement() != nullptr &&
         node->ToElement()->Attribute("line") == nullptr)
    node = node->Parent();
  return node == nullptr || node->ToElement() == nullptr ? 1
                                                         : node->ToElement()->IntAttribute("line");
}

void UrdfReader::fail(int line, const std::string& what) const {
  throw FileError(path_ + ":" + std::to_string(line) + ": " + what);
}

std::string UrdfReader::name(const XMLElement& element) const {
  const char* text = element.Attribute("name");
  if (text == nullptr || *text == '\0') {
    fail(line(element), std::string("<") + element.Name() + "> has no name");
  }
  const std::string advice = advice_for(text);
  if (!advice.empty()) fail(line(element), std::string("\"") + text + "\" is no name" + advice);
  return text;
}

double UrdfReader::number(const XMLElement& element, const char* attribute) const {
  return numbers<1>(*this, element, attribute)[0];
}

Vec3 UrdfReader::vector(const XMLElement& element, const char* attribute) const {
  const std::array<double, 3> values = numbers<3>(*this, element, attribute);
  return {values[0], values[1], values[2]};
}

void UrdfReader::read_origin(const XMLElement& parent, Mat3& R, Vec3& p) const {
  const XMLElement* origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return;
  if (origin->Attribute("xyz") != nullptr) p = vector(*origin, "xyz");
  if (origin->Attribute("rpy") != nullptr) {
    R = from_roll_pitch_yaw(vector(*origin, "rpy")).toRotationMatrix();
  }
}

}  // namespace surefoot::model
