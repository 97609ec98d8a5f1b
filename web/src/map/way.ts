import type { PathMessage, Pose } from '../lib/protocol';
import type { Camera } from './camera';

/** The way still before the robot as running dots, and a ring where it ends. `time` [s]: how far the dots have run. */
export function drawWay(context: CanvasRenderingContext2D, camera: Camera, path: PathMessage | null, pose: Pose, color: string, time: number): void {
  if (!path || path.points.length < 4) return;
  if (!['driving', 'turning', 'blocked'].includes(path.state)) return;
  // What already lies behind the robot is not drawn.
  let start = 0;
  let best = Infinity;
  for (let i = 0; i < path.points.length; i += 2) {
    const d = Math.hypot(path.points[i] - pose[0], path.points[i + 1] - pose[1]);
    if (d < best) [best, start] = [d, i];
  }
  context.save();
  context.lineCap = 'round';
  context.lineJoin = 'round';
  context.strokeStyle = color;
  context.globalAlpha = 0.85;
  context.lineWidth = Math.max(2.5, camera.scale * 0.11);
  context.setLineDash([0.1, context.lineWidth * 2.6]);
  context.lineDashOffset = -time * 26;
  context.beginPath();
  for (let i = start; i < path.points.length; i += 2) {
    context.lineTo(camera.px(path.points[i]), camera.py(path.points[i + 1]));
  }
  context.stroke();
  context.setLineDash([]);
  const gx = camera.px(path.points[path.points.length - 2]);
  const gy = camera.py(path.points[path.points.length - 1]);
  context.lineWidth = 2.5;
  context.beginPath();
  context.arc(gx, gy, 9 * (1 + 0.18 * Math.sin(time * 4)), 0, 7);
  context.stroke();
  context.restore();
}
