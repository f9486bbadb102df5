#include "surefoot/doctor/mjcf_words.hpp"

#include <array>
#include <string>
#include <string_view>

namespace surefoot::doctor {
namespace {

struct Words {
  std::string_view urdf, mjcf;
};

/// What holds another stands before it.
constexpr std::array<Words, 18> kWords{{
    {"the rpy of its <origin>", "the orientation of its <body>"},
    {"is rpy in degrees? Expected is rad: 90° is 1.5708",
     "angles are in degrees, unless <compiler angle=\"radian\"/>"},
    {"<inertial><origin>", "the pos of <inertial>"},
    {"<mass value>", "the mass of <inertial>"},
    {"<inertia>", "diaginertia or fullinertia of <inertial>"},
    {"ixx, iyy and izz are positive, and each of ixy, ixz, iyz is smaller",
     "the first three are positive, and the others smaller"},
    {"<sphere radius>", "the size of the sphere"},
    {"the sizes of <collision>", "the sizes of <geom>"},
    {"the <origin>s of the two legs", "the pos of the two legs' bodies"},
    {"the <origin> of the leg's joints", "the pos of the leg's bodies"},
    {"<limit> lower and upper of KFE, rad", "the range of KFE"},
    {"its lower and upper limit", "its range"},
    {"lower and upper", "the range"},
    {"sign of its <axis>", "sign of its axis"},
    {"its <axis>", "the axis of its <joint>"},
    {"type=\"revolute\" (or continuous)", "type=\"hinge\""},
    {"type=\"fixed\"", "no <joint>"},
    {"take out <mimic>", "take out what couples it"},
}};

void replace_all(std::string& text, const Words& words) {
  for (std::size_t at = text.find(words.urdf); at != std::string::npos;
       at = text.find(words.urdf, at + words.mjcf.size()))
    text.replace(at, words.urdf.size(), words.mjcf);
}

}  // namespace

void say_as_mjcf(Findings& findings) {
  for (Finding& finding : findings) {
    for (const Words& words : kWords) {
      replace_all(finding.what, words);
      replace_all(finding.remedy, words);
    }
  }
}

}  // namespace surefoot::doctor
