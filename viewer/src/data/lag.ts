import { rateOf, type Status } from "../protocol/connection.ts";

/** A run that is slower than this share of what was asked for is told. */
const SLOW = 0.9;
/** One that is no slower than this share of it goes as was asked for. */
const AS_ASKED = 0.98;
/** A picture that is younger than this is told as now [s]. */
const YOUNG = 0.35;
/** After so long without word the program's machine may have slept, and its clock with it [s]. */
const SILENCE = 3;
/** Over how long ages are averaged, in numbers of them. */
const MEMORY = 5;

type Told = Pick<Status, "clock" | "time" | "paused" | "ended" | "speed" | "real_factor">;
/** More than this times what was asked for is a run that hurries, as while the robot calibrates before somebody looks. */
const HURRIED = 1.2;

/** Text of a speed factor: 1/32× … 8×, and what else may have been asked for. */
export function speedText(factor: number): string {
  const part = Math.round(1 / factor);
  return factor < 1 && Math.abs(part * factor - 1) < 1e-6 ? `1/${part}×` : `${Number(factor.toFixed(3))}×`;
}

/** How fast the run goes, and that it can't go as fast as was asked for. */
export function paceText(status: Told): string {
  const rate = rateOf(status);
  if (rate === 0) return "";
  const { speed, real_factor } = status;
  if (real_factor > 0 && real_factor < SLOW * speed)
    return `${Number(real_factor.toPrecision(2))}× of ${Number(speed.toPrecision(3))}× asked: the program's machine is busy`;
  if (real_factor > HURRIED * speed) return `${Number(real_factor.toPrecision(2))}× real time`;
  return `${rate > AS_ASKED * speed ? speedText(speed) : `${Number(rate.toPrecision(2))}×`} real time`;
}

/** How long ago the run was as the picture shows it, by the program's clock. */
export class PictureAge {
  private status: Told | undefined;
  private heard = -Infinity;
  /** By how much this page's clock is ahead of the program's; what comes late seems to say more [s]. */
  private ahead = Infinity;
  private mean = 0;

  /** `now`: by the page's clock [s]. */
  hear(status: Told, now: number): void {
    if (now - this.heard > SILENCE) this.forget();
    this.heard = now;
    this.status = status;
    this.ahead = Math.min(this.ahead, now - status.clock);
  }

  /** The program may be another one now. */
  forget(): void {
    this.status = undefined;
    this.ahead = Infinity;
    this.mean = 0;
  }

  /** Of a picture of the run at `time`; 0 while the run stands, or how fast it goes is not known [s]. */
  of(time: number, now: number): number {
    const { status } = this;
    if (status === undefined || !(status.real_factor > 0)) return 0;
    const rate = rateOf(status);
    if (rate === 0) return 0;
    return Math.max(0, now - this.ahead - status.clock + (status.time - time) / rate);
  }

  /** What is said of it, asked ten times a second; "" of one that is young. */
  text(time: number, now: number): string {
    this.mean += (this.of(time, now) - this.mean) / MEMORY;
    return this.mean < YOUNG ? "" : `the picture is ${this.mean.toFixed(1)} s old`;
  }
}
