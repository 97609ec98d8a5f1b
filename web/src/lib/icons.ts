// Small line drawings, 24 by 24, one for each kind of exhibit.

const drawings: Record<string, string> = {
  space: 'M12 3c4 3 5 7 4 12H8c-1-5 0-9 4-12zM8 12l-3 4v3l4-3M16 12l3 4v3l-4-3M12 18v3M12 8.500a1.5 1.5 0 1 0 .01 0',
  physics: 'M12 12m-1.5 0a1.5 1.5 0 1 0 3 0a1.5 1.5 0 1 0-3 0M3 12c0-2.5 4-4.5 9-4.500s9 2 9 4.5-4 4.5-9 4.5-9-2-9-4.500zM7.5 4.200c2.200-1.200 5.900 1.300 8.400 5.600s2.8 8.8.6 10-5.900-1.300-8.400-5.600-2.8-8.8-.6-10z',
  train: 'M7 4h10a2 2 0 0 1 2 2v9a2 2 0 0 1-2 2H7a2 2 0 0 1-2-2V6a2 2 0 0 1 2-2zM5 11h14M8 20l2-3M16 20l-2-3M8.5 14h.01M15.5 14h.01',
  car: 'M3 15v-3l2-5h11l4 5 1 .500V15h-2M9 15h6M5 15H3M7 15m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0M17 15m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0M5 11h14',
  flight: 'M3 13l7-1 4-8h2l-1.5 8 4 .500L20 10h1.500l-.7 3.5.7 3.500H20l-1.5-2.5-4 .500L16 21h-2l-4-6-7-1z',
  medicine: 'M9 4h6v5h5v6h-5v5H9v-5H4V9h5z',
  life: 'M8 3c0 5 8 4 8 9s-8 4-8 9M16 3c0 5-8 4-8 9s8 4 8 9M9.5 6h5M9.5 18h5M9 12h6',
  chemistry: 'M10 3v6l-5 9a2 2 0 0 0 2 3h10a2 2 0 0 0 2-3l-5-9V3M8.5 3h7M7.5 15h9',
  computer: 'M7 7h10v10H7zM10 10h4v4h-4zM9 7V3.500M15 7V3.500M9 20.500V17M15 20.500V17M7 9H3.500M7 15H3.500M20.5 9H17M20.5 15H17',
  energy: 'M13 3L5 14h6l-1 7 8-11h-6z',
  light: 'M12 3a6 6 0 0 0-3.5 10.900c.9.8 1 1.600 1 2.600h5c0-1 .1-1.8 1-2.600A6 6 0 0 0 12 3zM10 19.500h4M10.5 21.500h3',
  sound: 'M9 18V6l10-2v12M9 18m-3 0a3 2.5 0 1 0 6 0a3 2.5 0 1 0-6 0M19 16m-3 0a3 2.5 0 1 0 6 0a3 2.5 0 1 0-6 0',
  crew: 'M8 9m-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0M16 9m-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0M2.5 20c0-4 2.5-6 5.5-6s5.5 2 5.5 6M14 14.500c4-1.5 7.5 1 7.5 5.5',
  robot: 'M12 7V4M12 3h.01M6 7h12a2 2 0 0 1 2 2v8a2 2 0 0 1-2 2H6a2 2 0 0 1-2-2V9a2 2 0 0 1 2-2zM9 12h.01M15 12h.01M9.5 15.500h5',
  nature: 'M5 19C4 10 10 4 20 4c0 10-5 16-13 14M5 21c1-5 4-9 9-11',
  animal: 'M12 13c3 0 5 3 5 5s-2 2.5-5 2.5-5-.5-5-2.5 2-5 5-5zM6 11m-2 0a2 2.5 0 1 0 4 0a2 2.5 0 1 0-4 0M18 11m-2 0a2 2.5 0 1 0 4 0a2 2.5 0 1 0-4 0M9.5 6.500m-1.8 0a1.8 2.5 0 1 0 3.600 0a1.8 2.5 0 1 0-3.600 0M14.5 6.500m-1.8 0a1.8 2.5 0 1 0 3.600 0a1.8 2.5 0 1 0-3.600 0',
  art: 'M4 5h16v14H4zM7 8h10v8H7zM7 15l3.5-4 2.5 2.5 1.5-1.500L17 15',
  history: 'M4 20h16M5 17h14M6 17V10M10 17v-7M14 17v-7M18 17v-7M3.5 9.500L12 4l8.5 5.500z',
  industry: 'M12 8.500a3.5 3.5 0 1 0 .01 0M12 3v2.500M12 18.500V21M3 12h2.500M18.5 12H21M5.600 5.600l1.8 1.800M16.600 16.600l1.8 1.800M5.600 18.400l1.8-1.800M16.600 7.400l1.8-1.8',
  earth: 'M12 3a9 9 0 1 0 .01 0M3.5 9.500h17M3.5 14.500h17M12 3c-5 5.5-5 12.5 0 18M12 3c5 5.5 5 12.5 0 18',
  boat: 'M3 13c3 5 15 5 18 0c-3 1.5-15 1.5-18 0zM12 13.5V4M12 5l5 5.5H12',
  house: 'M4 11l8-7 8 7M6 9.5V20h12V9.5M10 20v-6h4v6',
  textile: 'M7 4h10M7 20h10M9 4v16M15 4v16M9 7.5l6 2M9 11l6 2M9 14.5l6 2',
  pot: 'M9 4h6M10 4v3c-6 2-6 13 0 13h4c6 0 6-11 0-13V4M6.5 12h11',
  fire: 'M12 3c1 4 6 6 6 11a6 6 0 0 1-12 0c0-2.5 1.5-4 2.5-5 .5 2 1.5 2.5 2 2.5C10.5 8 11 5 12 3z',
  glass: 'M7 3.5h10l-1 6a4 4 0 0 1-8 0zM12 13.5V20M8.5 20.5h7M7.5 7h9',
  telescope: 'M3.5 13l11-6.5 2 3.5-11 6.5zM14.5 6.5l4-2.5 2.5 4.5-4 2.5M10.5 14l-3 6.5M11.5 13.5l4 7',
  radio: 'M4 9h16v11H4zM8 9l9-5M9 14.5m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0M14.5 13h3M14.5 16h3',
  telephone: 'M6 4l3-.5 1.5 4-2 1.5c1 2.5 3 4.5 5.5 5.5l1.5-2 4 1.5-.5 3.5c-7 1.5-14.5-6-13-13.5z',
  bicycle: 'M6 16m-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0M18 16m-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0M6 16l3.5-7h6L12 16H6M9.5 9L12 16M18 16l-3-9h2.5M8 7h3',
  wheel: 'M12 3.5a8.5 8.5 0 1 0 .01 0M12 8a4 4 0 1 0 .01 0M12 3.5V8M12 16v4.5M3.5 12H8M16 12h4.5',
  anvil: 'M4 8h16v2c-4 0-6 1.5-6 4l2 4v2H8v-2l2-4c0-2-1.5-3-6-6z',
  bridge: 'M2.5 17h19M6 17V6M18 17V6M2.5 12C4 11 5.5 9 6 6c1.5 6 10.5 6 12 0 .5 3 2 5 3.5 6M10 17v-6M14 17v-6',
  pendulum: 'M6 4h12M12 4l5 11M17 17.5m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0M5 18c2 2 5 2.5 7 2',
  microscope: 'M10 3.5l3-1 3 8-3 1zM14.5 11.5c3 2 3 6-1 8.5M6 20.5h12M7 15.5h6M12 11.5l.5 1.5',
  satellite: 'M9.5 9.5h5v5h-5zM9.5 12H3V8.5h4V15.5H3V12M14.5 12H21V8.5h-4v7h4V12M12 14.5v3M9.5 19.5c1.5 1.5 3.5 1.5 5 0',
  snow: 'M12 3v18M4.2 7.5l15.600 9M19.8 7.5l-15.600 9M9.5 4.5L12 7l2.5-2.5M9.5 19.5L12 17l2.5 2.5',
  engine: 'M12 4c4 0 5 3.5 7 8-2 5-4 8-7 8s-5-3-7-8c2-4.5 3-8 7-8zM12 8l3.5 6h-7z',
  star: 'M12 3.500l2.600 5.600 6 .7-4.5 4.200 1.200 6L12 17l-5.300 3 1.200-6L3.400 9.800l6-.700z',
  route: 'M6 19m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0M18 5m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0M8 19h7a3.5 3.5 0 0 0 0-7H9a3.5 3.5 0 0 1 0-7h7',
};

