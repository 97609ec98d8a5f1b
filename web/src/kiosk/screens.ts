// What the robot's own screen shows, and where its four buttons lead, as a function of what the robot says and of what was
// chosen here. Pure, so that a reload gives the same screen at once and each state can be tested.
import type { AnswerMessage, MissionMessage, Museum, Reason, SpeechMessage, Tour } from '../lib/protocol';
import { progressOf } from '../lib/tour';
import { reasonText } from '../lib/words';
import { type KioskWord, kioskWord, nameOf } from './words';

export type Page = 'home' | 'tours' | 'languages' | 'help' | 'end';
export type Act =
  | { do: 'page'; page: Page; from?: number }
  | { do: 'tour'; id: string }
  | { do: 'help' }
  | { do: 'end' }
  | { do: 'skipStop'; exhibit: string }
  | { do: 'language'; code: string }
  | { do: 'answer'; option: string }
  | { do: 'poll'; question: AnswerMessage['question']; answer: AnswerMessage['answer'] }
  | { do: 'smaller' }
  | { do: 'skip' };
export interface Choice {
  label: string;
  /** A second, smaller line. */
  about?: string;
  act: Act;
  /** Of the label, where it is not that of the screen. */
  language?: string;
  /** It is shown and cannot be chosen yet. */
  isComing?: boolean;
}
/** [4] of the red, yellow, green and blue button; null: it leads nowhere and is dark. */
export type Choices = [Choice | null, Choice | null, Choice | null, Choice | null];

export type ScreenName =
  | 'stranger' | 'opening' | 'away' | 'lost' | 'home' | 'tours' | 'languages' | 'help' | 'ending' | 'sending' | 'coming' | 'refused'
  | 'driving' | 'blocked' | 'explaining' | 'asking' | 'answered' | 'poll' | 'thanks';
export interface Screen {
  name: ScreenName;
  title: string;
  text: string;
  choices: Choices;
  /** Whose picture is shown instead of the face. */
  exhibit?: string;
  /** How far the tour has come, and what comes next. */
  progress?: string;
  /** Of `title`, where it is not that of the screen. */
  language?: string;
}

/** The wish that was made here last. */
export interface Asked {
  state: string;
  /** Why it is in this state. */
  reason: Reason | null;
  /** [s] since it was made */
  age: number;
  /** [s] since its state changed */
  since: number;
}
export interface Situation {
  language: string;
  museum: Museum | null;
  /** It has the robot's key, or nobody has said that it has not. */
  isOwn: boolean;
  line: 'connecting' | 'open' | 'lost';
  localized: boolean;
  mission: MissionMessage | null;
  /** What is being said now. */
  speech: SpeechMessage | null;
  /** The sentence of it. */
  sentence: string;
  blocked: boolean;
  /** [s] to answer the question on show */
  left: number;
  answered: boolean;
  asked: Asked | null;
  /** The tour that was asked for here is over: which question comes, 0..2, or 3: thanks. */
  poll: number | null;
  page: Page;
  /** Of the list on `page`, its first entry. */
  from: number;
  /** In the last question of the poll: fish and amoeba. */
  smaller: boolean;
}

/** Of a wish that is still to be fulfilled. */
export const openStates = ['sending', 'sent', 'queued', 'active'];
export const pollQuestions = ['liked', 'satisfied', 'price', 'intelligence'] as const;
/** A state of the wish is news for so long [s]. */
const NEWS = 8;
/** The mission takes a wish up within a moment; after so long [s] it waits for something. */
const PROMPT = 15;
const NONE: Choices = [null, null, null, null];
/** Which button an answer is: the same everywhere. */
const PLACES: Record<string, number> = { no: 0, yes: 2, more: 2, next: 3 };

class Teller {
  constructor(readonly s: Situation) {}
  w(key: KioskWord): string {
    return kioskWord(this.s.language, key);
  }
  say(texts: Record<string, string> | undefined): string {
    if (!texts) return '';
    return texts[this.s.language] || texts[this.s.museum?.languages[0] ?? ''] || Object.values(texts)[0] || '';
  }
  why(reason: Reason | null): string {
    const exhibits = this.s.museum?.exhibits ?? [];
    return reason ? reasonText(this.s.language, reason, (id) => this.say(exhibits.find((one) => one.id === id)?.title) || id) : '';
  }
  screen(name: ScreenName, title: string, text = '', choices: Choices = NONE, exhibit?: string): Screen {
    return { name, title, text, choices, exhibit };
  }

  // Choices -------------------------------------------------------------------------------------------------------

