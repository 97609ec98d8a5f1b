import type { ShownPerson } from '../lib/motion';
import type { Palette } from './palette';

/** A person from above: shoulders, head, and a swinging step. Size in pixels of half a shoulder. */
export function drawPerson(
  context: CanvasRenderingContext2D,
  x: number,
  y: number,
  size: number,
  person: ShownPerson,
  time: number,
  still: boolean,
  palette: Palette,
): void {
  const speed = Math.hypot(person.vx, person.vy);
  const heading = speed > 0.08 ? Math.atan2(-person.vy, person.vx) : ((person.id * 2.4) % 6.28);
  const color = palette.people[person.id % palette.people.length];
  const phase = time * 7 + person.id;
  const step = still || speed < 0.08 ? 0 : Math.sin(phase) * size * 0.5;
  context.save();
  context.translate(x, y);
  context.fillStyle = palette.dark ? 'rgba(0,0,0,0.4)' : 'rgba(50,30,60,0.2)';
  context.beginPath();
  context.ellipse(size * 0.15, size * 0.45, size * 1.05, size * 0.75, 0, 0, 7);
  context.fill();
  context.rotate(heading);
  context.fillStyle = palette.dark ? '#191527' : '#4a4260';
  context.beginPath();
  context.ellipse(step, -size * 0.4, size * 0.42, size * 0.24, 0, 0, 7);
  context.ellipse(-step, size * 0.4, size * 0.42, size * 0.24, 0, 0, 7);
  context.fill();
  context.fillStyle = color;
  context.beginPath();
  context.ellipse(0, 0, size * 0.55, size, 0, 0, 7);
  context.fill();
  context.fillStyle = ['#f3cda5', '#d9a071', '#9c6a44', '#f6dcc0', '#b98253'][person.id % 5];
  context.beginPath();
  context.arc(size * 0.06, 0, size * 0.46, 0, 7);
  context.fill();
  context.fillStyle = ['#4a3423', '#2a211d', '#8a5a2b', '#c9a45c', '#6b6470'][(person.id * 7) % 5];
  context.beginPath();
  context.arc(0, 0, size * 0.46, Math.PI * 0.42, Math.PI * 1.58);
  context.fill();
  context.restore();
}
