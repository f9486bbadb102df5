import { scalar, word, type Frame } from "./frame.ts";

/** What is wrong with a group of sensors, as the program says it. */
const VERBS: Record<string, string> = {
  silent: "stopped", late: "came late", not_a_number: "gave no numbers", out_of_range: "left the range", jump: "changed too fast", repeats: "repeated",
  contradicts: "did not fit the rest",
};
const GROUPS: Record<string, [one: string, all: string]> = {
  encoders: ["encoder", "encoders"], joint_torques: ["joint torque", "joint torques"], imu: ["IMU", "IMU"],
};
/** Faults of all sensors of a group at once. */
const OF_ALL = ["silent", "late"];
const CAUSES: Record<string, string> = {
  tilt: "the torso tilted too far", failures: "too many ticks without a solution", cannot_stand: "it could not stand up",
  fallen: "it fell",
};

/** Why the controller has stopped for safety; "": it has not. */
export function stopText(frame: Frame): string {
  const cause = word(frame, "command.cause");
  const group = GROUPS[cause];
  if (group === undefined) return CAUSES[cause] ?? "";
  const [one, all] = group;
  // What was wrong when it stopped; logs before 2.8 know only what is wrong now.
  const from = word(frame, "command.fault") in VERBS ? "command" : `health.${cause}`;
  const fault = word(frame, `${from}.fault`), at = scalar(frame, `${from}.joint`);
  return `${sensorText([one, all], cause, fault, jointName(frame, at))} ${VERBS[fault] ?? "failed"}`;
}

const jointName = (frame: Frame, at: number): string | undefined => frame.schema.channel("state.q")?.labels?.[at];

function sensorText([one, all]: [string, string], group: string, fault: string, joint: string | undefined): string {
  if (group === "imu") return all; // which is of no joint
  if (joint !== undefined) return `${one} ${joint}`;
  return !(fault in VERBS) || OF_ALL.includes(fault) ? all : `${all} of several joints`;
}

/** What is wrong with the sensors at this tick, in the same words; "": nothing. */
export function faultsText(frame: Frame): string {
  const faults = Object.entries(GROUPS).flatMap(([group, names]) => {
    const fault = word(frame, `health.${group}.fault`);
    const verb = VERBS[fault];
    return verb === undefined ? [] : [`${sensorText(names, group, fault, jointName(frame, scalar(frame, `health.${group}.joint`)))} ${verb}`];
  });
  return faults.join(", ");
}

/** Whose the command is: of the solution, or of another mode, and why. */
export function commandText(frame: Frame): string {
  const mode = word(frame, "command.mode"), why = stopText(frame);
  return `${mode}${why === "" ? "" : `, as ${why}`}`;
}
