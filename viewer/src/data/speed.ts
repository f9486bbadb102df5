import { rateOf, type Status } from "../protocol/connection.ts";

/** A run that is slower than this share of what was asked for is told. */
const SLOW = 0.9;
/** One that is no slower than this share of it goes as was asked for. */
const AS_ASKED = 0.98;
/** More than this times what was asked for is a run that hurries, as while the robot calibrates before somebody looks. */
const HURRIED = 1.2;

/** Text of a speed factor: 1/32× … 8×, and what else may have been asked for. */
export function speedText(factor: number): string {
  const part = Math.round(1 / factor);
  return factor < 1 && Math.abs(part * factor - 1) < 1e-6 ? `1/${part}×` : `${Number(factor.toFixed(3))}×`;
}

/** How fast the run goes, and that it can't go as fast as was asked for. */
export function paceText(status: Pick<Status, "paused" | "ended" | "speed" | "real_factor">): string {
  const rate = rateOf(status);
  if (rate === 0) return "";
  const { speed, real_factor } = status;
  if (real_factor > 0 && real_factor < SLOW * speed)
    return `${Number(real_factor.toPrecision(2))}× of ${Number(speed.toPrecision(3))}× asked: the program's machine is busy`;
  if (real_factor > HURRIED * speed) return `${Number(real_factor.toPrecision(2))}× real time`;
  return `${rate > AS_ASKED * speed ? speedText(speed) : `${Number(rate.toPrecision(2))}×`} real time`;
}
