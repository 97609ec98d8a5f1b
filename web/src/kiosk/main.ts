import { mount } from 'svelte';
import Kiosk from './Kiosk.svelte';
import { desk } from './desk.svelte';
import './kiosk.css';

desk.start();
mount(Kiosk, { target: document.getElementById('app')! });