const keywords: [RegExp, string][] = [
  [/canoe|boat|ship|schiff|kanu/, 'boat'],
  [/cabin|house|haus|hut/, 'house'],
  [/loom|spinning|quilt|nylon|textil|thread|cloth/, 'textile'],
  [/pottery|clay|vase|tupperware|kitchen/, 'pot'],
  [/furnace|kiln|blower|fire|feuer/, 'fire'],
  [/telescope|teleskop|star-?gaz/, 'telescope'],
  [/radio/, 'radio'],
  [/telephone|telefon|phone/, 'telephone'],
  [/bicycle|bike|fahrrad/, 'bicycle'],
  [/tire|tyre|reifen/, 'wheel'],
  [/corvette/, 'car'],
  [/locomotive|transrapid|lokomotive/, 'train'],
  [/steam|dampf/, 'industry'],
  [/anvil|smith|forge/, 'anvil'],
  [/bridge|brücke/, 'bridge'],
  [/pendulum|pendel|clock/, 'pendulum'],
  [/microscop|mikroskop/, 'microscope'],
  [/sat\b|satellit/, 'satellite'],
  [/polar|winter|ice|snow|antarct/, 'snow'],
  [/wankel/, 'engine'],
  [/airbus/, 'flight'],
  [/bulb/, 'light'],
  [/crew|team|people|mensch/, 'crew'],
  [/robot|automat/, 'robot'],
  [/space|sputnik|rocket|rakete|moon|mond|satellit|orbit|astro|raum/, 'space'],
  [/flight|fly|plane|flug|aero|wright|balloon/, 'flight'],
  [/train|rail|maglev|transrapid|bahn|metro/, 'train'],
  [/car|auto|traffic|vehicle|wheel|engine|motor|transport|verkehr|airbag/, 'car'],
  [/medic|health|heart|kidney|mri|tomograph|x-ray|arzt/, 'medicine'],
  [/gene|dna|bio|cell|virus|life/, 'life'],
  [/chem|polymer|plastic|catal/, 'chemistry'],
  [/comput|chip|informat|internet|telephone|quantum-?comp|digital|code/, 'computer'],
  [/energy|nuclear|fusion|solar|power|electric|strom|energie/, 'energy'],
  [/laser|light|optic|lamp|licht|photo/, 'light'],
  [/music|sound|acoust|mp3|piano|musik/, 'sound'],
  [/atom|particle|quantum|neutrino|physic|physik|magnet|ion/, 'physics'],
  [/dinosaur|animal|elephant|whale|mammal|tier/, 'animal'],
  [/plant|forest|nature|ocean|sea|natur|climate/, 'nature'],
  [/earth|polar|globe|geo|antarctic/, 'earth'],
  [/glass|glas/, 'glass'],
  [/art|paint|picture|flag|kunst|fashion|dress/, 'art'],
  [/history|president|war|politic|money|geschichte|first/, 'history'],
  [/industr|machine|steam|robotics|factory|technik|tech/, 'industry'],
];

/** The path of a drawing that suits the exhibit's id and topics. */
export function iconFor(id: string, topics: string[]): string {
  for (const text of [id, ...topics].map((part) => part.toLowerCase())) {
    for (const [pattern, name] of keywords) if (pattern.test(text)) return drawings[name];
  }
  return drawings.star;
}
export const routeIcon = drawings.route;

/** A colour of its own for each exhibit: neighbours in the list differ clearly. */
export function hueFor(index: number): number {
  return (18 + index * 137.508) % 360;
}
/** Of a place on the map. */
export const pinIcon = 'M12 21c-4-5-6-8-6-11a6 6 0 0 1 12 0c0 3-2 6-6 11zM12 7.500a2.5 2.5 0 1 0 .01 0';
