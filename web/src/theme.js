// Light and dark: as the system has it until the reader chooses.
import { byId } from './dom.js';

const dark = window.matchMedia('(prefers-color-scheme: dark)');

export const isDark = () => (document.documentElement.dataset.theme ?? (dark.matches ? 'dark' : 'light')) === 'dark';

/** Colours of the 3D view; those of the page are in style.css. */
export const palette = () => isDark()
  ? { part: '#77818d', target: '#c9cdd2', edge: '#0b0d10', tool: '#c2a873', shank: '#9aa3ad', holder: '#59636e', axis: '#b39df0', fixture: '#5f6f86', struck: '#ff5a4a', body: '#ff9a8f', near: '#e0a030' }
  : { part: '#cdd2d8', target: '#eceae4', edge: '#2a323b', tool: '#c9b07c', shank: '#8b95a0', holder: '#4d5660', axis: '#6446b8', fixture: '#9fb0c6', struck: '#d3281e', body: '#e0655b', near: '#e39a1c' };

export function watchTheme(changed, chosen) {
  if (chosen === 'dark' || chosen === 'light') document.documentElement.dataset.theme = chosen;
  byId('theme').addEventListener('click', () => {
    document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
    changed();
  });
  dark.addEventListener('change', changed);
}
