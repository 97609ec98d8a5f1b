import type { LiveMessage } from '../lib/protocol';
import type { Camera } from './camera';
import type { Palette } from './palette';

const RAYS = 180;
const REACH = 9;

/** What the lasers see, as the light of a lantern: rays in the map's frame, smoothed a little from scan to scan. */
export class Light {
  private ranges = new Float32Array(RAYS).fill(0);
  private shown: LiveMessage | null = null;
  private strength = 0;

  update(frame: LiveMessage | undefined): void {
    if (!frame || frame === this.shown) return;
    this.shown = frame;
    const points = frame.scan.points;
    const isUsable = frame.scan.frame === 'map' && points.length > 20;
    this.strength += ((isUsable ? 1 : 0) - this.strength) * 0.25;
    if (!isUsable) return;
    const fresh = new Float32Array(RAYS).fill(-1);
    const [ox, oy] = frame.scan.from;
    for (let i = 0; i < points.length; i += 2) {
      const dx = points[i] / 100 - ox;
      const dy = points[i + 1] / 100 - oy;
      const ray = Math.floor(((Math.atan2(dy, dx) / (2 * Math.PI) + 1) % 1) * RAYS) % RAYS;
      const range = Math.hypot(dx, dy);
      fresh[ray] = fresh[ray] < 0 ? range : Math.min(fresh[ray], range);
    }
    // A ray between two readings takes the nearer one.
    for (let i = 0; i < RAYS; ++i) {
      if (fresh[i] >= 0) continue;
      for (let reach = 1; reach < 4 && fresh[i] < 0; ++reach) {
        const a = fresh[(i + reach) % RAYS];
        const b = fresh[(i + RAYS - reach) % RAYS];
        fresh[i] = a >= 0 && b >= 0 ? Math.min(a, b) : Math.max(a, b);
      }
      if (fresh[i] < 0) fresh[i] = 0;
    }
    for (let i = 0; i < RAYS; ++i) this.ranges[i] += (fresh[i] - this.ranges[i]) * 0.55;
  }

  draw(context: CanvasRenderingContext2D, camera: Camera, x: number, y: number, palette: Palette): void {
    if (this.strength < 0.02) return;
    const px = camera.px(x);
    const py = camera.py(y);
    const [r, g, b] = palette.light;
    const reach = REACH * camera.scale;
    const glow = context.createRadialGradient(px, py, 0, px, py, reach);
    const alpha = palette.lightStrength * this.strength;
    glow.addColorStop(0, `rgba(${r}, ${g}, ${b}, ${alpha})`);
    glow.addColorStop(0.35, `rgba(${r}, ${g}, ${b}, ${alpha * 0.5})`);
    glow.addColorStop(1, `rgba(${r}, ${g}, ${b}, 0)`);
    context.fillStyle = glow;
    context.beginPath();
    for (let i = 0; i < RAYS; ++i) {
      const angle = ((i + 0.5) / RAYS) * 2 * Math.PI;
      const range = Math.min(REACH, this.ranges[i]) * camera.scale;
      context.lineTo(px + Math.cos(angle) * range, py - Math.sin(angle) * range);
    }
    context.closePath();
    context.fill();
    context.fillStyle = `rgba(${r}, ${g * 0.8}, ${b * 0.6}, ${0.55 * this.strength})`;
    for (let i = 0; i < RAYS; ++i) {
      if (this.ranges[i] <= 0.05 || this.ranges[i] > REACH) continue;
      const angle = ((i + 0.5) / RAYS) * 2 * Math.PI;
      const range = this.ranges[i] * camera.scale;
      context.fillRect(px + Math.cos(angle) * range - 1, py - Math.sin(angle) * range - 1, 2, 2);
    }
  }
}
