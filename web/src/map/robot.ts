import type { Palette } from './palette';

export type Mood = 'calm' | 'driving' | 'talking' | 'lost' | 'waiting' | 'happy' | 'asleep';

export interface RobotLook {
  /** Direction it looks [rad], counter-clockwise from the x axis. */
  heading: number;
  mood: Mood;
  time: number;
  still: boolean;
  palette: Palette;
}

const glow: Record<Mood, string> = {
  calm: '#7ef0e0',
  driving: '#7ef0e0',
  talking: '#8dffb0',
  lost: '#c9a8ff',
  waiting: '#ffc95c',
  happy: '#ffe27a',
  asleep: '#6f8f9c',
};

type Context = CanvasRenderingContext2D;

/** The ground under it: a shadow, and a wedge that says exactly where it heads. */
function drawGround(context: Context, r: number, look: RobotLook): void {
  context.fillStyle = look.palette.dark ? 'rgba(0,0,0,0.45)' : 'rgba(50,30,60,0.25)';
  context.beginPath();
  context.ellipse(0, r * 0.62, r * 0.95, r * 0.5, 0, 0, 7);
  context.fill();
  if (look.mood === 'lost') return;
  context.save();
  context.rotate(-look.heading);
  context.fillStyle = look.palette.path;
  context.beginPath();
  context.moveTo(r * 1.5, 0);
  context.lineTo(r * 1.12, r * 0.3);
  context.quadraticCurveTo(r * 1.22, 0, r * 1.12, -r * 0.3);
  context.closePath();
  context.fill();
  context.restore();
}

/** The antenna, swinging against the motion. */
function drawAntenna(context: Context, r: number, { heading, mood, time, still, palette }: RobotLook): void {
  const dx = Math.cos(heading);
  const swing = still ? 0 : Math.sin(time * 5) * r * 0.08;
  context.strokeStyle = palette.dark ? '#d9d2f0' : '#4b4463';
  context.lineWidth = Math.max(1.5, r * 0.09);
  context.lineCap = 'round';
  context.beginPath();
  context.moveTo(-dx * r * 0.1, -r * 0.9);
  context.quadraticCurveTo(-dx * r * 0.1, -r * 1.2, swing - dx * r * 0.3, -r * 1.35);
  context.stroke();
  context.fillStyle = mood === 'talking' && !still ? (Math.sin(time * 12) > 0 ? '#ffd166' : '#ff6b4a') : '#ff6b4a';
  context.beginPath();
  context.arc(swing - dx * r * 0.3, -r * 1.38, r * 0.16, 0, 7);
  context.fill();
}

function drawBody(context: Context, r: number, palette: Palette): void {
  const body = context.createRadialGradient(-r * 0.35, -r * 0.45, r * 0.1, 0, 0, r * 1.05);
  body.addColorStop(0, '#ffffff');
  body.addColorStop(0.6, '#fff3e4');
  body.addColorStop(1, '#e9cfb4');
  context.fillStyle = body;
  context.beginPath();
  context.arc(0, 0, r, 0, 7);
  context.fill();
  context.strokeStyle = palette.dark ? '#0c0a16' : '#3b3452';
  context.lineWidth = Math.max(1.5, r * 0.08);
  context.stroke();
}

/** The visor slides over the ball towards where it looks; in it the face. */
function drawVisor(context: Context, r: number, look: RobotLook): void {
  const dx = Math.cos(look.heading);
  const dy = -Math.sin(look.heading);
  context.save();
  context.beginPath();
  context.arc(0, 0, r * 0.95, 0, 7);
  context.clip();
  const vx = dx * r * 0.3;
  const vy = dy * r * 0.26 + r * 0.02;
  const vw = r * 0.72 * (1 - 0.1 * Math.abs(dx));
  const vh = r * 0.42;
  context.fillStyle = '#262038';
  context.beginPath();
  context.roundRect(vx - vw, vy - vh, 2 * vw, 2 * vh, vh * 0.95);
  context.fill();
  context.fillStyle = 'rgba(255,255,255,0.10)';
  context.beginPath();
  context.ellipse(vx - vw * 0.45, vy - vh * 0.5, vw * 0.35, vh * 0.22, -0.4, 0, 7);
  context.fill();
  const wander = look.mood === 'lost' && !look.still ? Math.sin(look.time * 1.7) : 0;
  const ex = vx + dx * r * 0.12 + wander * r * 0.16;
  const ey = vy + dy * r * 0.06 - r * 0.03;
  drawEyes(context, ex, ey, r, look);
  drawMouth(context, ex, ey + r * 0.2, r, look);
  context.restore();
}

