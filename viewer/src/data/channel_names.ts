import type { ChannelInfo } from "../protocol/session.ts";
import { digits, seen } from "./numbers.ts";
import { hasBodies, LEGS, type Schema } from "./schema.ts";
import type { Series } from "./source.ts";

/** A component's name among those of its channel; "" where it is the only one. */
function componentOf({ size, labels }: Pick<ChannelInfo, "size" | "labels">, index: number): string {
  return size === 1 ? "" : (labels?.[index] ?? String(index));
}

/** The leg that a name speaks of: by its number; undefined: none. */
export function legIn(name: string): number | undefined {
  const leg = LEGS.findIndex((one) => name.split(/[._]/).includes(one));
  return leg < 0 ? undefined : leg;
}

/** Parts of the name of a line: `command.torque` and its second joint are command, torque, LF_HFE. */
export function partsOf({ channel, index }: Series, schema: Schema): string[] {
  const info = schema.channel(channel);
  const component = info === undefined ? "" : componentOf(info, index);
  return [...channel.split("."), ...(component === "" ? [] : [component])];
}

/** What lines have in common, and what tells them apart. */
export function namesOf(series: Series[], schema: Schema): { title: string; labels: string[] } {
  const all = series.map((one) => partsOf(one, schema));
  const [first = []] = all;
  if (all.length === 1) return { title: first.join("."), labels: [""] };
  const shortest = Math.min(...all.map((parts) => parts.length));
  let begin = 0;
  while (begin < shortest - 1 && all.every((parts) => parts[begin] === first[begin])) ++begin;
  let end = 0;
  while (end < shortest - begin - 1 && all.every((parts) => parts.at(-1 - end) === first.at(-1 - end))) ++end;
  const common = [...first.slice(0, begin), ...first.slice(first.length - end)];
  return {
    title: common.length === 0 ? "several channels" : common.join("."),
    labels: all.map((parts) => parts.slice(begin, parts.length - end).join(".")),
  };
}

/** The unit of all lines; undefined where they have several. */
export function unitOf(series: Series[], schema: Schema): string | undefined {
  const units = new Set(series.map(({ channel }) => schema.channel(channel)?.unit ?? ""));
  return units.size === 1 ? [...units][0] : undefined;
}

/** The words that the numbers of all lines stand for; undefined where they are numbers, or words of several lists. */
export function wordsOf(series: Series[], schema: Schema): string[] | undefined {
  const lists = series.map(({ channel }) => schema.channel(channel)?.values);
  const [first] = lists;
  return first !== undefined && lists.every((one) => one?.join("\n") === first.join("\n")) ? first : undefined;
}

/** A number of a line as people read it: its word, where it stands for one. */
export function valueText({ channel }: Series, value: number, schema: Schema): string {
  const info = schema.channel(channel);
  return info?.values?.[value] ?? digits(seen(value, info?.unit ?? ""));
}

/** Some lines that can be chosen together, as a user calls them. */
export interface Choice {
  name: string;
  series: Series[];
}

/** Of what pushes from outside: the force on each body, before the torques. */
function pushChoices({ name }: ChannelInfo, { bodies }: Schema): Choice[] {
  const part = (what: string, begin: number): Choice[] =>
    bodies.map((body, k) => ({ name: `${what} on ${body}`, series: [0, 1, 2].map((i) => ({ channel: name, index: 6 * (k + 1) + begin + i })) }));
  return [...part("force", 0), ...part("torque", 3)];
}

/** What can be plotted of a channel beside all of it: single components, and where a name has to do with legs, what goes together. */
export function choicesOf(channel: ChannelInfo, schema: Schema): Choice[] {
  const { name, size } = channel;
  if (hasBodies(channel, schema)) return pushChoices(channel, schema);
  const components = Array.from({ length: size }, (_, index) => ({ component: componentOf(channel, index), series: { channel: name, index } }));
  const single: Choice[] = size === 1 ? [] : components.map(({ component, series }) => ({ name: component, series: [series] }));
  const legs: Choice[] = LEGS.map((leg, k) => ({ name: `${leg} whole`, series: components.filter(({ component }) => legIn(component) === k).map(({ series }) => series) }));
  return [...single, ...legs.filter(({ series }) => series.length > 1), ...overLegs(channel, schema)];
}

/** Of a channel that each leg has: the same of all legs. */
function overLegs(channel: ChannelInfo, schema: Schema): Choice[] {
  const leg = legIn(channel.name);
  if (leg === undefined) return [];
  const names = LEGS.map((one) => channel.name.split(".").map((part) => (part === LEGS[leg] ? one : part)).join("."));
  if (names.some((name) => schema.offset(name) < 0)) return [];
  return Array.from({ length: channel.size }, (_, index) => ({
    name: `${componentOf(channel, index)} of all legs`.trim(),
    series: names.map((name) => ({ channel: name, index })),
  }));
}
