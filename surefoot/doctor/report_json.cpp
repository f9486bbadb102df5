#include "surefoot/doctor/knees.hpp"
#include "surefoot/doctor/report.hpp"
#include "surefoot/logging/json_text.hpp"

namespace surefoot::doctor {
namespace {

using logging::JsonText;

void add_vector(JsonText& json, const char* key, const Vec3& vector) {
  json.key(key).array().value(vector.x()).value(vector.y()).value(vector.z()).end_array();
}

template <typename Joints>
void add_joints(JsonText& json, const Joints& joints) {
  json.key("joints").array();
  for (const model::UrdfJoint& joint : joints) json.value(joint.name);
  json.end_array();
}

void add_leg(JsonText& json, const FoundLeg& leg) {
  json.object();
  add_joints(json, leg.joints);
  json.key("all_joints").array();
  for (const model::UrdfJoint& joint : leg.all_joints) json.value(joint.name);
  json.end_array();
  add_vector(json, "hip_m", leg.hip);
  json.member("thigh_m", leg.thigh).member("shank_m", leg.shank);
  json.member("knee_bends", name(knee_sides(leg)));
  json.key("foot").object().member("link", leg.foot.link).member("radius_m", leg.foot.radius);
  add_vector(json, "center_m", leg.foot.center);
  json.key("guessed_from");
  if (leg.foot.guessed_from.empty()) {
    json.null();
  } else {
    json.value(leg.foot.guessed_from);
  }
  json.end_object().end_object();
}

void add_limbs(JsonText& json, const Anatomy& anatomy) {
  json.key("legs").object();
  if (anatomy.legs) {
    const auto names = leg_names(static_cast<int>(anatomy.legs->size()));
    for (const Leg leg : anatomy.legs->legs()) {
      json.key(names[index(leg)]);
      add_leg(json, (*anatomy.legs)[index(leg)]);
    }
  }
  if (anatomy.flat_legs) {
    for (const Leg leg : first_legs(2)) {
      const FlatLeg& flat = anatomy.flat_legs->legs[index(leg)];
      json.key(leg_name(leg, 2)).object();
      add_joints(json, flat.joints);
      json.member("foot", flat.foot).end_object();
    }
  }
  json.end_object().key("limbs_of_three_hinges").array();
  for (const FoundLeg& leg : anatomy.loose) add_leg(json, leg);
  json.end_array().key("other_limbs").array();
  for (const Limb& limb : anatomy.others) {
    json.object();
    add_joints(json, limb.joints);
    json.member("no_leg", limb.no_leg).end_object();
  }
  json.end_array();
}

void add_proportions(JsonText& json, const Diagnosis& robot) {
  json.key("proportions");
  if (!robot.proportions) {
    json.null();
    return;
  }
  const Scale scale = model::scale_of(*robot.proportions);
  json.object().member("leg_m", robot.proportions->leg).member("mass_kg", robot.proportions->mass);
  json.member("length_scale", scale.length).member("mass_scale", scale.mass);
  json.member("standing_torque_max_nm", robot.standing_torque.cwiseAbs().maxCoeff());
  if (robot.reach) {
    json.member("stance_share_of_reach", robot.reach->stretched);
    json.member("stance_from_haa_axis_m", robot.reach->from_haa * robot.reach->longest);
  }
  json.end_object();
}

void add_findings(JsonText& json, const Findings& findings) {
  json.key("findings").array();
  for (const Finding& finding : findings) {
    json.object().member("severity", name(finding.severity));
    json.member("confidence", name(finding.confidence)).member("subject", finding.subject);
    json.key("line");
    if (finding.line > 0) {
      json.value(finding.line);
    } else {
      json.null();
    }
    json.member("what", finding.what).member("remedy", finding.remedy).end_object();
  }
  json.end_array();
}

void add_trials(JsonText& json, const std::vector<Trial>& trials) {
  json.key("trials").array();
  for (const Trial& trial : trials) {
    json.object().member("scenario", trial.scenario).member("succeeded", trial.succeeded);
    json.member("why", trial.why).end_object();
  }
  json.end_array();
}

}  // namespace

std::string report_json(const Diagnosis& robot, const std::vector<Trial>& trials) {
  std::string text;
  JsonText json(text);
  json.object().member("name", robot.name).member("urdf", robot.urdf.path);
  json.member("base", robot.anatomy.base).member("root", robot.anatomy.root);
  json.member("torso", robot.anatomy.torso);
  add_limbs(json, robot.anatomy);
  add_proportions(json, robot);
  add_findings(json, robot.findings);
  add_trials(json, trials);
  json.end_object();
  return text;
}

}  // namespace surefoot::doctor
