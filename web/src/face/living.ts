// The expression that the robot shows (docent/expression), as a face that moves: what every picture of it has in common.
import type { ExpressionMessage } from '../lib/protocol';
import { blinkAt, type Expression, syllables, towards } from './expression';

/** The face at rest; null: nobody says what it shows, so it is calm and looks ahead. */
export function restOf(message: ExpressionMessage | null): Expression {
  return {
    valence: message?.valence ?? 0,
    sad: message?.mood === 'sad' ? 1 : 0,
    open: message?.is_speaking ? 0.5 : 0,
    shut: 0,
    pan: message?.pan ?? 0,
    tilt: message?.tilt ?? 0,
  };
}

/** Glides from one expression to the next, blinks, and moves its mouth while the robot speaks. */
export class LivingFace {
  private shown: Expression | null = null;
  private last = 0;

  /** The face at `now` [s]; `calm`: without motion. */
  at(message: ExpressionMessage | null, now: number, calm: boolean): Expression {
    const goal = restOf(message);
    if (!calm) {
      goal.shut = blinkAt(now);
      if (message?.is_speaking) goal.open = syllables(now);
    }
    this.shown = calm || !this.shown ? goal : towards(this.shown, goal, Math.min(0.1, now - this.last));
    this.last = now;
    return this.shown;
  }
}
