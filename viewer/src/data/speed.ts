import { rateOf, type Status } from "../protocol/connection.ts";

/** A run below this share of the requested speed counts as slow. */
const SLOW = 0.9;
/** A run above this share has the requested speed. */
const AS_ASKED = 0.98;
/** A run above this share hurries, as in a calibration before a page is open. */
const HURRIED = 1.2;

/** Text of a speed factor: 1/32× … 8×, or any other. */
export function speedText(factor: number): string {
  const part = Math.round(1 / factor);
  return factor < 1 && Math.abs(part * factor - 1) < 1e-6 ? `1/${part}×` : `${Number(factor.toFixed(3))}×`;
}

/** Speed of the run, and whether it is below the requested speed. */
export function paceText(status: Pick<Status, "paused" | "ended" | "speed" | "real_factor">): string {
  const rate = rateOf(status);
  if (rate === 0) return "";
  const { speed, real_factor } = status;
  if (real_factor > 0 && real_factor < SLOW * speed)
    return `${Number(real_factor.toPrecision(2))}× of ${Number(speed.toPrecision(3))}× asked: the program's machine is busy`;
  if (real_factor > HURRIED * speed) return `${Number(real_factor.toPrecision(2))}× real time`;
  return `${rate > AS_ASKED * speed ? speedText(speed) : `${Number(rate.toPrecision(2))}×`} real time`;
}
