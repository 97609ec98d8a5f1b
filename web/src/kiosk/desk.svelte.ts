import { addressOf, keptAs } from '../lib/site';
import { app, keyOf, type Wish } from '../lib/state.svelte';
import { answerOf, helpOf, lampsOf, skipOf, stopOf } from '../lib/orders';
import { sentencesOf } from '../lib/sentences';
import { uuid7 } from '../lib/uuid';
import { type Act, type Asked, litOf, openStates, type Page, pollQuestions, type Screen, screenOf } from './screens';

/** What was opened here, or a poll, closes by itself after this time [s] without a press: the next visitors begin at home. */
const OPENED = 25;
const THANKS = 5;
/** A tour that is over for longer [s] is asked about no more. */
const FRESH = 120;
/** The museum's first language comes back after this time [s] without a press, while nobody is shown around. */
const LANGUAGE = 60;
/** Presses within this time [s] after one that led somewhere are none: a button may be heard as a key, too, and a child
    that hammers on it shall not answer questions that nobody has read. */
const DOUBLE = 0.3;
/** The lamps are told again after this time [s]: a screen that tells nothing for long counts as gone. */
const LAMPS = 5;
/** A press is obeyed only so long [s] after it was made. */
const LATE = 1.5;

/** The poll under way: it outlives a reload. */
interface PollState {
  wish: string;
  step: number;
}
const polls = {
  read(): PollState {
    try {
      return JSON.parse(localStorage.getItem(keptAs('poll')) ?? 'null') ?? { wish: '', step: 0 };
    } catch {
      return { wish: '', step: 0 };
    }
  },
  write(state: PollState): void {
    try {
      localStorage.setItem(keptAs('poll'), JSON.stringify(state));
    } catch {
      // then a reload begins the questions again
    }
  },
};

class Desk {
  now = $state(0);
  private page = $state<Page>('home');
  private from = $state(0);
  private smaller = $state(false);
  private pollState = $state.raw(polls.read());
  private isStranger = $state(false);
  private obeyed = -10;
  private lastPress = $state(0);
  private told = { lit: '', at: -10 };
  private seenButton: unknown = undefined;
  private pollSince = { key: '', at: 0 };
  private seconds = () => performance.now() / 1000;

  readonly screen: Screen = $derived.by(() => this.look());
  readonly speaking = $derived(
    app.speech?.state === 'speaking' && this.now < app.speech.start + app.speech.duration + 2 ? app.speech : null,
  );
  /** [s] to answer the question on show */
  readonly left = $derived(app.mission?.prompt ? Math.max(0, app.mission.prompt.deadline - this.now) : 0);

  start(): void {
    app.screenKey = location.hash.slice(1);
    this.isStranger = !/^[0-9a-f]{32}$/.test(app.screenKey);
    this.lastPress = this.seconds();
    if (this.isStranger) return;
    void app.start().then(() => this.speakMuseumsLanguage());
    setInterval(() => this.tick(), 100);
    setInterval(() => void this.askWhetherStranger(), 3000);
  }
  press(number: number): void {
    const at = this.seconds();
    this.lastPress = at;
    const choice = this.screen.choices[number - 1];
    if (!choice || choice.isComing || at - this.obeyed < DOUBLE) return;
    this.obeyed = at;
    this.obey(choice.act);
  }

  /** Staff let the robot go on. */
  stop(): void {
    app.tell(stopOf(uuid7(), true, 0));
  }

  // What is shown -------------------------------------------------------------------------------------------------

  private look(): Screen {
    return screenOf({
      language: app.language,
      museum: app.museum,
      isOwn: !this.isStranger,
      line: app.connection,
      localized: app.localized,
      mission: app.mission,
      speech: this.speaking,
      sentence: this.sentence(),
      blocked: app.path?.state === 'blocked' || (app.avoid?.blocked === true && app.avoid.person),
      left: this.left,
      answered: !!app.mission?.prompt && app.answered === app.mission.prompt.id,
      asked: this.asked(),
      poll: this.poll(),
      page: this.page,
      from: this.from,
      smaller: this.smaller,
    });
  }
  private sentence(): string {
    const speech = this.speaking;
    if (!speech) return '';
    const parts = sentencesOf(speech.text);
    const place = ((this.now - speech.start) / Math.max(0.1, speech.duration)) * speech.text.length;
    return (parts.find((part) => place < part.to) ?? parts[parts.length - 1])?.text.trim() ?? '';
  }
  private asked(): Asked | null {
    const wish = app.wishes[app.wishes.length - 1];
    if (!wish) return null;
    const entry = [...(app.board?.open ?? []), ...(app.board?.closed ?? [])].find((one) => one.key === keyOf(wish.id));
    void this.now; // ages
    const age = (Date.now() - wish.made) / 1000;
    return { state: wish.state, reason: wish.reason, age, since: entry ? this.now - entry.changed : age };
  }
  /** The last tour that this screen asked for and that is over. */
  private get tourWish(): Wish | undefined {
    return app.wishes.filter((one) => one.kind === 'tour' && one.state === 'fulfilled').at(-1);
  }
  /** Which question about it comes; null: none. */
  private poll(): number | null {
    const wish = this.tourWish;
    const entry = wish && app.board?.closed.find((one) => one.key === keyOf(wish.id));
    if (!wish || !entry || this.now - entry.changed > FRESH) return null;
    const step = this.pollState.wish === wish.id ? this.pollState.step : 0;
    return step > pollQuestions.length ? null : step;
  }
  private goTo(step: number): void {
    this.pollState = { wish: this.tourWish?.id ?? '', step };
    this.smaller = false;
    polls.write(this.pollState);
  }