  tour(tour: Tour): Choice {
    const about: string[] = [];
    if (tour.exhibits.length > 0) about.push(`${tour.exhibits.length} ${this.w('stops')}`);
    if (tour.minutes) about.push(`${tour.minutes} ${this.w('minutes')}`);
    return { label: this.say(tour.title), about: about.join(' · '), act: { do: 'tour', id: tour.id } };
  }
  /** The other language, or the way to the others. Null: there is none. */
  otherLanguage(): Choice | null {
    const others = (this.s.museum?.languages ?? []).filter((code) => code !== this.s.language);
    if (others.length === 0) return null;
    if (others.length === 1) return { label: nameOf(others[0]), language: others[0], act: { do: 'language', code: others[0] } };
    return { label: this.w('language'), about: others.slice(0, 3).map(nameOf).join(' · '), act: { do: 'page', page: 'languages' } };
  }
  /** The entries of a list, two at a time with the way to the others, where three are not all. Blue always leads back. */
  list(entries: Choice[], page: Page, more: string): Choices {
    const back: Choice = { label: this.w('back'), act: { do: 'page', page: 'home' } };
    if (entries.length <= 3) return [entries[0] ?? null, entries[1] ?? null, entries[2] ?? null, back];
    const from = this.s.from < entries.length ? this.s.from : 0;
    const on = from + 2 < entries.length ? from + 2 : 0;
    return [entries[from], entries[from + 1] ?? null, { label: more, act: { do: 'page', page, from: on } }, back];
  }
  /** "Stop 2 of 5 · next: the Transrapid"; undefined where nobody can say. */
  progress(): string | undefined {
    const progress = progressOf(this.s.mission, this.s.museum);
    if (!progress) return undefined;
    const here = this.w('stopOf').replace('{}', String(progress.stop)).replace('{}', String(progress.stops));
    const next = this.s.museum?.exhibits.find((one) => one.id === progress.next[0]);
    return next ? `${here} · ${this.w('then')} ${this.say(next.title)}` : `${here} · ${this.w('lastStop')}`;
  }
  home(): Choices {
    const tours = this.s.museum?.tours ?? [];
    const second = tours.length > 2 ? { label: this.w('otherTours'), act: { do: 'page', page: 'tours', from: 1 } as Act } : null;
    return [
      tours[0] ? this.tour(tours[0]) : null,
      second ?? (tours[1] ? this.tour(tours[1]) : null),
      { label: this.w('help'), act: { do: 'help' } },
      this.otherLanguage(),
    ];
  }

  // Screens -------------------------------------------------------------------------------------------------------

