#include "surefoot/gaits/planner_options.hpp"

#include "surefoot/base/fields.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/gaits/parts/com_planner.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr NumberRange kSteps{.min = 1, .max = ComPlanner::kMaxSteps};
constexpr NumberRange kLegShare{.min = 0.34, .max = 1.0, .words = "a number from 0.34 to 1"};
constexpr NumberRange kDuty{
    .min = 0.0, .max = 1.0, .min_included = false, .words = "a number above 0 and below 1"};
constexpr NumberRange kFrequency{.min = 0.1, .max = 100.0, .words = "from 0.1 to 100 rad/s"};
constexpr NumberRange kMaxTilt{.min = 0.0, .max = 1.5, .words = "from 0 to 1.5 rad"};
constexpr NumberRange kTilt{.min = 0.0, .max = 0.3, .words = "from 0 to 0.3 rad"};

Order order_of(PerLeg<Leg>& order) {
  const auto names = leg_names(static_cast<int>(order.size()));
  Order result{.names = {names.begin(), names.end()},
               .set =
                   [&order](const std::vector<std::size_t>& legs) {
                     for (std::size_t i = 0; i < order.size(); ++i) order[i] = kAllLegs[legs[i]];
                   },
               .given = {},
               .what = "leg"};
  for (const Leg leg : order) result.given.push_back(index(leg));
  return result;
}

Group fields(StanceOptions& o) {
  return {{"half_length", &o.half_length, kPositive, "m",
           "x of the front feet, −x of the hind feet", Sizing::half_length},
          {"half_width", &o.half_width, kPositive, "m", "y of the left feet, −y of the right feet",
           Sizing::half_width},
          {"height", &o.height, kPositive, "m", "base above the sphere centres of the feet",
           Sizing::base_height},
          {"knees", choice(o.knees, {"x", "forward", "backward"}),
           "where the knees point: x is front backward and hind forward, forward is for the way "
           "downstairs, backward for the way upstairs"}};
}

Group fields(GaitOptions& o) {
  return {
      {"order", order_of(o.order), "of the swings, walking forward; backward, front and hind swap"},
      {"swing_duration", &o.swing_duration, kPositive, "s", "lift-off to expected touchdown"},
      {"same_side_duration", &o.same_side_duration, kNotNegative, "s",
       "four feet down between swings of a side"},
      {"switch_duration", &o.switch_duration, kNotNegative, "s",
       "four feet down, then the other side swings"},
      {"start_duration", &o.start_duration, kNotNegative, "s", "before the first step"}};
}

/// Of a foot that rises and comes down again: more is no leg's [m/s²].
constexpr double kMostLift = 50.0;

/// A robot of the reference's size on the other legs tips over in less [s].
constexpr double kLongestSwing = 1.0;

/// Each leg must have time to swing, and a stance that its force ramps fit in.
void check_rhythm(const PlannerOptions& o, const Given& given) {
  const RhythmOptions& rhythm = o.rhythm;
  const double ramps = o.force.ramps ? o.force.ramp_up + o.force.ramp_down : 0.0;
  for (const Leg leg : rhythm.duty.legs()) {
    const double duty = rhythm.duty[index(leg)], stance = duty * rhythm.period;
    const std::string name(leg_name(leg, o.gait.num_legs()));
    if (!rhythm.enabled) continue;
    if (duty >= 1.0) {
      given.fail("rhythm.duty",
                 formatted("of %s is %g; a leg that steps needs less than 1", name.c_str(), duty));
    }
    if (stance < ramps) {
      given.fail("rhythm.period",
                 formatted("%g s, and a duty of %g, give %s a stance of %g s; it must last as long "
                           "as force.ramp_up and force.ramp_down, %g s",
                           rhythm.period, duty, name.c_str(), stance, ramps));
    }
    const double swing = rhythm.period - stance, least = std::sqrt(8.0 * o.swing.apex / kMostLift);
    if (swing > kLongestSwing) {
      given.fail("rhythm.period",
                 formatted("%g s, and a duty of %g, let %s swing for %g s; valid is a swing of at "
                           "most %g s",
                           rhythm.period, duty, name.c_str(), swing, kLongestSwing));
    }
    if (swing >= least) continue;
    given.fail("rhythm.duty",
               formatted("of %s is %g, which leaves it %g s to swing; to rise by swing.apex, %g m, "
                         "takes at least %.2g s",
                         name.c_str(), duty, swing, o.swing.apex, least));
  }
}

