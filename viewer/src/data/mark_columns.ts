import { secondsText } from "./numbers.ts";
import type { Mark } from "./source.ts";

/** Importance of a mark on the time bar: the weightier of two in one place is drawn. */
export type Weight = "usual" | "change" | "notable" | "grave";

const WEIGHTS: readonly Weight[] = ["usual", "change", "notable", "grave"];

/** Events outside a usual walk. */
const NOTABLE = /slide|push|lost|no ground|abort|met something/;

export function endingText(why: string): string {
  return `ended: ${why}`;
}

/** The program's texts for a regular end. */
const PLAIN_ENDS = ["ran to its end", "the whole duration", "goal reached"].map(endingText); // the second in older logs

export function weightOf({ kind, text }: Pick<Mark, "kind" | "text">): Weight {
  if (kind === "end") return PLAIN_ENDS.includes(text) ? "change" : "grave";
  if (kind === "mode" || kind === "damage") return "grave";
  if (kind === "change") return "change";
  return kind === "force" || NOTABLE.test(text) ? "notable" : "usual";
}

/** Marks that are drawn as one. */
export interface MarkColumn {
  /** Number of the column, from the left. */
  at: number;
  /** Number of usual events. */
  usual: number;
  /** The weightiest other mark, and how many of that weight; undefined: none. */
  other: { weight: Weight; mark: Mark; count: number } | undefined;
}

/** The marks within [first, last] in `count` columns of the same width; those without marks are left out. */
export function columnsOf(marks: Mark[], first: number, last: number, count: number): MarkColumn[] {
  const columns = new Map<number, MarkColumn>();
  for (const mark of marks) {
    if (!(mark.time >= first && mark.time <= last)) continue;
    const at = Math.min(count - 1, Math.floor(((mark.time - first) / Math.max(last - first, 1e-9)) * count));
    let column = columns.get(at);
    if (column === undefined) columns.set(at, (column = { at, usual: 0, other: undefined }));
    see(column, mark, weightOf(mark));
  }
  return [...columns.values()].sort((a, b) => a.at - b.at);
}

function see(column: MarkColumn, mark: Mark, weight: Weight): void {
  const { other } = column;
  if (weight === "usual") ++column.usual;
  else if (other?.weight === weight) ++other.count;
  else if (other === undefined || WEIGHTS.indexOf(weight) > WEIGHTS.indexOf(other.weight)) column.other = { weight, mark, count: 1 };
}

/** Hint at the pointer: the weightiest mark near `time`, of these the nearest, and how many more there are. */
export function hintOf(marks: Mark[], time: number, reach: number): string {
  const near = marks.filter((mark) => Math.abs(mark.time - time) < reach);
  near.sort((a, b) => WEIGHTS.indexOf(weightOf(b)) - WEIGHTS.indexOf(weightOf(a)) || Math.abs(a.time - time) - Math.abs(b.time - time));
  const [mark] = near;
  if (mark === undefined) return "";
  const more = near.length > 1 ? `, and ${near.length - 1} more near it` : "";
  if (mark.kind === "damage") return `${mark.text}${more}`; // which says from when to when itself
  return `${secondsText(mark.time)} ${mark.leg === "" ? "" : `${mark.leg} `}${mark.text}${more}`;
}
