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

/** How much of a log is summarised [s], for long plots and the list of events. */
export function readText(read: number, whole: number): string {
  return `Reading the log: ${Math.floor(read)} s of ${Math.ceil(whole)} s`;
}
