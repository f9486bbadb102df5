#include "surefoot/config/robot_fields.hpp"

#include "surefoot/simulation/plant_elements.hpp"

namespace surefoot::config {
namespace {

Field text(const char* key, std::string& value, const char* help) {
  return Field{key, &value, help}.required();
}

const std::vector<std::string>& joint_names() {
  static const std::vector<std::string> names{"HAA", "HFE", "KFE"};
  return names;
}

Field of_joints(const char* key, LegJoints& value, const NumberRange& range, const char* unit,
                const char* help) {
  return {key, Numbers{value.data(), joint_names(), true}, range, unit, help};
}

/// Of a joint; degrees are soon beyond it.
constexpr NumberRange kAngle{.min = -20.0, .max = 20.0, .words = "from -20 to 20 rad"};

/// A key has all three values or none.
void require_all(const Given& given, const char* key, const LegJoints& value) {
  if (value.array().isNaN().any() && !value.array().isNaN().all())
    given.fail(key, "does not tell all of HAA, HFE and KFE");
}

void require_order(const Given& given, const LimitsInFile& o) {
  if ((o.position_min.array() >= o.position_max.array()).any())
    given.fail("position_max", "must be above position_min at each of HAA, HFE and KFE");
}

/// Of all legs, or of one.
Group limits(LimitsInFile& o, const char* help) {
  return {of_joints("torque", o.torque, kPositive, "N·m", help),
          of_joints("velocity", o.velocity, kPositive, "rad/s", help),
          of_joints("position_min", o.position_min, kAngle, "rad", help),
          of_joints("position_max", o.position_max, kAngle, "rad", help)};
}

Group limits_of_all(LimitsInFile& o) {
  return limits(o, "without it the URDF's, joint by joint").with([&o](const Given& given) {
    require_all(given, "torque", o.torque);
    require_all(given, "velocity", o.velocity);
    require_all(given, "position_min", o.position_min);
    require_all(given, "position_max", o.position_max);
    require_order(given, o);
  });
}

Group drives(RobotInFile& o) {
  return Group{of_joints("stall_torque", o.stall_torque, kPositive, "N·m",
                         "torque–speed line: at rest; without it limits.torque"),
               of_joints("no_load_speed", o.no_load_speed, kPositive, "rad/s",
                         "torque–speed line: no torque; without it limits.velocity")}
      .with([&o](const Given& given) {
        require_all(given, "stall_torque", o.stall_torque);
        require_all(given, "no_load_speed", o.no_load_speed);
      });
}

Group posture(LegJoints& nominal, const char* help) {
  return Group{of_joints("nominal", nominal, kAnyNumber, "rad", help)}.with(
      [&nominal](const Given& given) {
        require_all(given, "nominal", nominal);
        if (nominal.y() * nominal.z() >= 0.0)
          given.fail("nominal", "HFE and KFE must bend the knee, one above 0 and the other below");
      });
}

/// One number for all joints, or of walkers HAA, HFE and KFE of each leg.
Field gain(const char* key, LegJoints& value, bool by_joint, const char* unit, const char* help) {
  if (by_joint) return of_joints(key, value, kNotNegative, unit, help);
  return {key, value.data(), kNotNegative, unit, help};
}

Group gains(GainsInFile& o, bool by_joint) {
  return {{"hold",
           Group{gain("kp", o.kp, by_joint, "N·m/rad", "stiffness"),
                 gain("kd", o.kd, by_joint, "N·m·s/rad", "damping")},
           "of joint hold"},
          gain("damping", o.damping, by_joint, "N·m·s/rad", "of damping mode")};
}

Group gains_of_all(RobotInFile& o) {
  const bool by_joint = o.robot.can_walk();
  return gains(o.gains, by_joint).with([&o, by_joint](const Given& given) {
    if (!by_joint) return;
    require_all(given, "hold.kp", o.gains.kp);
    require_all(given, "hold.kd", o.gains.kd);
    require_all(given, "damping", o.gains.damping);
  });
}

Group lists(JointLists& o) {
  return {
      {"posture", &o.posture, kAnyNumber, "rad",
       "of each joint; without it 0, or the nearest angle that its limits allow"},
      {"torque", &o.torque, kPositive, "N·m", "limit of each joint; without it the URDF's"},
      {"velocity", &o.velocity, kPositive, "rad/s", "limit of each joint; without it the URDF's"},
      {"position_min", &o.position_min, kAnyNumber, "rad", "of each joint; without it the URDF's"},
      {"position_max", &o.position_max, kAnyNumber, "rad", "of each joint; without it the URDF's"}};
}

Group leg_fields(model::LegDescription& leg, LegInFile& o) {
  return {
      {"joints", Names{&o.joints, kJointsPerLeg, "is not a list of 3 joints: HAA, HFE, KFE"},
       "HAA, HFE, KFE, which place the foot; without it found between base and foot"},
      {"hip", &leg.hip_frame, "frame at the HFE axis; without it the thigh"},
      {"thigh", &leg.thigh_link, "link; without it the one that HFE moves"},
      {"shank", &leg.shank_link,
       "link with the foot sphere; without it the last that a joint moves"},
      text("foot", leg.foot_frame, "frame that the sphere's centre is given in"),
      {"foot_radius", &o.foot_radius, kNotNegative, "m",
       "of this leg's sphere; without it foot.radius"},
      {"foot_center", Numbers{o.foot_center.data(), simulation::axis_elements()}, kAnyNumber, "m",
       "of this leg's sphere in the foot frame; without it foot.center"},
      {"limits",
       limits(o.limits, "of this leg; without it as of all legs, joint by joint")
           .with([&o](const Given& given) { require_order(given, o.limits); }),
       "of this leg's joints"},
      {"further", lists(o.lists), "other joints between base and foot, in this order"},
      {"posture", posture(o.nominal, "of this leg; without it as of all legs"), "of this leg"},
      {"gains", gains(o.gains, true), "of this leg; without it as of all legs, joint by joint"}};
}

/// Of one of two legs.
Group standing_leg_fields(model::LegDescription& leg, LegInFile& o) {
  return Group{{"joints", Names{&o.joints, 0, "is not a list of joints, from the base to the foot"},
                "without it those between base and foot"},
               {"hip", &leg.hip_frame, "frame; without it the link that the first joint moves"},
               text("foot", leg.foot_frame, "frame of the sole: x forward, z up")}
      .and_also(lists(o.lists));
}

Group all_legs(RobotInFile& o) {
  Group legs;
  for (const Leg leg : o.legs.legs()) {
    const std::string name(leg_name(leg, o.robot.num_legs()));
    model::LegDescription& names = o.robot.legs[index(leg)];
    LegInFile& given = o.legs[index(leg)];
    Field field{name,
                o.robot.can_walk() ? leg_fields(names, given) : standing_leg_fields(names, given),
                ""};
    field.is_required = !name.ends_with("M");
    legs.fields.push_back(std::move(field));
  }
  return legs;
}

/// Spheres of a walker, soles of a robot that only stands.
Group foot(RobotInFile& o) {
  model::RobotDescription& robot = o.robot;
  const Field center{"center", Numbers{o.foot_center.data(), simulation::axis_elements()},
                     kAnyNumber, "m", "of the sphere or the sole in the foot frame"};
  if (robot.can_walk())
    return {
        Field{"radius", &o.foot_radius, kNotNegative, "m", "of the sphere; 0: a point"}.required(),
        center};
  return {Field{"size", Numbers{robot.sole.data(), {"x", "y"}}, kPositive, "m",
                "length and width of the sole"}
              .required(),
          center};
}

}  // namespace

Group fields(ArmInFile& o) {
  return Group{
      text("name", o.names.name, "of the arm; tasks know its tip by it"),
      text("tip", o.names.tip_frame, "frame at its end, for frame_position and frame_orientation"),
      {"joints", Names{&o.names.joints, 0, "is not a list of joints, from the base to the tip"},
       "without it those between the base, or an arm before it, and the tip"}}
      .and_also(lists(o.lists));
}

void set_num_legs(RobotInFile& robot, int num_legs) {
  robot.legs.resize(num_legs);
  robot.robot.legs.resize(num_legs);
}

Group fields(RobotInFile& o) {
  model::RobotDescription& robot = o.robot;
  Group group{
      text("name", robot.name, "of the robot"),
      {"urdf", &robot.urdf_path, "package:// name, or a file as seen from here"},
      {"mjcf", &o.mjcf, "instead of urdf: likewise, of a robot described for MuJoCo"},
      {"base", &robot.base_link, "link; without it the root"},
      Field{"legs", all_legs(o), "names of the URDF"}.required(),
      Field{"foot", foot(o), "what each foot stands on"}.required(),
      {"limits", limits_of_all(o.limits),
       "of the joints; one number for all, or HAA, HFE and KFE of each leg"},
      {"drives", drives(o), "of the joints, as limits"},
      {"arms",
       Entries{{shape_of<ArmInFile>(
                   "", [&o](const ArmInFile& arm, const Given&) { o.arms.push_back(arm); })},
               "is not a list of arms"},
       "limbs that stand on nothing; a joint that moves belongs to a leg or to one of them"},
      {"posture",
       posture(o.nominal, "of a front leg, its knee backward; hind legs mirror HFE and KFE"),
       "without it knees bent as the limits allow"},
      {"gains", gains_of_all(o),
       "of the safety ladder; one number for all joints, or HAA, HFE and KFE of each leg"},
      {"guessed", Names{&o.guessed, 0, "is not a list of keys or texts"},
       "numbers of this file that are not measured; every run tells them"}};
  if (!robot.can_walk())
    std::erase_if(group.fields, [](const Field& field) {
      return field.key == "limits" || field.key == "drives" || field.key == "posture";
    });
  return group;
}

}  // namespace surefoot::config
