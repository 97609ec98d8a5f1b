import { colourOf, type Expression } from '../face/expression';
import { paintFace } from '../face/paint';
import type { Palette } from './palette';

export interface RobotLook {
  /** Where its body heads [rad], counter-clockwise from the x axis. */
  heading: number;
  /** What its face shows; it looks `pan` to the left of its heading. */
  face: Expression;
  isMoving: boolean;
  /** Whether a wedge says exactly where it heads. */
  hasWedge: boolean;
  time: number;
  still: boolean;
  palette: Palette;
}

const VISOR = '#262038';

type Context = CanvasRenderingContext2D;

/** The ground under it: a shadow, and the wedge. */
function drawGround(context: Context, r: number, look: RobotLook): void {
  context.fillStyle = look.palette.dark ? 'rgba(0,0,0,0.45)' : 'rgba(50,30,60,0.25)';
  context.beginPath();
  context.ellipse(0, r * 0.62, r * 0.95, r * 0.5, 0, 0, 7);
  context.fill();
  if (!look.hasWedge) return;
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
function drawAntenna(context: Context, r: number, { heading, face, time, still, palette }: RobotLook): void {
  const dx = Math.cos(heading);
  const swing = still ? 0 : Math.sin(time * 5) * r * 0.08;
  context.strokeStyle = palette.dark ? '#d9d2f0' : '#4b4463';
  context.lineWidth = Math.max(1.5, r * 0.09);
  context.lineCap = 'round';
  context.beginPath();
  context.moveTo(-dx * r * 0.1, -r * 0.9);
  context.quadraticCurveTo(-dx * r * 0.1, -r * 1.2, swing - dx * r * 0.3, -r * 1.35);
  context.stroke();
  context.fillStyle = face.open > 0 && !still && Math.sin(time * 12) > 0 ? '#ffd166' : '#ff6b4a';
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

/** The visor slides over the ball towards where the head looks; in it the face. */
function drawVisor(context: Context, r: number, { heading, face }: RobotLook): void {
  const dx = Math.cos(heading + face.pan);
  const dy = -Math.sin(heading + face.pan);
  context.save();
  context.beginPath();
  context.arc(0, 0, r * 0.95, 0, 7);
  context.clip();
  const x = dx * r * 0.26;
  const y = dy * r * 0.2 + r * 0.02;
  const wide = r * 0.78 * (1 - 0.08 * Math.abs(dx));
  const tall = r * 0.58;
  context.fillStyle = VISOR;
  context.shadowColor = colourOf(face.valence);
  context.shadowBlur = r * 0.25;
  context.beginPath();
  context.roundRect(x - wide, y - tall, 2 * wide, 2 * tall, tall * 0.9);
  context.fill();
  context.shadowBlur = 0;
  // The head has turned already: in the turned face the eyes look straight on.
  paintFace(context, x + dx * r * 0.08, y + dy * r * 0.05 - r * 0.02, r * 0.0074, { ...face, pan: 0 }, VISOR);
  context.restore();
}

/** The robot: a round little body whose face is where it looks. (x, y) and radius in pixels. */
export function drawRobot(context: Context, x: number, y: number, radius: number, look: RobotLook): void {
  const { time, isMoving, still } = look;
  const hop = still ? 0 : Math.abs(Math.sin(time * (isMoving ? 7 : 2.4))) * radius * 0.07;
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
  drawRobot(context, x, y, radius * (0.75 + 0.25 * Math.min(1, mass)), { ...look, hasWedge: false });
  context.restore();
}
