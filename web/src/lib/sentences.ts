/** Splits a text where a speaker would breathe; each part with its place in the text. */
export function sentencesOf(text: string): { text: string; from: number; to: number }[] {
  const parts: { text: string; from: number; to: number }[] = [];
  const pattern = /[^.!?…]+(?:[.!?…]+["”’)»]*\s*|$)/g;
  for (const match of text.matchAll(pattern)) {
    const from = match.index ?? 0;
    const last = parts[parts.length - 1];
    // "St. Petersburg", "3.5": a very short part belongs to the one before it.
    if (last && (match[0].trim().length < 6 || last.text.trim().length < 6)) {
      last.text += match[0];
      last.to = from + match[0].length;
    } else {
      parts.push({ text: match[0], from, to: from + match[0].length });
    }
  }
  return parts.filter((part) => part.text.trim() !== '');
}

/** Of a text of the museum: an empty line ends one; headings are paragraphs. */
export function paragraphs(text: string): string[] {
  return text
    .split(/\n\s*\n/)
    .map((part) => part.replace(/^#+\s*/, '').trim())
    .filter(Boolean);
}
