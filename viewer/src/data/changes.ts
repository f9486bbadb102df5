/** Something that was changed from outside. */
export interface Change {
  time: number;
  text: string;
}

/** What is known, and what was told beside it, in the order of time; the same change twice at one time is two. */
export function withTold(known: Change[], told: Change[]): Change[] {
  const rest = [...known];
  const more = told.filter(({ time, text }) => {
    const at = rest.findIndex((one) => one.time === time && one.text === text);
    if (at >= 0) rest.splice(at, 1);
    return at < 0;
  });
  return [...more, ...known].sort((a, b) => a.time - b.time);
}
