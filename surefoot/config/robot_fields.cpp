#include "surefoot/config/robot_fields.hpp"

#include "surefoot/simulation/plant_elements.hpp"

namespace surefoot::config {
namespace {

Field text(const char* key, std::string& value, const char* help) {
  return Field{key, &value, help}.required();
}

Group leg_fields(model::LegDescription& leg, std::vector<std::string>& joints) {
  return {Field{"joints", Names{&joints, kJointsPerLeg, "is not a list of 3 joints: HAA, HFE, KFE"},
                "of the URDF: HAA, HFE, KFE"}
              .required(),
          text("hip", leg.hip_frame, "frame at the HFE axis"),
          text("thigh", leg.thigh_link, "link"),
          text("shank", leg.shank_link, "link that carries the foot sphere"),
          text("foot", leg.foot_frame, "frame that the sphere's centre is given in")};
}

Group all_legs(RobotInFile& o) {
  Group legs;
  for (const Leg leg : kLegs) {
    legs.fields.push_back(Field{std::string(kLegNames[index(leg)]),
                                leg_fields(o.robot.legs[index(leg)], o.joints[index(leg)]), ""}
                              .required());
  }
  return legs;
}

Group limits(RobotInFile& o) {
  const std::vector<std::string> joints{"HAA", "HFE", "KFE"};
  return Group{Field{"torque", Numbers{o.torque.data(), joints, true}, kPositive, "N·m",
                     "one for all joints, or of HAA, HFE and KFE"}
                   .required(),
               Field{"velocity", Numbers{o.velocity.data(), joints, true}, kPositive, "rad/s",
                     "one for all joints, or of HAA, HFE and KFE"}
                   .required(),
               Field{"position_min", Numbers{o.position_min.data(), simulation::axis_elements()},
                     kAnyNumber, "rad", "of HAA, HFE, KFE"}
                   .required(),
               Field{"position_max", Numbers{o.position_max.data(), simulation::axis_elements()},
                     kAnyNumber, "rad", "of HAA, HFE, KFE"}
                   .required()}
      .with([&o](const Given& given) {
        constexpr const char* kNotAll = "does not tell all of HAA, HFE and KFE";
        if ((o.torque.array() <= 0.0).any()) given.fail("torque", kNotAll);
        if ((o.velocity.array() <= 0.0).any()) given.fail("velocity", kNotAll);
        if ((o.position_min.array() >= o.position_max.array()).any())
          given.fail("position_max", "must be above position_min at every joint");
      });
}

Group posture(RobotInFile& o) {
  return Group{Field{"nominal", Numbers{o.nominal.data(), simulation::axis_elements()}, kAnyNumber,
                     "rad", "HAA, HFE, KFE of a front leg, its knee backward"}
                   .required()}
      .with([&o](const Given& given) {
        if (o.nominal.y() * o.nominal.z() < 0.0) return;
        given.fail("nominal", "HFE and KFE must bend the knee, one above 0 and the other below");
      });
}

}  // namespace

Group fields(RobotInFile& o) {
  model::RobotDescription& robot = o.robot;
  return {
      text("name", robot.name, "of the robot"),
      text("urdf", robot.urdf_path, "package:// name, or a file as seen from here"),
      text("base", robot.base_link, "link"),
      Field{"legs", all_legs(o), "names of the URDF"}.required(),
      Field{"foot",
            Group{Field{"radius", &robot.foot_radius, kPositive, "m", "of the sphere"}.required(),
                  {"center", Numbers{robot.foot_center.data(), simulation::axis_elements()},
                   kAnyNumber, "m", "of the sphere in the foot frame"}},
            "sphere of each foot"}
          .required(),
      Field{"limits", limits(o), "of the joints of each leg"}.required(),
      Field{"posture", posture(o), "hind legs mirror HFE and KFE"}.required(),
      {"gains",
       Group{{"hold",
              Group{{"kp", &robot.hold_kp, kNotNegative, "N·m/rad", "stiffness"},
                    {"kd", &robot.hold_kd, kNotNegative, "N·m·s/rad", "damping"}},
              "of joint hold"},
             {"damping", &robot.damping_kd, kNotNegative, "N·m·s/rad", "of damping mode"}},
       "of the safety ladder"}};
}

}  // namespace surefoot::config
