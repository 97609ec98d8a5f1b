import type { LiveMessage, Pose } from './protocol';

/** Shown so much later than it happened [s], so that there is nearly always a newer value to move towards; */
const DELAY = 0.18;
/** more where values come more seldom: so many times what lies between two of them, */
const SPACES = 1.3;
/** but never more. */
const MOST_DELAY = 0.6;

function blendAngle(a: number, b: number, part: number): number {
  const turn = Math.atan2(Math.sin(b - a), Math.cos(b - a));
  return a + turn * part;
}

export interface ShownPerson {
  id: number;
  x: number;
  y: number;
  vx: number;
  vy: number;
}

/** The last frames, and what lies between them: motion at the pace of the screen. */
export class Motion {
  private frames: LiveMessage[] = [];
  private delay = DELAY;

  add(frame: LiveMessage): void {
    const last = this.frames[this.frames.length - 1];
    const wanted = last ? Math.min(MOST_DELAY, Math.max(DELAY, SPACES * (frame.t - last.t))) : DELAY;
    this.delay += 0.2 * (wanted - this.delay);
    if (last && (frame.t <= last.t || frame.t - last.t > 5)) this.frames = [];
    this.frames.push(frame);
    if (this.frames.length > 30) this.frames.shift();
  }
  get latest(): LiveMessage | undefined {
    return this.frames[this.frames.length - 1];
  }
  private around(now: number): [LiveMessage, LiveMessage, number] | null {
    if (this.frames.length === 0) return null;
    const t = now - this.delay;
    for (let i = this.frames.length - 1; i >= 0; --i) {
      const a = this.frames[i];
      if (a.t > t) continue;
      const b = this.frames[i + 1];
      if (!b) return [a, a, 0];
      return [a, b, Math.min(1, (t - a.t) / Math.max(1e-3, b.t - a.t))];
    }
    return [this.frames[0], this.frames[0], 0];
  }
  /** Where to draw the robot; null while it does not know. */
  pose(now: number): Pose | null {
    const found = this.around(now);
    if (!found) return null;
    const [a, b, part] = found;
    if (!a.pose || !b.pose) return b.pose ?? this.latest?.pose ?? null;
    // A jump is a change of mind, not a motion: it is not smeared.
    if (Math.hypot(b.pose[0] - a.pose[0], b.pose[1] - a.pose[1]) > 1) return b.pose;
    return [
      a.pose[0] + (b.pose[0] - a.pose[0]) * part,
      a.pose[1] + (b.pose[1] - a.pose[1]) * part,
      blendAngle(a.pose[2], b.pose[2], part),
    ];
  }
  people(now: number): ShownPerson[] {
    const found = this.around(now);
    if (!found) return [];
    const [a, b, part] = found;
    const before = new Map(a.people.map((person) => [person[0], person]));
    return b.people.map(([id, x, y, vx, vy]) => {
      const old = before.get(id);
      if (!old || Math.hypot(x - old[1], y - old[2]) > 1.5) return { id, x, y, vx, vy };
      return { id, x: old[1] + (x - old[1]) * part, y: old[2] + (y - old[2]) * part, vx, vy };
    });
  }
}