/** (x, y): between the eyes. */
function drawEyes(context: Context, x: number, y: number, r: number, { mood, time, still }: RobotLook): void {
  const blink = !still && (time % 4.3 < 0.13 || (time + 1.7) % 7.1 < 0.11);
  context.fillStyle = glow[mood];
  context.strokeStyle = glow[mood];
  context.shadowColor = glow[mood];
  context.shadowBlur = r * 0.3;
  context.lineWidth = r * 0.09;
  for (const side of [-1, 1]) {
    const cx = x + side * r * 0.27;
    context.beginPath();
    if (blink || mood === 'asleep') {
      context.moveTo(cx - r * 0.1, y);
      context.lineTo(cx + r * 0.1, y);
      context.stroke();
    } else if (mood === 'happy') {
      context.arc(cx, y + r * 0.06, r * 0.12, Math.PI * 1.1, Math.PI * 1.9);
      context.stroke();
    } else {
      const size = mood === 'lost' ? (side < 0 ? 0.15 : 0.11) : 0.13;
      context.ellipse(cx, y, r * size * 0.85, r * size * (mood === 'waiting' ? 0.75 : 1.1), 0, 0, 7);
      context.fill();
    }
  }
}

/** It glows as the eyes do. */
function drawMouth(context: Context, x: number, y: number, r: number, { mood, time, still }: RobotLook): void {
  context.lineWidth = r * 0.06;
  context.beginPath();
  if (mood === 'talking') {
    const open = still ? 0.06 : 0.03 + 0.07 * Math.abs(Math.sin(time * 9) * Math.sin(time * 5.3 + 1));
    context.ellipse(x, y + r * 0.02, r * 0.11, r * open, 0, 0, 7);
    context.fill();
  } else if (mood === 'lost' || mood === 'waiting') {
    context.moveTo(x - r * 0.08, y + r * 0.02);
    context.lineTo(x + r * 0.08, y + (mood === 'lost' ? -r * 0.02 : r * 0.02));
    context.stroke();
  } else if (mood !== 'asleep') {
    context.arc(x, y - r * 0.08, r * 0.13, Math.PI * 0.2, Math.PI * 0.8);
    context.stroke();
  }
}

/** The robot: a round little body whose face is where it looks. (x, y) and radius in pixels. */
export function drawRobot(context: Context, x: number, y: number, radius: number, look: RobotLook): void {
  const { time, mood, still } = look;
  const stays = still || mood === 'lost' || mood === 'asleep';
  const hop = stays ? 0 : Math.abs(Math.sin(time * (mood === 'driving' ? 7 : 2.4))) * radius * 0.07;
  context.save();
  context.translate(x, y);
  drawGround(context, radius, look);
  context.translate(0, -hop);
  drawAntenna(context, radius, look);
  drawBody(context, radius, look.palette);
  drawVisor(context, radius, look);
  context.restore();
}

/** A place where the robot may be: a pale copy of it. */
export function drawGhost(context: Context, x: number, y: number, radius: number, mass: number, look: RobotLook): void {
  context.save();
  context.globalAlpha = 0.2 + 0.6 * Math.min(1, mass);
  drawRobot(context, x, y, radius * (0.75 + 0.25 * Math.min(1, mass)), { ...look, mood: 'lost' });
  context.restore();
}
