export interface Palette {
  dark: boolean;
  outside: string;
  floor: string;
  parquet: string;
  keepOut: string;
  wall: string;
  wallShadow: string;
  houseShadow: string;
  home: string;
  cloud: [number, number, number];
  light: [number, number, number];
  lightStrength: number;
  path: string;
  trail: string;
  ink: string;
  paper: string;
  people: string[];
  hazards: Record<'glass' | 'plate' | 'stairs' | 'other', { fill: string; line: string; edge: string }>;
}

export const day: Palette = {
  dark: false,
  outside: '#e9dfcf',
  floor: '#fbf5ea',
  parquet: 'rgba(150, 110, 60, 0.10)',
  keepOut: 'rgba(120, 100, 70, 0.07)',
  wall: '#463f5c',
  wallShadow: 'rgba(60, 45, 80, 0.30)',
  houseShadow: 'rgba(70, 50, 30, 0.28)',
  home: '#17806f',
  cloud: [124, 77, 255],
  light: [255, 190, 70],
  lightStrength: 0.5,
  path: '#c8401d',
  trail: 'rgba(200, 64, 29, 0.5)',
  ink: '#2c2740',
  paper: '#fffaf2',
  people: ['#3d7dd8', '#e0699a', '#4aa564', '#c98a2b', '#8a63c9', '#3aa6a6', '#d2604a'],
  hazards: {
    glass: { fill: 'rgba(120, 200, 235, 0.32)', line: 'rgba(255, 255, 255, 0.75)', edge: 'rgba(70, 160, 205, 0.75)' },
    plate: { fill: 'rgba(130, 140, 155, 0.22)', line: 'rgba(100, 110, 125, 0.28)', edge: 'rgba(100, 110, 125, 0.5)' },
    stairs: { fill: 'rgba(205, 150, 110, 0.32)', line: 'rgba(140, 90, 55, 0.42)', edge: 'rgba(140, 90, 55, 0.6)' },
    other: { fill: 'rgba(200, 165, 110, 0.3)', line: 'rgba(150, 115, 65, 0.25)', edge: 'rgba(150, 115, 65, 0.6)' },
  },
};

export const night: Palette = {
  dark: true,
  outside: '#12101d',
  floor: '#2a2640',
  parquet: 'rgba(255, 240, 220, 0.045)',
  keepOut: 'rgba(8, 6, 20, 0.28)',
  wall: '#8d84b5',
  wallShadow: 'rgba(0, 0, 0, 0.55)',
  houseShadow: 'rgba(0, 0, 0, 0.7)',
  home: 'rgba(90, 225, 205, 0.75)',
  cloud: [160, 120, 255],
  light: [255, 205, 120],
  lightStrength: 0.42,
  path: '#ff8a6b',
  trail: 'rgba(255, 138, 107, 0.5)',
  ink: '#f4efff',
  paper: '#1d1930',
  people: ['#7db1ff', '#ff9cc6', '#86d99c', '#f2c06b', '#c0a0ff', '#7fdede', '#ff9c88'],
  hazards: {
    glass: { fill: 'rgba(120, 200, 255, 0.20)', line: 'rgba(220, 245, 255, 0.30)', edge: 'rgba(140, 215, 255, 0.65)' },
    plate: { fill: 'rgba(170, 180, 200, 0.14)', line: 'rgba(200, 210, 230, 0.16)', edge: 'rgba(190, 200, 220, 0.4)' },
    stairs: { fill: 'rgba(230, 170, 120, 0.18)', line: 'rgba(240, 190, 140, 0.3)', edge: 'rgba(240, 190, 140, 0.5)' },
    other: { fill: 'rgba(230, 195, 130, 0.16)', line: 'rgba(240, 205, 150, 0.18)', edge: 'rgba(240, 205, 150, 0.5)' },
  },
};
