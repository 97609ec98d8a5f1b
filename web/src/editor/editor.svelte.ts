// The draft at work: what is chosen, what is being drawn, and the way back.
import type { MuseumDraft, Point, Pose } from '../lib/protocol';
import { addExhibit, addExhibitBefore, addHazard, addRoom, addTour, addViewpoint, handlesOf, moveAll, moveHandle, poseOf, remove, removeHandle, splitSide, type Handle, type Selection } from './draft';

export type Tool = 'choose' | 'hazard' | 'exhibit' | 'viewpoint' | 'charger' | 'room';
/** [m] so near to its first corner, a click closes a polygon. */
const CLOSES = 0.3;
const MOST_STEPS = 200;

export class Editor {
  draft = $state.raw<MuseumDraft>({ area: [], hazards: [], home: [0, 0, 0], charger: null, exhibits: [], tours: [], rooms: [], hours: { open: [], web: [], closed: [] } });
  selection = $state.raw<Selection | null>(null);
  tool = $state<Tool>('choose');
  /** The corners so far of a hazard that is being drawn. */
  drawing = $state.raw<Point[]>([]);
  /** Pictures that were sent from here, by their files in the museum's folder: where this browser has them. */
  pictures = $state.raw<Record<string, string>>({});
  private past = $state.raw<MuseumDraft[]>([]);
  private future = $state.raw<MuseumDraft[]>([]);
  private saved = $state.raw<MuseumDraft | null>(null);

  /** @param newTitle of an exhibit that has no name yet; `newRoom` likewise of a room */
  constructor(readonly languages: string[], private readonly newTitle: string, private readonly newRoom: string) {}

  load(draft: MuseumDraft): void {
    this.draft = this.saved = draft;
    this.past = this.future = [];
    this.choose(null);
  }
  get isChanged(): boolean {
    return this.draft !== this.saved;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }
  get handles(): Handle[] {
    return this.selection ? handlesOf(this.draft, this.selection) : [];
  }

  choose(selection: Selection | null): void {
    this.selection = selection;
    this.tool = 'choose';
    this.drawing = [];
  }
  take(tool: Tool): void {
    this.tool = this.tool === tool ? 'choose' : tool;
    this.drawing = [];
  }
  /** One step, which can be undone. */
  change(next: MuseumDraft): void {
    if (next === this.draft) return;
    this.past = [...this.past.slice(-MOST_STEPS + 1), this.draft];
    this.future = [];
    this.draft = next;
  }
  undo(): void {
    const before = this.past.at(-1);
    if (!before) return;
    this.future = [...this.future, this.draft];
    this.past = this.past.slice(0, -1);
    this.become(before);
  }
  redo(): void {
    const after = this.future.at(-1);
    if (!after) return;
    this.past = [...this.past, this.draft];
    this.future = this.future.slice(0, -1);
    this.become(after);
  }
  private become(draft: MuseumDraft): void {
    this.draft = draft;
    const chosen = this.selection;
    if (chosen?.kind === 'hazard' && !draft.hazards[chosen.index]) this.selection = null;
    if (chosen?.kind === 'exhibit' && !draft.exhibits[chosen.index]) this.selection = null;
    if (chosen?.kind === 'tour' && !draft.tours[chosen.index]) this.selection = null;
    if (chosen?.kind === 'room' && !draft.rooms[chosen.index]) this.selection = null;
    if (chosen?.kind === 'charger' && !draft.charger) this.selection = null;
  }

  /** A click on the floor, with the tool that is in hand. */
  click(place: Point): void {
    switch (this.tool) {
      case 'choose':
        return this.choose(null);
      case 'hazard': {
        const [first] = this.drawing;
        if (this.drawing.length >= 3 && Math.hypot(place[0] - first[0], place[1] - first[1]) < CLOSES) return this.close();
        this.drawing = [...this.drawing, place];
        return;
      }
      case 'exhibit':
        this.change(addExhibit(this.draft, place, this.languages, this.newTitle));
        return this.choose({ kind: 'exhibit', index: this.draft.exhibits.length - 1 });
      case 'viewpoint':
        if (this.selection?.kind === 'exhibit') this.change(addViewpoint(this.draft, this.selection.index, place));
        this.tool = 'choose';
        return;
      case 'charger':
        this.change({ ...this.draft, charger: [place[0], place[1], 0] });
        return this.choose({ kind: 'charger' });
      case 'room':
        return this.nameRoom(place);
    }
  }
  private nameRoom(place: Point): void {
    this.change(addRoom(this.draft, place, this.languages, this.newRoom));
    this.choose({ kind: 'room', index: this.draft.rooms.length - 1 });
  }
  newTour(title: string): void {
    this.change(addTour(this.draft, this.languages, title));
    this.choose({ kind: 'tour', index: this.draft.tours.length - 1 });
  }
  /** What is drawn becomes a hazard. */
  close(): void {
    if (this.drawing.length < 3) return;
    this.change(addHazard(this.draft, this.drawing));
    this.choose({ kind: 'hazard', index: this.draft.hazards.length - 1 });
  }
  /** What the robot stands at: the next corner of a hazard, a new exhibit, a room, or where it shall stand for what is chosen. */
  placeRobot(pose: Pose): void {
    if (this.tool === 'hazard') this.drawing = [...this.drawing, [pose[0], pose[1]]];
    else if (this.tool === 'exhibit') {
      this.change(addExhibitBefore(this.draft, pose, this.languages, this.newTitle));
      this.choose({ kind: 'exhibit', index: this.draft.exhibits.length - 1 });
    } else if (this.tool === 'room') this.nameRoom([pose[0], pose[1]]);
    else if (this.selection?.kind === 'room') this.change(moveHandle(this.draft, this.selection, { kind: 'place', index: -1 }, [pose[0], pose[1]]));
    else if (this.selection && poseOf(this.draft, this.selection)) {
      const handle = { kind: 'pose', index: -1 } as const;
      const placed = moveHandle(this.draft, this.selection, handle, [pose[0], pose[1]]);
      this.change(moveHandle(placed, this.selection, { kind: 'heading', index: -1 }, [pose[0] + Math.cos(pose[2]), pose[1] + Math.sin(pose[2])]));
    }
  }

  /** A drag begins: all that follows until the next one is one step. */
  begin(): void {
    this.change({ ...this.draft });
  }
  /** During a drag. The handle that is held then: the middle of a side has become a corner. */
  drag(handle: Handle, to: Point): Handle {
    if (!this.selection) return handle;
    if (handle.kind === 'middle') {
      this.draft = splitSide(this.draft, this.selection, handle.index);
      handle = { key: `corner:${handle.index + 1}`, kind: 'corner', at: to, index: handle.index + 1 };
    }
    this.draft = moveHandle(this.draft, this.selection, handle, to);
    return handle;
  }
  dragAll(by: Point): void {
    if (this.selection) this.draft = moveAll(this.draft, this.selection, by);
  }
  /** By the keyboard. */
  nudge(handle: Handle, by: Point): void {
    this.begin();
    this.drag(handle, [handle.at[0] + by[0], handle.at[1] + by[1]]);
  }
  removeHandle(handle: Handle): void {
    if (this.selection) this.change(removeHandle(this.draft, this.selection, handle));
  }
  removeChosen(): void {
    if (!this.selection) return;
    this.change(remove(this.draft, this.selection));
    this.choose(null);
  }
}