bool stands(const RhythmOptions& rhythm, Leg leg, double phase) {
  const double since = phase - rhythm.offset[index(leg)];
  return since - std::floor(since) >= 1.0 - rhythm.duty[index(leg)];
}

/// A gait that does not fly always has a foot down, but for the instant between two steps.
void check_flight(const PlannerOptions& o, const Given& given) {
  constexpr int kSamples = 1000, kInstant = 5;
  const RhythmOptions& rhythm = o.rhythm;
  if (!rhythm.enabled || rhythm.flies) return;
  int flies = 0;
  for (int i = 0; i < 2 * kSamples; ++i) {
    const double phase = (i + 0.5) / kSamples;
    const auto legs = rhythm.duty.legs();
    const bool bears =
        std::ranges::any_of(legs, [&](Leg leg) { return stands(rhythm, leg, phase); });
    flies = bears ? 0 : flies + 1;
    if (flies < kInstant) continue;
    const auto [least, most] = std::ranges::minmax(rhythm.duty);
    const std::string duty =
        least == most ? formatted("of %g", least) : formatted("from %g to %g", least, most);
    given.fail("rhythm.offset",
               formatted("with a rhythm.duty %s it leaves no foot on the ground at %.2f of the "
                         "cycle; a gait with rhythm.flies may do so",
                         duty.c_str(), phase - std::floor(phase)));
  }
}

Group fields(RhythmOptions& o) {
  const auto all = leg_names(static_cast<int>(o.duty.size()));
  const std::vector<std::string> legs(all.begin(), all.end());
  return {
      {"enabled", &o.enabled, "whether the legs step by a clock; otherwise the robot crawls"},
      {"stands", &o.stands, "whether all feet stay where they are"},
      {"flies", &o.flies, "whether all feet may be in the air at once"},
      {"speed_max", &o.speed_max, kPositive, "m/s", "of a foot relative to the torso"},
      {"chosen_to", &o.chosen_to, kNotNegative, "m/s",
       "up to which `gait: auto` chooses it; 0: never"},
      {"period", &o.period, kPositive, "s", "of the cycle"},
      {"duty", Numbers{o.duty.data(), legs, true}, kDuty, "", "share in which a leg stands"},
      {"offset", Numbers{o.offset.data(), legs}, kShare, "", "when a leg lifts off"},
      {"sway", &o.sway, kShare, "", "of the way from the feet's middle to those that stand"},
      {"pitch", &o.pitch, kShare, "", "of the sway forth and back that pitches the torso instead"},
      {"capture", &o.capture, kNotNegative, "", "of √(h/g), per velocity error: footholds"},
      {"leash", &o.leash, kPositive, "m", "from the COM to its reference, at most"},
      {"acceleration", &o.acceleration, kPositive, "m/s²", "of the reference, at most"},
      {"wait", &o.wait, kNotNegative, "s", "of the clock for a late foot, at most"},
      {"stop_speed", &o.stop_speed, kPositive, "m/s", "of the COM: a slower robot may stand"},
      {"integral_rate", &o.integral_rate, kNotNegative, "1/s", "of the velocity's error"},
      {"integral_max", &o.integral_max, kNotNegative, "m/s", "that it adds, at most"},
      {"rise", &o.rise, kNotNegative, "m", "of a slow gait's feet, over swing.apex"},
      {"crouch", &o.crouch, kNotNegative, "m", "of a slow gait's torso, below the stance's"},
      {"fast", &o.fast, kPositive, "m/s", "from here on no rise or crouch; all up to its half"}};
}

Group fields(ForceOptions& o) {
  return Group{
      {"friction", &o.friction, kPositive, "", "μ of the friction pyramid"},
      {"min", &o.min, kNotNegative, "N", "f_min of a loaded foot"},
      {"max", &o.max, kPositive, "N", "f_max of a loaded foot, above the robot's weight"},
      {"ramp_up", &o.ramp_up, kNotNegative, "s", "f_max from 0 to max after a touchdown"},
      {"ramp_down", &o.ramp_down, kNotNegative, "s", "f_max from max to 0 before a lift-off"},
      {"ramps", &o.ramps, "false: forces are not modulated, for comparison"}}
      .with([&o](const Given& given) { given.require_order("min", o.min, "max", o.max); });
}

