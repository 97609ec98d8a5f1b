// The expression in a word, for readers who do not see it.
import type { ExpressionMessage } from '../lib/protocol';
import { kioskWord } from '../kiosk/words';

export function moodWord(language: string, expression: ExpressionMessage | null): string {
  const valence = expression?.valence ?? 0;
  if (expression?.mood === 'sad') return kioskWord(language, 'sadFace');
  return kioskWord(language, valence > 0.25 ? 'happyFace' : valence < -0.25 ? 'angryFace' : 'neutralFace');
}
