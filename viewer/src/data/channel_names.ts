import type { ChannelInfo } from "../protocol/session.ts";
import { digits, seen } from "./numbers.ts";
import { hasBodies, type Schema } from "./schema.ts";
import type { Series } from "./source.ts";

/** Name of a component; "": it is the only one. */
function componentOf({ size, labels }: Pick<ChannelInfo, "size" | "labels">, index: number): string {
  return size === 1 ? "" : (labels?.[index] ?? String(index));
}

/** Number of the leg in a name; undefined: none. */
export function legIn(name: string, { legs }: Schema): number | undefined {
  const leg = legs.findIndex((one) => name.split(/[._]/).includes(one.name));
  return leg < 0 ? undefined : leg;
}

/** Parts of a line's name: command, torque, LF_HFE. */
export function partsOf({ channel, index }: Series, schema: Schema): string[] {
  const info = schema.channel(channel);
  const component = info === undefined ? "" : componentOf(info, index);
  return [...channel.split("."), ...(component === "" ? [] : [component])];
}

/** The common part of the names of lines, and the rest of each. */
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

/** The unit of all lines; undefined: they differ. */
export function unitOf(series: Series[], schema: Schema): string | undefined {
  const units = new Set(series.map(({ channel }) => schema.channel(channel)?.unit ?? ""));
  return units.size === 1 ? [...units][0] : undefined;
}

/** The words that the numbers of all lines stand for; undefined: quantities, or different words. */
export function wordsOf(series: Series[], schema: Schema): string[] | undefined {
  const lists = series.map(({ channel }) => schema.channel(channel)?.values);
  const [first] = lists;
  return first !== undefined && lists.every((one) => one?.join("\n") === first.join("\n")) ? first : undefined;
}

/** A number of a line as text, or its word. */
export function valueText({ channel }: Series, value: number, schema: Schema): string {
  const info = schema.channel(channel);
  return info?.values?.[value] ?? digits(seen(value, info?.unit ?? ""));
}

/** Lines that can be chosen together, with a name. */
export interface Choice {
  name: string;
  series: Series[];
}

/** Choices of outside forces: the force on each body, then the torques. */
function pushChoices({ name }: ChannelInfo, { bodies }: Schema): Choice[] {
  const part = (what: string, begin: number): Choice[] =>
    bodies.map((body, k) => ({ name: `${what} on ${body}`, series: [0, 1, 2].map((i) => ({ channel: name, index: 6 * (k + 1) + begin + i })) }));
  return [...part("force", 0), ...part("torque", 3)];
}

/** Parts of a channel that can be plotted: single components, and groups by leg. */
export function choicesOf(channel: ChannelInfo, schema: Schema): Choice[] {
  const { name, size } = channel;
  if (hasBodies(channel, schema)) return pushChoices(channel, schema);
  const components = Array.from({ length: size }, (_, index) => ({ component: componentOf(channel, index), series: { channel: name, index } }));
  const single: Choice[] = size === 1 ? [] : components.map(({ component, series }) => ({ name: component, series: [series] }));
  const legs: Choice[] = schema.legs.map((leg, k) => ({ name: `${leg.name} whole`, series: components.filter(({ component }) => legIn(component, schema) === k).map(({ series }) => series) }));
  return [...single, ...legs.filter(({ series }) => series.length > 1), ...overLegs(channel, schema)];
}

/** The same component of all legs, for a channel that each leg has. */
function overLegs(channel: ChannelInfo, schema: Schema): Choice[] {
  const leg = legIn(channel.name, schema);
  if (leg === undefined) return [];
  const names = schema.legs.map((one) => channel.name.split(".").map((part) => (part === schema.legs[leg]?.name ? one.name : part)).join("."));
  if (names.some((name) => schema.offset(name) < 0)) return [];
  return Array.from({ length: channel.size }, (_, index) => ({
    name: `${componentOf(channel, index)} of all legs`.trim(),
    series: names.map((name) => ({ channel: name, index })),
  }));
}
