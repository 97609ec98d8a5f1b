import { describe, expect, it } from 'vitest';
import { Arrival, spoken } from './eta';

describe('arrival', () => {
  it('is what the pace says', () => {
    const arrival = new Arrival();
    for (let t = 0; t < 300; t += 0.2) arrival.see(0.6, t);
    expect(arrival.seconds(12)).toBe(20);
    expect(arrival.seconds(60)).toBe(105);
  });
  it('grows when people block the way', () => {
    const arrival = new Arrival();
    for (let t = 0; t < 300; t += 0.2) arrival.see(0.6, t);
    for (let t = 300; t < 330; t += 0.2) arrival.see(0, t);
    expect(arrival.seconds(12)).toBeGreaterThan(40);
  });
  it('does not count the time at an exhibit', () => {
    const arrival = new Arrival();
    for (let t = 0; t < 300; t += 0.2) arrival.see(0.6, t);
    arrival.rest();
    arrival.see(0.6, 900);
    expect(arrival.seconds(12)).toBe(20);
  });
  it('is never nothing', () => expect(new Arrival().seconds(0.1)).toBe(5));
});
describe('spoken', () => {
  it('has minutes from one on', () => {
    expect(spoken(45)).toBe('45 s');
    expect(spoken(135)).toBe('2:15 min');
    expect(spoken(60)).toBe('1:00 min');
  });
});
