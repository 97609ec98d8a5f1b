/**
 * The robot's clock, seen from here. Messages arrive late, never early, so the smallest difference seen is nearest to
 * the truth; it may creep up slowly, because clocks drift and simulated time need not run at our pace.
 */
export class RobotClock {
  private offset: number | null = null;

  /** `t`: the robot's time [s] in a message that has just come. */
  see(t: number, local = performance.now() / 1000): void {
    const sample = local - t;
    if (this.offset === null || Math.abs(sample - this.offset) > 2) this.offset = sample;
    else if (sample < this.offset) this.offset = sample;
    else this.offset += (sample - this.offset) * 0.02;
  }
  /** The robot's time [s] now. */
  now(local = performance.now() / 1000): number {
    return this.offset === null ? 0 : local - this.offset;
  }
}
