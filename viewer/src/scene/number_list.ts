const ZERO = 48;
const NINE = 57;
const DOT = 46;
const MINUS = 45;
/** Powers of ten that a double holds exactly. */
const POWERS = Array.from({ length: 23 }, (_, k) => 10 ** k);
/** As many digits are exact in a double. */
const EXACT = 15;

/** The numbers of a text that has spaces between them, as `parseFloat` reads each; without a text for each of them. */
export function numbersOf(text: string): number[] {
  const numbers: number[] = [];
  for (let at = skip(text, 0); at < text.length; ) {
    const end = endOf(text, at);
    numbers.push(numberIn(text, at, end));
    at = skip(text, end);
  }
  return numbers;
}

/** Of a plain decimal with few digits the mantissa over a power of ten, which is rounded once, as it must be; of others `parseFloat`. */
function numberIn(text: string, begin: number, end: number): number {
  const negative = text.charCodeAt(begin) === MINUS;
  let mantissa = 0;
  let digits = 0;
  let decimals = -1;
  for (let at = begin + (negative ? 1 : 0); at < end; ++at) {
    const code = text.charCodeAt(at);
    if (code >= ZERO && code <= NINE) {
      mantissa = 10 * mantissa + code - ZERO;
      ++digits;
      if (decimals >= 0) ++decimals;
    } else if (code === DOT && decimals < 0) decimals = 0;
    else return parseFloat(text.slice(begin, end));
  }
  if (digits === 0 || digits > EXACT) return parseFloat(text.slice(begin, end));
  const value = decimals > 0 ? mantissa / (POWERS[decimals] as number) : mantissa;
  return negative ? -value : value;
}

function skip(text: string, at: number): number {
  while (at < text.length && text.charCodeAt(at) <= 32) ++at;
  return at;
}

function endOf(text: string, at: number): number {
  while (at < text.length && text.charCodeAt(at) > 32) ++at;
  return at;
}