Group fields(GripOptions& o) {
  return Group{
      {"enabled", &o.enabled, "whether feet that slide are believed to have less friction"},
      {"friction_min", &o.friction_min, kPositive, "", "lowest friction that is believed"},
      {"share", &o.share, kShare, "", "of |f_t| / f_n at which a foot slides: believed afterwards"},
      {"recovery", &o.recovery, kNotNegative, "1/s", "toward force.friction, without sliding"},
      {"enough", &o.enough, kPositive, "", "with less friction under a foot the walk slows down"},
      {"caution_max", &o.caution_max, kPositive, "", "the walk slows down at most by this factor"}}
      .with([&o](const Given& given) {
        if (o.caution_max < 1.0) given.fail("caution_max", "must not be below 1");
      });
}

Group fields(ComPlannerOptions& o) {
  return {{"zmp_margin", &o.zmp_margin, kNotNegative, "m", "ZMP inside the support region"},
          {"rest_margin", &o.rest_margin, kNotNegative, "m",
           "capture point inside the swing's triangle"},
          {"horizon_steps", &o.horizon_steps, kSteps, "", "swings that the QP looks ahead"},
          {"sample_interval", &o.sample_interval, kPositive, "s", "of the ZMP constraints"},
          {"terminal_weight", &o.terminal_weight, kNotNegative, "1/s²",
           "pull of the end to the feet's centre"},
          {"leg_share", &o.leg_share, kLegShare, "", "of the weight, on one leg in the plan"}};
}

Group fields(SwingOptions& o) {
  return Group{
      {"apex", &o.apex, kPositive, "m", "height over the higher of start and goal"},
      {"apex_known", &o.apex_known, kPositive, "m", "the same for hind feet onto footprints"},
      {"horizontal_start", &o.horizontal_start, kShare, "", "of the swing: horizontal motion from"},
      {"horizontal_end", &o.horizontal_end, kShare, "", "of the swing: horizontal motion until"},
      {"hip_height_min", &o.hip_height_min, kNotNegative, "m",
       "of the hip over the last foothold in a search"},
      {"touchdown_speed", &o.touchdown_speed, kPositive, "m/s",
       "downward, at the end of the swing and in the search; slow feet are detected late"},
      {"search_speed", &o.search_speed, kNotNegative, "m/s",
       "downward, of a late foot; not above touchdown_speed: that one"},
      {"search_depth_max", &o.search_depth_max, kNotNegative, "m", "below the expected ground"},
      {"reach_max", &o.reach_max, kPositive, "m", "hip to swing foot, short of a straight leg"},
      {"speed_max", &o.speed_max, kPositive, "m/s", "of a swing; longer strides walk slower"},
      {"armed_after", &o.armed_after, kShare, "", "of the swing: touchdown is believed from"},
      {"lead", &o.lead, kNotNegative, "s",
       "of the asked acceleration, for drives that answer late"}}
      .with([&o](const Given& given) {
        if (o.horizontal_end <= o.horizontal_start)
          given.fail("horizontal_end", "must be above horizontal_start");
      });
}

Group fields(TouchdownOptions& o) {
  return {
      {"touchdown_force", &o.touchdown_force, kPositive, "N", "of a swing foot that touched"},
      {"torque_error", &o.torque_error, kNotNegative, "N·m",
       "torques that are wrong by this make forces larger where a leg is nearly straight"},
      {"lift_off_force", &o.lift_off_force, kPositive, "N", "below which a foot may be lifted"},
      {"stall_error", &o.stall_error, kPositive, "m",
       "behind its reference, with stall_force: touched"},
      {"bounce_speed", &o.bounce_speed, kPositive, "m/s",
       "or faster upward than 10 ms ago: touched"},
      {"bounce_force", &o.bounce_force, kNotNegative, "N", "while its force rises by this"},
      {"stall_force", &o.stall_force, kNotNegative, "N", "of a foot behind its reference"},
      {"lost_force", &o.lost_force, kNotNegative, "N", "a loaded foot below it has lost contact"},
      {"lost_duration", &o.lost_duration, kNotNegative, "s", "see lost_force"}};
}

