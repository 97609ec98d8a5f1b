// What the page says to the server.
import type {
  AnswerMessage,
  CancelMessage,
  ChoiceMessage,
  HelpMessage,
  LampsMessage,
  LeaseMessage,
  Point,
  RequestMessage,
  SetHoursMessage,
  SkipMessage,
  SteerMessage,
  StopMessage,
  VoteMessage,
  WatchMessage,
} from './protocol';

/** What is asked for. */
export interface Asked {
  id: string;
  kind: 'exhibit' | 'tour' | 'point' | 'room';
  target: string;
  viewpoint: number;
}

/** The target of a wish for a point on the map. */
export const pointName = ([x, y]: Point): string => `${x.toFixed(2)},${y.toFixed(2)}`;
export const requestOf = (asked: Asked, name: string, language: string): RequestMessage => ({
  type: 'request',
  id: asked.id,
  kind: asked.kind,
  target: asked.target,
  viewpoint: asked.viewpoint,
  name,
  language,
});
export const cancelOf = (id: string, request: string): CancelMessage => ({ type: 'cancel', id, request });
export const choiceOf = (id: string, prompt: string, choice: string): ChoiceMessage => ({ type: 'choice', id, prompt, choice });
export const voteOf = (id: string, voter: string, tour: string): VoteMessage => ({ type: 'vote', id, voter, tour });
export const watchOf = (details: boolean): WatchMessage => ({ type: 'watch', details, thin: false });

// Of the robot's own screen alone.
export const lampsOf = (lit: number[]): LampsMessage => ({ type: 'lamps', lit });
export const helpOf = (id: string, language: string): HelpMessage => ({ type: 'help', id, language });
export const skipOf = (id: string, exhibit: string): SkipMessage => ({ type: 'skip', id, exhibit });
export const answerOf = (
  id: string,
  question: AnswerMessage['question'],
  answer: AnswerMessage['answer'],
  language: string,
): AnswerMessage => ({ type: 'answer', id, question, answer, language });

// Of operators alone.
export const leaseOf = (id: string, wants: boolean): LeaseMessage => ({ type: 'lease', id, wants });
export const steerOf = (pressed: boolean, forward: number, turn: number): SteerMessage => ({ type: 'steer', pressed, forward, turn });
/** A release names the stop that the operator has seen. */
export const stopOf = (id: string, stopped: boolean, number: number): StopMessage => ({ type: 'stop', id, stopped, number });
export const setHoursOf = (id: string, mode: SetHoursMessage['mode']): SetHoursMessage => ({ type: 'set_hours', id, mode });
