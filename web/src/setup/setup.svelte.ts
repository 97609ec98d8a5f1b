// A museum that is being set up: how far it is, as the robot knows it, and what is asked of the robot.
import { ApiError, call } from '../lib/api';
import type { KeptPicture, MuseumDraft, MuseumEdition, MuseumFaults, SetupOrder, SetupState, SetupWish } from '../lib/protocol';
import { app } from '../lib/state.svelte';
import { desk } from '../operate/desk.svelte';
import { Editor } from '../editor/editor.svelte';
import { editorWords } from '../editor/words';

export type Step = SetupState['step'];
export const STEPS: Step[] = ['name', 'map', 'hazards', 'exhibits', 'check', 'tour', 'done'];

const wait = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));
/** [ms] until the robot is gone when it begins anew, and until it is back. */
const GOES = 5000;
const COMES = 60000;

class SetupDesk {
  state = $state.raw<SetupState | null>(null);
  /** No museum is being set up here. */
  isElsewhere = $state(false);
  /** The robot does something that was asked of it. */
  isBusy = $state(false);
  /** Its modules begin anew. */
  isBeginning = $state(false);
  faults = $state.raw<string[]>([]);
  editor = $state.raw<Editor | null>(null);
  private edition: MuseumEdition | null = null;

  get step(): Step {
    return this.state?.step ?? 'name';
  }
  async start(): Promise<void> {
    await desk.start();
    await this.logIn();
    if (desk.isOperator) await this.read();
  }
  /** Whoever has started it has the password in the address that was printed. */
  private async logIn(): Promise<void> {
    const password = location.hash.slice(1);
    if (!password) return;
    history.replaceState(null, '', location.pathname);
    await desk.logIn('setup', password);
  }
  async read(): Promise<void> {
    try {
      this.state = await call<SetupState>('GET', '/setup');
      this.isElsewhere = false;
      if (this.step !== 'name') await this.readDraft();
    } catch (error) {
      this.isElsewhere = error instanceof ApiError && error.reason === 'not_found';
      if (!this.isElsewhere) throw error;
    }
  }
  private async readDraft(): Promise<void> {
    this.edition = await call<MuseumEdition>('GET', '/museum');
    this.editor ??= new Editor(this.state!.languages, editorWords(app.language).newExhibit, editorWords(app.language).newRoomName);
    this.editor.load(this.edition.draft);
  }

  /** One thing at a time; what cannot be is said. */
  async ask(work: () => Promise<void>): Promise<void> {
    if (this.isBusy) return;
    this.isBusy = true;
    this.faults = [];
    await desk.attempt(work);
    this.isBusy = false;
  }
  /** Whether it was done. */
  private async change(method: 'PUT' | 'DELETE', path: string, body?: object): Promise<boolean> {
    this.faults = (await call<MuseumFaults>(method, path, body)).faults;
    return this.faults.length === 0;
  }
  /** All modules begin anew: until they are back. */
  private async anew(): Promise<void> {
    this.isBeginning = true;
    for (let waited = 0; app.connection === 'open' && waited < GOES; waited += 100) await wait(100);
    for (let waited = 0; app.connection !== 'open' && waited < COMES; waited += 100) await wait(100);
    this.isBeginning = false;
    await this.read();
  }

  name = (name: string, languages: string[]) =>
    this.ask(async () => {
      if (await this.change('PUT', '/setup/name', { name, languages })) {
        this.editor = null;
        await this.anew();
      }
    });
  order = (order: SetupOrder['order']) => this.ask(async () => void (await call('PUT', '/setup/order', { order } satisfies SetupOrder)));
  keepMap = () =>
    this.ask(async () => {
      if (await this.change('PUT', '/setup/map')) await this.anew();
    });
  mapAgain = () =>
    this.ask(async () => {
      if (await this.change('DELETE', '/setup/map')) await this.anew();
    });

  /** The draft becomes the museum; the robot begins anew with it. Whether it was done. */
  private async publish(): Promise<boolean> {
    if (!this.editor || !this.edition || !this.editor.isChanged) return true;
    if (!(await this.change('PUT', '/museum', { revision: this.edition.revision, draft: this.editor.draft }))) return false;
    await this.anew();
    return true;
  }
  save = () => this.ask(async () => void (await this.publish()));
  /** To another step, with what has been drawn. */
  go = (step: Step) =>
    this.ask(async () => {
      if (!(await this.publish())) return;
      const before = this.step;
      if (!(await this.change('PUT', '/setup/step', { step } satisfies SetupWish))) return;
      // Other modules run when a tour begins, and when it is over and something is to be marked again.
      if ((before === 'tour' || before === 'done') !== (step === 'tour' || step === 'done')) await this.anew();
      else this.state = { ...this.state!, step };
    });
  /** undefined: nothing came of it, which the page has said. */
  send = async (jpeg: string): Promise<KeptPicture | undefined> => {
    let kept: KeptPicture | undefined;
    await desk.attempt(async () => void (kept = await call<KeptPicture>('POST', '/museum/picture', { jpeg })));
    return kept;
  };
  /** What cannot work in the draft. */
  check = async (draft: MuseumDraft): Promise<string[]> => (await call<MuseumFaults>('POST', '/museum/check', draft)).faults;
}

export const setup = new SetupDesk();
