import { mount } from 'svelte';
import '../style.css';
import Operate from './Operate.svelte';
import './operate.css';

mount(Operate, { target: document.getElementById('app')! });