Group fields(ReflexOptions& o) {
  return {
      {"enabled", &o.enabled, "whether a foot that hits something goes back and over it"},
      {"force", &o.force, kPositive, "N", "against the foot's motion, together with error"},
      {"hit_force", &o.hit_force, kPositive, "N", "against its motion, without an error"},
      {"error", &o.error, kPositive, "m", "behind its reference along the motion, with force"},
      {"duration", &o.duration, kNotNegative, "s", "of force or hit_force"},
      {"back", &o.back, kNotNegative, "m", "away from the obstacle while the foot rises"},
      {"beyond", &o.beyond, kNotNegative, "m", "the obstacle, where no foothold is"},
      {"most", &o.most, {.min = 0}, "", "tries of one swing; then the foot comes down before it"}};
}

Group fields(ProbeOptions& o) {
  return {
      {"enabled", &o.enabled, "whether front feet touch ahead of their foothold first"},
      {"ahead", &o.ahead, kPositive, "m", "first touch ahead of the foothold"},
      {"tolerance", &o.tolerance, kPositive, "m", "within it of the last foothold: same ground"},
      {"lift", &o.lift, kPositive, "m", "between the touches"},
      {"beyond", &o.beyond, kNotNegative, "m", "the first touch, of the foothold on other ground"},
      {"duration", &o.duration, kPositive, "s", "of the second swing"}};
}

Group fields(TorsoOptions& o) {
  return {{"frequency", &o.frequency, kFrequency, "rad/s", "of the reference filter, third order"},
          {"max_tilt", &o.max_tilt, kMaxTilt, "rad", "of the reference"},
          {"follow_terrain", &o.follow_terrain, "roll and pitch from the plane of the footholds"}};
}

Group fields(FrictionFrameOptions& o) {
  return {
      {"time_constant", &o.time_constant, kNotNegative, "s", "after the plane of the footholds"},
      {"rate_max", &o.rate_max, kPositive, "rad/s", "of the pyramids' normal"}};
}

Group fields(FootholdOptions& o) {
  return {
      {"hind_use_front_prints", &o.hind_use_front_prints, "hind feet step where front feet stood"},
      {"print_radius", &o.print_radius, kNotNegative, "m",
       "a footprint is so near the nominal foothold"},
      {"same_height", &o.same_height, kPositive, "m",
       "beyond it an edge lies between two footprints"},
      {"bounded_by_feet", &o.bounded_by_feet,
       "front feet expect ground no higher than the feet, or as their last stride rose"},
      {"max_step", &o.max_step, kPositive, "m", "longest step"},
      {"max_stride", &o.max_stride, kPositive, "m", "longest; a longer one walks slower"},
      {"max_side_stride", &o.max_side_stride, kPositive, "m", "the same sideways"},
      {"stretch_max", &o.stretch_max, kNotNegative, "m", "front to hind foot, beyond the stance's"},
      {"max_side_step", &o.max_side_step, kPositive, "m", "longest step sideways"},
      {"void_radius", &o.void_radius, kPositive, "m", "around where a foot found no ground"}};
}

Group fields(CalibrationOptions& o) {
  return Group{{"duration", &o.duration, kNotNegative, "s",
                "of turning on the spot before the first step; 0: none; a payload's height needs "
                "3 s, and roll or pitch"},
               {"settle", &o.settle, kNotNegative, "s", "standing still before it"},
               {"roll", &o.roll, kTilt, "rad", "amplitude, under a window that rises and falls"},
               {"pitch", &o.pitch, kTilt, "rad", "amplitude"},
               {"yaw", &o.yaw, kTilt, "rad", "amplitude"}};
}

Group fields(PushOptions& o) {
  return {
      {"enabled", &o.enabled, "whether the walk reacts to forces that push or pull the robot"},
      {"replan_step", &o.replan_step, kPositive, "N",
       "change of the force: the COM is planned again"},
      {"replan_interval", &o.replan_interval, kNotNegative, "s", "… but not more often"},
      {"settling_time", &o.settling_time, kPositive, "s", "of the filter that it is compared with"},
      {"unsteady", &o.unsteady, kPositive, "N", "no lift-off while they differ by more"},
      {"unsteady_share", &o.unsteady_share, kNotNegative, "",
       "of the force; both must be exceeded"},
      {"slow_shift", &o.slow_shift, kPositive, "m", "shift of the ZMP that halves the velocity"},
      {"foot_down_excess", &o.foot_down_excess, kNotNegative, "m",
       "a foot comes down at once if the capture point would leave the other feet's triangle "
       "by this when it lands"},
      {"foot_down_duration", &o.foot_down_duration, kPositive, "s", "of the way down"},
      {"lift_off_margin", &o.lift_off_margin, kNotNegative, "m",
       "capture point inside the triangle"},
      {"steps", &o.steps, "with all feet down and the capture point leaving them, one foot steps"},
      {"step_margin", &o.step_margin, kAnyNumber, "m", "… when it is less far inside their region"},
      {"step_duration", &o.step_duration, kPositive, "s", "of that swing"},
      {"step_apex", &o.step_apex, kPositive, "m", "of that swing"},
      {"step_max", &o.step_max, kNotNegative, "m", "how far a foot goes to catch the robot"},
      {"capture_margin", &o.capture_margin, kAnyNumber, "m", "capture point inside the new region"},
      {"calm_margin", &o.calm_margin, kAnyNumber, "m", "capture point inside: the walk goes on"},
      {"zmp_margin", &o.zmp_margin, kNotNegative, "m", "ZMP inside until the walk goes on"}};
}

