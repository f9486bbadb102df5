import { counted, secondsText } from "./numbers.ts";

/** A log's name and its faults; `cut`: the program's words on a missing end; `damage`: unreadable pieces. */
export function logText(source: string, cut: string, damage: string[]): string {
  const pieces = damage.length === 0 ? "" : `damaged: ${counted(damage.length, "piece")} of it can't be read`;
  const faults = [cut, pieces].filter((one) => one !== "");
  return faults.length === 0 ? source : `${source} (${faults.join("; ")})`;
}

/** Capitalises the program's words; a file name stays. */
export const capitalised = (text: string): string => text.replace(/^[a-z]+(?= )/, (word) => word.charAt(0).toUpperCase() + word.slice(1));

/** The program's words as a sentence. */
export const asSentence = (text: string): string => `${capitalised(text)}.`;

/** Most pieces that are listed. */
const MOST = 12;

/** Matches a text with a time range. */
const SPAN = /\d s to \d/;

/** Message on unreadable pieces of a log, those with known times first. */
export function damageText(damage: string[]): string {
  const pieces = [...damage.filter((one) => SPAN.test(one)), ...damage.filter((one) => !SPAN.test(one))];
  const more = pieces.length > MOST ? `; and ${pieces.length - MOST} more` : "";
  return `This log is damaged, the rest of it can be seen: ${pieces.slice(0, MOST).join("; ")}${more}.`;
}

/** Message on an unreadable tick, and the time that is shown instead. */
export function unreadableText(shown: number): string {
  return `This tick can't be read: shown is ${secondsText(shown)}.`;
}

/** Progress of the summary [s], which long plots and events need. */
export function readText(read: number, whole: number): string {
  return `Reading the log: ${Math.floor(read)} s of ${Math.max(1, Math.round(whole))} s`;
}

/** The log of a live run; the file has its final name once it is complete. */
export function recordingText(path: string, hasEnded: boolean): string {
  if (path === "") return "none: run it with --record FILE to keep one";
  return hasEnded ? `recorded in ${path}` : `goes into ${path}.partial, which is called ${path} when the run has ended`;
}

/** The command that repeats this run, and what it leaves out: changes by hand are only in the log; `hasEnded`: the log has its final name. */
export function againText(command: string, log: string, isWhole: boolean, isSteered: boolean, hasEnded = true): string {
  if (command === "") return "";
  const repeat = log === "" ? "its log (--record) has that, and replay --verify repeats it" : `${hasEnded ? "" : "when the run has ended, "}bin/surefoot replay ${log} --verify repeats it`;
  const steered = `without what was changed and pushed by hand: ${repeat}`;
  const remarks = [isWhole ? "" : "it goes on where this log ends", isSteered ? steered : ""].filter((one) => one !== "");
  return remarks.length === 0 ? command : `${command} (${remarks.join("; ")})`; // the command first, for copying
}
