import type { MapsMessage } from '../lib/protocol';
import type { Camera } from './camera';

type Raster = MapsMessage['value'];
/** The colour of a level of 1 to 255. */
type Ramp = (level: number) => [red: number, green: number, blue: number, alpha: number];

/** The nearer the goal by cost, the warmer; in bands, as lines of height on a map. */
const valueRamp: Ramp = (level) => {
  const near = (level - 1) / 254;
  const band = Math.floor(near * 20) % 2 === 0 ? 1 : 0.82;
  return [Math.round(255 * near * band), Math.round((90 + 70 * near) * band), Math.round(210 * (1 - near) * band), 150];
};
const thingRamp: Ramp = () => [230, 80, 20, 230];

/** A raster of the robot's over the floor plan. */
class Overlay {
  private canvas: HTMLCanvasElement | null = null;
  private shown: Raster | null = null;

  constructor(private readonly ramp: Ramp) {}

  draw(context: CanvasRenderingContext2D, camera: Camera, raster: Raster | null): void {
    if (raster !== this.shown) {
      this.shown = raster;
      this.canvas = raster && raster.columns > 0 ? this.picture(raster) : null;
    }
    if (!this.canvas || !raster) return;
    context.save();
    context.translate(camera.px(raster.x), camera.py(raster.y));
    context.scale(camera.scale, -camera.scale);
    context.imageSmoothingEnabled = false;
    context.drawImage(this.canvas, 0, 0, raster.columns * raster.cell, raster.rows * raster.cell);
    context.restore();
  }
  private picture(raster: Raster): HTMLCanvasElement {
    const bytes = atob(raster.levels);
    const canvas = document.createElement('canvas');
    canvas.width = raster.columns;
    canvas.height = raster.rows;
    const context = canvas.getContext('2d')!;
    const image = context.createImageData(raster.columns, raster.rows);
    for (let i = 0; i < bytes.length; ++i) {
      const level = bytes.charCodeAt(i);
      if (level > 0) image.data.set(this.ramp(level), 4 * i);
    }
    context.putImageData(image, 0, 0);
    return canvas;
  }
}

/** What the planner knows, as far as it is asked for. */
export class PlannersMaps {
  private readonly value = new Overlay(valueRamp);
  private readonly things = new Overlay(thingRamp);

  draw(context: CanvasRenderingContext2D, camera: Camera, maps: MapsMessage | null, shows: { value: boolean; live: boolean }): void {
    if (shows.value) this.value.draw(context, camera, maps?.value ?? null);
    if (shows.live) this.things.draw(context, camera, maps?.live ?? null);
  }
}