  // What is done --------------------------------------------------------------------------------------------------

  private obey(act: Act): void {
    switch (act.do) {
      case 'page':
        return this.open(act.page, act.from);
      case 'tour':
        app.ask('tour', act.id);
        return this.open('home');
      case 'help':
        app.tell(helpOf(uuid7(), app.language));
        return this.open('help');
      case 'end':
        this.endTour();
        return this.open('home');
      case 'skipStop':
        return app.tell(skipOf(uuid7(), act.exhibit));
      case 'language':
        this.speak(act.code);
        return this.open('home');
      case 'answer':
        return app.answer(act.option);
      case 'poll':
        app.tell(answerOf(uuid7(), act.question, act.answer, app.language));
        return this.goTo(pollQuestions.indexOf(act.question) + 1);
      case 'smaller':
        this.smaller = true;
        return;
      case 'skip':
        return this.goTo(pollQuestions.length);
    }
  }
  /** What was wished for here is not wished for any more; others who follow the same tour keep theirs. */
  private endTour(): void {
    const wish = app.wishes.at(-1);
    if (wish && openStates.includes(wish.state)) app.cancel(wish);
  }
  private open(page: Page, from = 0): void {
    this.page = page;
    this.from = from;
  }
  /** Until the next choice, and through a reload. */
  private speak(language: string): void {
    app.language = language;
    sessionStorage.setItem(keptAs('kiosk.language'), language);
  }
  private speakMuseumsLanguage(): void {
    const languages = app.museum?.languages ?? [];
    const kept = sessionStorage.getItem(keptAs('kiosk.language')) ?? '';
    app.language = languages.includes(kept) ? kept : (languages[0] ?? 'en');
  }

  private tick(): void {
    this.now = app.clock.now();
    this.takeButton();
    const idle = this.seconds() - this.lastPress;
    if (idle > OPENED && this.page !== 'home') this.open('home');
    this.endPoll();
    const languages = app.museum?.languages ?? [];
    if (idle > LANGUAGE && this.screen.name === 'home' && languages.length > 0 && app.language !== languages[0] && !this.isUnderWay()) {
      this.speak(languages[0]);
    }
    this.tellLamps();
  }
  private isUnderWay(): boolean {
    const asked = this.asked();
    return !!asked && openStates.includes(asked.state);
  }
  /** The last press is there on arrival, too, and means nothing then. */
  private takeButton(): void {
    const button = app.button;
    if (!button || button === this.seenButton) return;
    this.seenButton = button;
    if (Math.abs(this.now - button.t) < LATE) this.press(button.number);
  }
  private endPoll(): void {
    const step = this.screen.name === 'poll' || this.screen.name === 'thanks' ? this.poll() : null;
    const key = `${step}`;
    if (this.pollSince.key !== key) this.pollSince = { key, at: this.seconds() };
    if (step === null) return;
    const since = this.seconds() - Math.max(this.pollSince.at, this.lastPress);
    if (step >= pollQuestions.length ? since > THANKS : since > OPENED) this.goTo(pollQuestions.length + 1);
  }
  private tellLamps(): void {
    const lit = litOf(this.screen);
    const at = this.seconds();
    if (app.connection !== 'open') this.told.lit = '?';
    else if (this.told.lit !== lit.join() || at - this.told.at > LAMPS) {
      this.told = { lit: lit.join(), at };
      app.tell(lampsOf(lit));
    }
  }
  /** A server that answers and yet does not open the channel has another key. */
  private async askWhetherStranger(): Promise<void> {
    if (app.connection !== 'lost') {
      this.isStranger = false;
      return;
    }
    const answers = await fetch(addressOf('/api/health'), { signal: AbortSignal.timeout(2000) }).then((reply) => reply.ok, () => false);
    this.isStranger = answers && app.connection === 'lost' && !this.wasOpen;
  }
  private get wasOpen(): boolean {
    return app.mission !== null;
  }
}

export const desk = new Desk();
