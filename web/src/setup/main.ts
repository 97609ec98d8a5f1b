import { mount } from 'svelte';
import '../style.css';
import '../operate/operate.css';
import '../editor/editor.css';
import Setup from './Setup.svelte';
import './setup.css';

mount(Setup, { target: document.getElementById('app')! });
