import { counted, secondsText } from "./numbers.ts";

/** A log's name, and what is not as it ought to be with it: the program says where it was cut off; `damage`: what can't be read. */
export function logText(source: string, cut: string, damage: string[]): string {
  const pieces = damage.length === 0 ? "" : `damaged: ${counted(damage.length, "piece")} of it can't be read`;
  const faults = [cut, pieces].filter((one) => one !== "");
  return faults.length === 0 ? source : `${source} (${faults.join("; ")})`;
}

/** Words of the program begin as those of the page do; a file's name stays what it is. */
export const capitalised = (text: string): string => text.replace(/^[a-z]+(?= )/, (word) => word.charAt(0).toUpperCase() + word.slice(1));

/** Words of the program as a sentence of the page. */
export const asSentence = (text: string): string => `${capitalised(text)}.`;

/** More than these are counted. */
const MOST = 12;

/** Where the text says from when to when. */
const SPAN = /\d s to \d/;

/** What of a log can't be read: first that the rest is there, then each piece, those of a time that is known before others. */
export function damageText(damage: string[]): string {
  const pieces = [...damage.filter((one) => SPAN.test(one)), ...damage.filter((one) => !SPAN.test(one))];
  const more = pieces.length > MOST ? `; and ${pieces.length - MOST} more` : "";
  return `This log is damaged, the rest of it can be seen: ${pieces.slice(0, MOST).join("; ")}${more}.`;
}

/** That of a tick of a log nothing is left, and which time is shown instead. */
export function unreadableText(shown: number): string {
  return `This tick can't be read: shown is ${secondsText(shown)}.`;
}

/** How much of a log is summarised [s], for long plots and the list of events. */
export function readText(read: number, whole: number): string {
  return `Reading the log: ${Math.floor(read)} s of ${Math.max(1, Math.round(whole))} s`;
}

/** The log that a live run goes into, as it is told beside what the run is: the file has its name when it is whole. */
export function recordingText(path: string, hasEnded: boolean): string {
  if (path === "") return "none: run it with --record FILE to keep one";
  return hasEnded ? `recorded in ${path}` : `goes into ${path}.partial, which is called ${path} when the run has ended`;
}

/** The command that gives this run again, and what it leaves out: what was changed while the run was watched is in its log alone; `hasEnded`:
 * that log can be read by its name. */
export function againText(command: string, log: string, isWhole: boolean, isSteered: boolean, hasEnded = true): string {
  if (command === "") return "";
  const repeat = log === "" ? "its log (--record) has that, and replay --verify repeats it" : `${hasEnded ? "" : "when the run has ended, "}bin/surefoot replay ${log} --verify repeats it`;
  const steered = `without what was changed and pushed by hand: ${repeat}`;
  const remarks = [isWhole ? "" : "it goes on where this log ends", isSteered ? steered : ""].filter((one) => one !== "");
  return remarks.length === 0 ? command : `${command} (${remarks.join("; ")})`; // so that it can be copied
}
