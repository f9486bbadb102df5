/** The last numbers of many. */
export class Recent {
  private readonly numbers: Float64Array;
  private count = 0;

  constructor(most: number) {
    this.numbers = new Float64Array(most);
  }

  add(number: number): void {
    this.numbers[this.count++ % this.numbers.length] = number;
  }

  clear(): void {
    this.count = 0;
  }

  /** In no order. */
  get values(): number[] {
    return [...this.numbers.subarray(0, Math.min(this.count, this.numbers.length))];
  }
}
