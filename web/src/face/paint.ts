// The face on a canvas, by the same curves as the drawing of elements (FaceDrawing.svelte).
import { EYE, type Expression, faceOf } from './expression';

type Context = CanvasRenderingContext2D;

/** `unit`: pixels that one unit of the face (expression.ts) has. Its middle is at (x, y). */
export function paintFace(context: Context, x: number, y: number, unit: number, expression: Expression, visor: string): void {
  const face = faceOf(expression);
  context.save();
  context.translate(x, y);
  context.scale(unit, unit);
  context.lineCap = context.lineJoin = 'round';
  for (const eye of face.eyes) {
    context.save();
    context.beginPath();
    context.ellipse(eye.x, eye.y, EYE.rx, EYE.ry, 0, 0, 7);
    context.clip();
    context.fillStyle = '#fdfdff';
    context.fill();
    context.fillStyle = '#1a1530';
    context.beginPath();
    context.arc(eye.pupil[0], eye.pupil[1], EYE.pupil, 0, 7);
    context.fill();
    context.fillStyle = visor;
    context.strokeStyle = '#8f88ad';
    context.lineWidth = 5;
    for (const lid of [new Path2D(eye.upperLid), new Path2D(eye.lowerLid)]) {
      context.fill(lid);
      context.stroke(lid);
    }
    context.restore();
  }
  context.strokeStyle = face.colour;
  context.lineWidth = 10;
  for (const eye of face.eyes) context.stroke(new Path2D(eye.brow));
  const mouth = new Path2D(face.mouth);
  context.fillStyle = '#5b1430';
  context.fill(mouth);
  context.stroke(mouth);
  context.restore();
}
