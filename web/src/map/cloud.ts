import type { BeliefMessage } from '../lib/protocol';
import type { Camera } from './camera';

interface Picture {
  canvas: HTMLCanvasElement;
  x: number;
  y: number;
  width: number;
  height: number;
}

/** The belief as a glowing cloud. A new belief fades in over the old one. */
export class Cloud {
  private now: Picture | null = null;
  private before: Picture | null = null;
  private since = 0;
  private shown: BeliefMessage | null = null;
  private color = '';

  update(belief: BeliefMessage | null, color: [number, number, number], time: number): void {
    if (belief === this.shown && this.color === color.join()) return;
    this.shown = belief;
    this.color = color.join();
    this.before = this.now;
    this.since = time;
    this.now = belief ? picture(belief, color) : null;
  }
  draw(context: CanvasRenderingContext2D, camera: Camera, floor: Path2D, time: number, calm: boolean): void {
    const part = Math.min(1, (time - this.since) / 0.5);
    const breath = calm ? 1 : 0.93 + 0.07 * Math.sin(time * 2.2);
    context.save();
    context.translate(camera.px(0), camera.py(0));
    context.scale(camera.scale, -camera.scale);
    context.clip(floor, 'evenodd');
    context.imageSmoothingEnabled = true;
    context.imageSmoothingQuality = 'high';
    for (const [image, strength] of [
      [this.before, 1 - part],
      [this.now, part],
    ] as const) {
      if (!image || strength <= 0) continue;
      context.globalAlpha = strength * breath;
      context.save();
      context.translate(image.x, image.y);
      context.drawImage(image.canvas, 0, 0, image.width, image.height);
      context.restore();
    }
    context.restore();
  }
}

function picture(belief: BeliefMessage, [r, g, b]: [number, number, number]): Picture | null {
  const { x, y, cell, columns, rows, levels } = belief.raster;
  if (columns < 1 || rows < 1) return null;
  const bytes = atob(levels);
  // A margin lets the blur run out.
  const margin = 3;
  const wide = columns + 2 * margin;
  const tall = rows + 2 * margin;
  const raw = new Float32Array(wide * tall);
  for (let i = 0; i < bytes.length; ++i) {
    raw[(Math.floor(i / columns) + margin) * wide + (i % columns) + margin] = bytes.charCodeAt(i) / 255;
  }
  const soft = blurred(blurred(raw, wide, tall), wide, tall);
  const canvas = document.createElement('canvas');
  canvas.width = wide;
  canvas.height = tall;
  const context = canvas.getContext('2d')!;
  const image = context.createImageData(wide, tall);
  for (let i = 0; i < soft.length; ++i) {
    const level = Math.min(1, soft[i] * 1.15);
    image.data[4 * i] = r + (255 - r) * level * level * 0.35;
    image.data[4 * i + 1] = g + (255 - g) * level * level * 0.35;
    image.data[4 * i + 2] = b;
    image.data[4 * i + 3] = 255 * 0.72 * Math.pow(level, 0.55);
  }
  context.putImageData(image, 0, 0);
  return { canvas, x: x - margin * cell, y: y - margin * cell, width: wide * cell, height: tall * cell };
}

function blurred(field: Float32Array, wide: number, tall: number): Float32Array {
  const result = new Float32Array(field.length);
  for (let y = 1; y < tall - 1; ++y) {
    for (let x = 1; x < wide - 1; ++x) {
      const i = y * wide + x;
      result[i] =
        (4 * field[i] +
          2 * (field[i - 1] + field[i + 1] + field[i - wide] + field[i + wide]) +
          field[i - wide - 1] + field[i - wide + 1] + field[i + wide - 1] + field[i + wide + 1]) / 16;
    }
  }
  return result;
}
