/** How long it takes to be there, by how fast the robot has lately been on its way. */
export class Arrival {
  /** [m/s], stops and people in the way included. */
  private pace = 0.4;
  private last: number | null = null;

  /** The robot is on its way at this speed [m/s], at time `now` [s]. */
  see(speed: number, now: number): void {
    const past = this.last === null ? 0 : Math.min(2, Math.max(0, now - this.last));
    this.last = now;
    this.pace += (Math.abs(speed) - this.pace) * Math.min(1, past / 30);
  }
  /** It stands for another reason: that time does not count. */
  rest(): void {
    this.last = null;
  }
  /** [s] for `remaining` [m]: in steps of 5 s, of 15 s from a minute on. */
  seconds(remaining: number): number {
    const exact = remaining / Math.max(0.15, this.pace);
    const step = exact < 60 ? 5 : 15;
    return Math.max(step, Math.round(exact / step) * step);
  }
}
/** "40 s" or "2:15 min". */
export function spoken(seconds: number): string {
  if (seconds < 60) return `${seconds} s`;
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, '0')} min`;
}
