import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';

// In development the page comes from here and all else from a running robot: npm run dev, then DOCENT=host:port.
const robot = process.env.DOCENT ?? '127.0.0.1:8080';

export default defineConfig({
  base: './', // the pages lie wherever a proxy shows them
  plugins: [svelte()],
  // Five pages, so that none loads what another needs.
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    reportCompressedSize: true,
    modulePreload: { polyfill: false },
    rollupOptions: { input: ['index.html', 'kiosk.html', 'face.html', 'operate.html', 'setup.html'] },
  },
  server: {
    proxy: {
      '/api': `http://${robot}`,
      '/audio': `http://${robot}`,
      '/camera': `http://${robot}`,
      '/operate': { target: `ws://${robot}`, ws: true, changeOrigin: true, bypass: (request) => (request.headers.upgrade ? undefined : '/operate.html') },
      '/live': { target: `ws://${robot}`, ws: true, changeOrigin: true },
    },
  },
});
