import { expect, test } from 'vitest';
import { blinkAt, colourOf, type Expression, faceOf, syllables, towards } from './expression';

const rest: Expression = { valence: 0, sad: 0, open: 0, shut: 0, pan: 0, tilt: 0 };
/** All numbers of a path, in pairs. */
const points = (path: string) => [...path.matchAll(/(-?[\d.]+) (-?[\d.]+)/g)].map((match) => [Number(match[1]), Number(match[2])]);
/** How much lower the middle of the mouth hangs than its corners. */
const smile = (valence: number) => {
  const [corner, , , below] = points(faceOf({ ...rest, valence }).mouth);
  return below[1] - corner[1];
};
/** How much lower the brow is at the nose than outside. */
const frown = (e: Partial<Expression>) => {
  const [outer, , inner] = points(faceOf({ ...rest, ...e }).eyes[1].brow);
  return inner[1] - outer[1];
};

test('the mouth smiles the more the happier, the brows frown the more the angrier', () => {
  const valences = [-1, -0.5, 0, 0.5, 1];
  const smiles = valences.map(smile);
  const frowns = valences.map((valence) => frown({ valence }));
  for (let i = 1; i < valences.length; ++i) {
    expect(smiles[i]).toBeGreaterThan(smiles[i - 1]);
    expect(frowns[i]).toBeLessThan(frowns[i - 1]);
  }
  expect(smiles[0]).toBeLessThan(-10);
  expect(Math.abs(smiles[2])).toBeLessThan(1);
  expect(smiles[4]).toBeGreaterThan(10);
  expect(frown({ sad: 1 })).toBeLessThan(frown({}) - 15);
});

test('both halves mirror each other', () => {
  for (const valence of [-1, -0.3, 0, 0.6, 1]) {
    const [left, right] = faceOf({ ...rest, valence }).eyes;
    const mirrored = points(left.brow).map(([x, y]) => [-x, y]);
    expect(points(right.brow)).toEqual(mirrored);
  }
});

test('it looks where the head looks: its left is our right', () => {
  const [eye] = faceOf({ ...rest, pan: 0.6, tilt: 0.4 }).eyes;
  const [straight] = faceOf(rest).eyes;
  expect(eye.pupil[0]).toBeGreaterThan(straight.pupil[0] + 5);
  expect(eye.pupil[1]).toBeLessThan(straight.pupil[1] - 4);
  const [wild] = faceOf({ ...rest, pan: 9, tilt: -9 }).eyes; // whatever comes, the pupil stays in the eye
  expect(Math.hypot(wild.pupil[0] - wild.x, wild.pupil[1] - wild.y)).toBeLessThan(25);
});

test('the mouth of a speaker opens and closes several times a second and is never quite shut', () => {
  const opening = Array.from({ length: 500 }, (_, i) => syllables(i / 100));
  expect(Math.min(...opening)).toBeGreaterThan(0.05);
  expect(Math.max(...opening)).toBeLessThanOrEqual(1);
  const peaks = opening.filter((value, i) => i > 0 && value > opening[i - 1] && value >= (opening[i + 1] ?? 0)).length;
  expect(peaks / 5).toBeGreaterThan(3);
  expect(peaks / 5).toBeLessThan(7);
  const height = (open: number) => {
    const [, above, , below] = points(faceOf({ ...rest, open }).mouth);
    return below[1] - above[1];
  };
  expect(height(1)).toBeGreaterThan(height(0) + 20);
});

test('it blinks every few seconds, briefly', () => {
  const shut = Array.from({ length: 6000 }, (_, i) => blinkAt(i / 100));
  const blinks = shut.filter((value, i) => value > 0.01 && shut[i - 1] <= 0.01).length;
  expect(blinks).toBeGreaterThan(10); // in a minute
  expect(blinks).toBeLessThan(30);
  expect(shut.filter((value) => value > 0.01).length / 6000).toBeLessThan(0.08);
});

test('a mood comes over it within half a second, whatever the rate of the screen', () => {
  for (const rate of [15, 60, 144]) {
    let face = rest;
    for (let i = 0; i < rate / 2; ++i) face = towards(face, { ...rest, valence: 1, pan: 0.5 }, 1 / rate);
    expect(face.valence).toBeGreaterThan(0.9);
    expect(face.valence).toBeLessThan(1);
  }
  expect(colourOf(-1)).toBe('rgb(255 110 80)');
  expect(colourOf(1)).toBe('rgb(255 214 92)');
  expect(colourOf(0)).toBe('rgb(126 240 224)');
});
