import { word, type Frame } from "./frame.ts";

/** Why the controller has stopped for safety, in the program's words; "": it has not. */
export function stopText(frame: Frame): string {
  return word(frame, "told.stop");
}

/** What is wrong with the sensors at this tick; "": nothing. */
export function faultsText(frame: Frame): string {
  return ["encoders", "joint_torques", "imu"].map((group) => word(frame, `told.${group}`)).filter((text) => text !== "").join(", ");
}

/** Mode of the command, and why it is not the solution. */
export function commandText(frame: Frame): string {
  const mode = word(frame, "command.mode"), why = stopText(frame);
  return `${mode}${why === "" ? "" : `, as ${why}`}`;
}
