// The face as curves: brows, eyes, lids and mouth for every mood between angry and happy. Pure, so that it can be tested.
// Units: the face is 200 wide and 160 high, its middle at (0, 0), y downwards.

export interface Expression {
  /** -1 (angry) .. 1 (happy) */
  valence: number;
  /** 0 .. 1: brows that go up in the middle */
  sad: number;
  /** 0 .. 1: how far the mouth is open */
  open: number;
  /** 0 .. 1: how far the lids are shut */
  shut: number;
  /** Where it looks [rad]: to the robot's left, upwards. */
  pan: number;
  tilt: number;
}

export interface Eye {
  x: number;
  y: number;
  pupil: [number, number];
  brow: string;
  /** What covers the eye from above and from below. */
  upperLid: string;
  lowerLid: string;
}
export interface Face {
  eyes: [Eye, Eye];
  mouth: string;
  cheeks: number;
  colour: string;
}

export const EYE = { rx: 25, ry: 29, pupil: 12 };
const blend = (a: number, b: number, part: number) => a + (b - a) * part;
const clamp = (value: number, most: number) => Math.max(-most, Math.min(most, value));
const at = (x: number, y: number) => `${x.toFixed(2)} ${y.toFixed(2)}`;

/** From red when angry to yellow when happy, by way of colours that are none of them grey. */
const COLOURS = [[255, 110, 80], [255, 196, 140], [126, 240, 224], [186, 240, 130], [255, 214, 92]];
export function colourOf(valence: number): string {
  const place = (clamp(valence, 1) + 1) * 2;
  const i = Math.min(3, Math.floor(place));
  return `rgb(${COLOURS[i].map((part, k) => Math.round(blend(part, COLOURS[i + 1][k], place - i))).join(' ')})`;
}

/** `side`: -1 for the eye on the left of the screen, 1 for the other. */
function eyeOf(side: number, e: Expression): Eye {
  const happy = Math.max(0, e.valence);
  const angry = Math.max(0, -e.valence);
  const x = side * 44;
  const y = -16;
  const outer = x + side * 30;
  const inner = x - side * 26;
  // An angry brow falls towards the nose, a sad one rises; a happy one is a high arch.
  const innerY = y - 40 + 22 * angry - 8 * happy - 16 * e.sad;
  const outerY = y - 38 - 12 * angry - 3 * happy + 12 * e.sad;
  const arch = 8 + 12 * happy - 8 * angry - 6 * e.sad;
  const brow = `M${at(outer, outerY)} Q${at(x, (innerY + outerY) / 2 - arch)} ${at(inner, innerY)}`;
  // The lids: a line over the eye, which an angry face lowers towards the nose, and a bow below it, which a smile lifts.
  const top = y - EYE.ry - 5;
  const bottom = y + EYE.ry + 5;
  const closed = y + 13;
  const lidOuter = blend(top + 10 * angry + 15 * e.sad, closed, e.shut);
  const lidInner = blend(top + 33 * angry, closed, e.shut);
  const upperLid = `M${at(outer + side * 9, top - 12)} L${at(inner - side * 9, top - 12)} L${at(inner - side * 9, lidInner)} L${at(outer + side * 9, lidOuter)} Z`;
  const raised = blend(bottom - 20 * happy - 8 * angry, closed, e.shut);
  const lowerLid = `M${at(x - 36, bottom + 12)} L${at(x - 36, raised + 8 * happy)} Q${at(x, raised - 9 * happy)} ${at(x + 36, raised + 8 * happy)} L${at(x + 36, bottom + 12)} Z`;
  // It faces us: its left is our right.
  const pupil: [number, number] = [x + 17 * Math.sin(clamp(e.pan, 1.2)), y - 17 * Math.sin(clamp(e.tilt, 0.8)) + 3 * happy];
  return { x, y, pupil, brow, upperLid, lowerLid };
}

function mouthOf(e: Expression): string {
  const happy = Math.max(0, e.valence);
  const angry = Math.max(0, -e.valence);
  const half = 34 + 13 * happy + 2 * angry;
  const middle = 46 + 4 * angry;
  const corner = middle - 13 * happy + 12 * angry + 5 * e.sad;
  const bow = 24 * happy - 26 * angry - 10 * e.sad;
  // A broad smile is open a little; a mouth that speaks opens downwards.
  const gap = 24 * Math.max(0, e.valence - 0.35) + 26 * e.open;
  const upper = middle + bow - gap * 0.35;
  const lower = middle + bow + gap * 1.5;
  return `M${at(-half, corner)} Q${at(0, upper)} ${at(half, corner)} Q${at(0, lower)} ${at(-half, corner)} Z`;
}

export function faceOf(e: Expression): Face {
  return {
    eyes: [eyeOf(-1, e), eyeOf(1, e)],
    mouth: mouthOf(e),
    cheeks: Math.max(0, e.valence) * 0.55,
    colour: colourOf(e.valence),
  };
}

/** How far the mouth of a speaker is open at `t` [s]: some four syllables a second, none like the one before. */
export function syllables(t: number): number {
  const beat = Math.abs(Math.sin(Math.PI * 4.3 * t));
  const stress = 0.62 + 0.38 * Math.sin(3.7 * t + 1.3 * Math.sin(1.9 * t));
  return Math.max(0.08, beat * stress);
}

/** How far the lids are shut at `t` [s]: a blink of 0.16 s every few seconds. */
export function blinkAt(t: number): number {
  const since = Math.min(t % 4.3, (t + 1.7) % 7.1);
  return since < 0.16 ? Math.sin((Math.PI * since) / 0.16) : 0;
}

/** Moves `from` towards `to` in `dt` [s]: nearly there after half a second, whatever the screen's rate. */
export function towards(from: Expression, to: Expression, dt: number): Expression {
  const part = 1 - Math.exp(-dt / 0.16);
  return {
    valence: blend(from.valence, to.valence, part),
    sad: blend(from.sad, to.sad, part),
    open: to.open,
    shut: to.shut,
    pan: blend(from.pan, to.pan, part),
    tilt: blend(from.tilt, to.tilt, part),
  };
}
