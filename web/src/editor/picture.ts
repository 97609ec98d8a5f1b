// A picture as the museum keeps it: a JPEG file that is no larger than a screen shows, and small enough to be sent.

/** [pixels] of its longer side. */
export const LONGEST = 1600;
/** Letters of base64 that fit into what may be sent of a museum (1 MB), with room. */
export const MOST_LETTERS = 900_000;

/** [width, height] with the same shape, and no side longer. */
export function sizeWithin(width: number, height: number, longest: number): [number, number] {
  const scale = Math.min(1, longest / Math.max(width, height));
  return [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
}

/** Its bytes in base64, made smaller until they fit; null: the browser shows no such file. */
export async function jpegOf(file: Blob): Promise<string | null> {
  const picture = await createImageBitmap(file).catch(() => null);
  if (!picture) return null;
  for (let longest = LONGEST; longest >= 100; longest /= 2) {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = sizeWithin(picture.width, picture.height, longest);
    const pen = canvas.getContext('2d');
    if (!pen) return null;
    pen.fillStyle = '#fff'; // behind what is transparent
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(picture, 0, 0, canvas.width, canvas.height);
    const jpeg = canvas.toDataURL('image/jpeg', 0.85).split(',')[1] ?? '';
    if (jpeg.length <= MOST_LETTERS) return jpeg;
  }
  return null;
}