/// A leg must be fully loaded after its touchdown before the next one is unloaded.
void check_switches(const PlannerOptions& o, const Given& given) {
  if (o.rhythm.enabled) return;
  const double least = o.force.ramps ? o.force.ramp_up + o.force.ramp_down : 0.0;
  for (const auto& [name, duration] : {std::pair{"switch_duration", o.gait.switch_duration},
                                       {"same_side_duration", o.gait.same_side_duration}}) {
    if (duration > least - 1e-9) continue;
    given.fail("gait", formatted("%s is %g s; it must last as long as force.ramp_up and "
                                 "force.ramp_down, %g s",
                                 name, duration, least));
  }
}

/// Otherwise every search would end at once.
void check_hip_height(const PlannerOptions& o, const Given& given) {
  if (o.swing.hip_height_min < o.stance.height) return;
  given.fail("swing", formatted("hip_height_min is %g m; it must be below stance.height, %g m",
                                o.swing.hip_height_min, o.stance.height));
}

}  // namespace

bool begins_at_rest(const RhythmOptions& options, const Scale& scale) {
  constexpr double kLongCycle = 0.8;  // [s]
  return !options.enabled || options.period >= scale.time() * kLongCycle;
}

void set_num_legs(PlannerOptions& options, int num_legs) {
  if (num_legs == options.gait.num_legs()) return;
  RhythmOptions& rhythm = options.rhythm;
  options.gait.order = usual_order(num_legs);
  rhythm.duty = per_leg(rhythm.duty[0], num_legs);
  rhythm.offset.resize(num_legs);
  for (const Leg leg : rhythm.offset.legs()) {
    const int pair = static_cast<int>(leg) / 2;
    rhythm.offset[index(leg)] = is_left(leg) == (pair % 2 == 0) ? 0.0 : 0.5;
  }
}

PerLeg<Leg> usual_order(int num_legs) {
  PerLeg<Leg> result(num_legs, Leg::LF);
  const int pairs = num_legs / 2;
  for (int i = 0; i < num_legs; ++i)
    result[static_cast<std::size_t>(i)] = static_cast<Leg>(2 * (pairs - 1 - i % pairs) + i / pairs);
  return result;
}

Group fields(PlannerOptions& o) {
  return Group{{"calibration", fields(o.calibration), "turning on the spot, for the estimator"},
               {"stance", fields(o.stance), "feet relative to the torso, in the control frame"},
               {"gait", fields(o.gait), "order and timing of the walk"},
               {"rhythm", fields(o.rhythm), "a gait by a clock, see gaits/"},
               {"force", fields(o.force), "contact forces at phase changes, Eq. (30)"},
               {"grip", fields(o.grip), "what is done about feet that slide"},
               {"com", fields(o.com), "trajectory of the centre of mass"},
               {"swing", fields(o.swing), "trajectory of a foot in the air"},
               {"contact", fields(o.contact), "when a foot counts as down, as up, or as lost"},
               {"reflex", fields(o.reflex), "step reflex of a foot that hits something"},
               {"probe", fields(o.probe), "an edge is found before the foot is loaded"},
               {"torso", fields(o.torso), "how the torso follows the terrain"},
               {"friction_frame", fields(o.friction_frame), "normal of the friction pyramids"},
               {"foothold", fields(o.foothold), "where feet step"},
               {"push", fields(o.push), "reactions to forces that push or pull the robot"}}
      .with([&o](const Given& given) {
        check_switches(o, given);
        check_rhythm(o, given);
        check_flight(o, given);
        check_hip_height(o, given);
      });
}

}  // namespace surefoot::gaits
