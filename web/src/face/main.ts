import { mount } from 'svelte';
import FacePage from './FacePage.svelte';
import './face.css';

mount(FacePage, { target: document.getElementById('app')! });