  /** What somebody has opened here, if they have. */
  opened(): Screen | null {
    const { museum, page } = this.s;
    if (page === 'languages') {
      const names = (museum?.languages ?? []).map((code): Choice => ({ label: nameOf(code), language: code, act: { do: 'language', code } }));
      return this.screen('languages', this.w('language'), '', this.list(names, 'languages', `${this.w('language')} …`));
    }
    if (page === 'tours') {
      const tours = (museum?.tours ?? []).map((tour) => this.tour(tour));
      return this.screen('tours', this.w('whichTour'), '', this.list(tours, 'tours', this.w('otherTours')));
    }
    if (page === 'end' && this.isOurs()) {
      const yes: Choice = { label: this.w('yes'), act: { do: 'end' } };
      const no: Choice = { label: this.w('no'), act: { do: 'page', page: 'home' } };
      return this.screen('ending', this.w('endQuestion'), '', [no, null, yes, null]);
    }
    if (page === 'help') {
      const steps = (['helpChoose', 'helpFollow', 'helpListen', 'helpMore'] as const).map((key) => this.w(key)).join('\n');
      const choices = this.home();
      choices[2] = { label: this.w('back'), act: { do: 'page', page: 'home' } };
      return this.screen('help', this.w('helpTitle'), steps, choices);
    }
    return null;
  }
  /** The news of the wish that was made here, while it is news. */
  news(): Screen | null {
    const asked = this.s.asked;
    if (!asked) return null;
    if (asked.state === 'sending') return this.screen('sending', this.w('sending'));
    const isWaiting = openStates.includes(asked.state);
    if (isWaiting && asked.age < PROMPT) return this.screen('coming', this.w('coming'), this.w('comingText'));
    if (['refused', 'failed'].includes(asked.state) && asked.since < NEWS) {
      return this.screen('refused', this.w('refused'), this.why(asked.reason) || this.w('refusedText'));
    }
    return null;
  }
  /** The tour that was wished for here is not over. */
  isOurs(): boolean {
    return !!this.s.asked && openStates.includes(this.s.asked.state);
  }
  /** Who wished for the tour here need not see all of it. */
  skipStop(): Choice | null {
    const { mission, museum } = this.s;
    const tour = museum?.tours.find((one) => one.id === mission?.tour);
    if (!mission || !tour || !this.isOurs()) return null;
    if (tour.exhibits.length > 0 && !tour.exhibits.includes(mission.exhibit)) return null; // somebody else's, on the way
    return { label: this.w('skipStop'), act: { do: 'skipStop', exhibit: mission.exhibit } };
  }
  asking(): Screen {
    const prompt = this.s.mission!.prompt!;
    if (this.s.answered) return this.screen('answered', this.w('gladly'), '', NONE, this.s.mission!.exhibit);
    const words: Record<string, KioskWord> = { more: 'tellMore', next: 'goOn', yes: 'yes', no: 'no' };
    const choices: Choices = [null, null, null, null];
    for (const option of prompt.options) {
      const place = PLACES[option] ?? choices.indexOf(null);
      if (place < 0 || choices[place]) continue;
      choices[place] = { label: words[option] ? this.w(words[option]) : option, act: { do: 'answer', option } };
    }
    const isOfMore = prompt.options.includes('more');
    const text = isOfMore ? this.w('goOnSoon') : '';
    return { ...this.screen('asking', isOfMore ? this.w('moreQuestion') : this.say(prompt.text), text, choices, this.s.mission!.exhibit), progress: this.progress() };
  }
  /** "More" is announced while the first words are spoken: in Bonn people found it at the third exhibit only. */
  explaining(): Screen {
    const id = this.s.mission!.exhibit;
    const exhibit = this.s.museum?.exhibits.find((one) => one.id === id);
    const isLong = this.s.speech?.id.endsWith('/long') ?? false;
    const hasMore = !isLong && Object.values(exhibit?.long ?? {}).some((text) => text !== '');
    const coming = (key: KioskWord, option: string): Choice => ({ label: this.w(key), act: { do: 'answer', option }, isComing: true });
    const choices: Choices = hasMore ? [null, null, coming('tellMore', 'more'), coming('goOn', 'next')] : [...NONE];
    choices[1] = this.skipStop();
    return { ...this.screen('explaining', this.say(exhibit?.title), this.s.sentence, choices, id), progress: this.progress() };
  }
  driving(): Screen {
    const { mission, museum, blocked } = this.s;
    const exhibit = museum?.exhibits.find((one) => one.id === mission!.exhibit);
    const first: Choice = this.isOurs()
      ? { label: this.w('endTour'), act: { do: 'page', page: 'end' } }
      : { label: this.w('anotherTour'), act: { do: 'page', page: 'tours', from: 0 } };
    const choices: Choices = [first, this.skipStop(), null, this.otherLanguage()];
    const text = this.w(blocked ? 'excuseMe' : 'followMe');
    return { ...this.screen(blocked ? 'blocked' : 'driving', this.say(exhibit?.title), text, choices, mission!.exhibit), progress: this.progress() };
  }
  poll(step: number): Screen {
    if (step >= pollQuestions.length) return this.screen('thanks', this.w('thanks'), this.w('thanksText'));
    const question = pollQuestions[step];
    const choice = (key: KioskWord, answer: AnswerMessage['answer']): Choice => ({ label: this.w(key), act: { do: 'poll', question, answer } });
    const skip: Choice = { label: this.w('skip'), act: { do: 'skip' } };
    let choices: Choices = [choice('no', 'no'), choice('undecided', 'undecided'), choice('yes', 'yes'), skip];
    if (question === 'intelligence') {
      choices = this.s.smaller
        ? [choice('fish', 'fish'), choice('amoeba', 'amoeba'), null, skip]
        : [choice('human', 'human'), choice('monkey', 'monkey'), choice('dog', 'dog'), { label: this.w('smaller'), act: { do: 'smaller' } }];
    }
    const count = `${this.w('question')} ${step + 1} ${this.w('of')} ${pollQuestions.length}`;
    return this.screen('poll', this.w(`poll_${question}`), `${count}. ${this.w('pollAnonymous')}`, choices);
  }
  atHome(): Screen {
    const phase = this.s.mission?.phase;
    const isWaiting = !!this.s.asked && openStates.includes(this.s.asked.state);
    const about: Partial<Record<string, KioskWord>> = { going_home: 'goingHome', charging: 'charging', waiting: 'waiting' };
    const why = phase ? about[phase] : undefined;
    const text = isWaiting ? `${this.w('onMyList')} ${why ? this.w(why) : ''}` : this.w(why ?? 'press');
    return this.screen('home', this.w(isWaiting ? 'coming' : 'invite'), text, this.home());
  }
}

export function screenOf(s: Situation): Screen {
  const t = new Teller(s);
  if (!s.isOwn) return t.screen('stranger', t.w('stranger'), t.w('strangerText'));
  if (s.line === 'lost') return t.screen('away', t.w('away'), t.w('awayText'));
  if (s.line === 'connecting' || !s.museum || !s.mission) return t.screen('opening', t.w('sending'));
  const phase = s.mission.phase;
  if (phase === 'waking') return t.screen('lost', t.w('wakingUp'), t.w('lostText'));
  if (phase === 'relocalizing' || !s.localized) return t.screen('lost', t.w('lost'), t.w('lostText'));
  if (s.mission.prompt && s.left > 0) return t.asking();
  if (phase === 'explaining' || phase === 'asking') return t.explaining();
  const opened = t.opened();
  if (phase === 'driving') return opened ?? t.driving();
  if (s.poll !== null) return t.poll(s.poll);
  return t.news() ?? opened ?? t.atHome();
}

/** Numbers, 1 to 4, of the buttons that lead somewhere. */
export const litOf = (screen: Screen): number[] => screen.choices.flatMap((choice, i) => (choice && !choice.isComing ? [i + 1] : []));
