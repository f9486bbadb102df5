declare module "*.html" {
  const text: string;
  export default text;
}

/** A source of the program, as text: what the page repeats of it is held against it. */
declare module "*.cpp" {
  const text: string;
  export default text;
}

declare module "*.hpp" {
  const text: string;
  export default text;
}
