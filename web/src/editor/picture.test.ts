import { expect, test } from 'vitest';
import { sizeWithin } from './picture';

test('a picture keeps its shape and grows never', () => {
  expect(sizeWithin(4000, 3000, 1600)).toEqual([1600, 1200]);
  expect(sizeWithin(300, 4000, 1600)).toEqual([120, 1600]);
  expect(sizeWithin(64, 48, 1600)).toEqual([64, 48]);
  expect(sizeWithin(10000, 1, 1600)).toEqual([1600, 1]);
});
