/** The names with one of them `steps` further down; undefined where it can't go there. */
export function moved(names: string[], name: string, steps: number): string[] | undefined {
  const from = names.indexOf(name);
  const to = from + steps;
  if (from < 0 || steps === 0 || to < 0 || to >= names.length) return undefined;
  const order = names.toSpliced(from, 1);
  order.splice(to, 0, name);
  return order;
}
