import { expect, test } from 'vitest';
import type { ExpressionMessage } from '../lib/protocol';
import { LivingFace, restOf } from './living';

const shown = (more: Partial<ExpressionMessage>): ExpressionMessage => ({
  type: 'expression', mood: 'neutral', valence: 0, is_speaking: false, gaze: 'none', pan: 0, tilt: 0, ...more,
});

test('it shows what the robot says that it shows, and nothing of its own', () => {
  expect(restOf(shown({ mood: 'sad', valence: -0.4, pan: 0.3, tilt: -0.2 }))).toEqual({
    valence: -0.4, sad: 1, open: 0, shut: 0, pan: 0.3, tilt: -0.2,
  });
  expect(restOf(shown({ is_speaking: true })).open).toBeGreaterThan(0);
  expect(restOf(null)).toEqual({ valence: 0, sad: 0, open: 0, shut: 0, pan: 0, tilt: 0 });
});

test('it glides to a new mood within a second, also after a pause of the screen', () => {
  const face = new LivingFace();
  expect(face.at(shown({ valence: -1 }), 10, false).valence).toBe(-1);
  const first = face.at(shown({ valence: 1 }), 10.02, false).valence;
  expect(first).toBeGreaterThan(-1);
  expect(first).toBeLessThan(0);
  let last = first;
  for (let t = 10.04; t < 11; t += 0.02) last = face.at(shown({ valence: 1 }), t, false).valence;
  expect(last).toBeGreaterThan(0.95);
  expect(face.at(shown({ valence: -1 }), 60, false).valence).toBeGreaterThan(-0.5); // a pause is no jump
});

test('without motion it changes at once, does not blink, and its mouth rests', () => {
  const face = new LivingFace();
  face.at(shown({ valence: -1 }), 0, true);
  for (let t = 0; t < 10; t += 0.05) {
    expect(face.at(shown({ valence: 0.5, is_speaking: true }), t, true)).toEqual(restOf(shown({ valence: 0.5, is_speaking: true })));
  }
});
