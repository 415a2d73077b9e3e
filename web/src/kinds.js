// Colours of the kinds of surfaces, of the roles in a wheel, and of what a face is chosen for. They can be told apart without red and green.
import { isDark } from './theme.js';

const KINDS = {
  plane: ['#b9c7d6', '#5f7185'], cylinder: ['#ecc980', '#96762f'], cone: ['#e3a887', '#94573a'], sphere: ['#d2b0d8', '#7d5a86'],
  torus: ['#9fcbbb', '#477a68'], 'B-spline': ['#8fbde6', '#3b6f9f'], mesh: ['#c4c9cf', '#666f79'], 'not read': ['#e2e4e7', '#3b424a'],
  // Of flank bound --map.
  'one pass': ['#56b4e9', '#3585b5'], 'several passes': ['#f0b840', '#b0801c'], 'not by flank': ['#c0561f', '#8f3f16'], 'not examined': ['#e2e4e7', '#3b424a'],
};
/** Light and dark colour of each role that a face has in a wheel. */
const WHEEL = {
  hub: ['#c9ced6', '#59626e'], shroud: ['#dfe2e6', '#434a53'], 'blade side': ['#5fa3d9', '#2f6ea3'], 'splitter side': ['#67bfb2', '#2f7d72'],
  edge: ['#e8a13a', '#a56a12'], tip: ['#f0d264', '#9c8426'], fillet: ['#c08fc9', '#7a4f84'], 'no role': ['#e9e7e0', '#45433d'],
};
const OTHER = ['#d8d3b4', '#6f6a4b'];

/** What a row of faces.json is counted and coloured as: its role in a wheel where that is known, else its kind of surface. */
export const kindOf = (row) => row.role ?? row.type;
export const kindColour = (kind) => (KINDS[kind] ?? WHEEL[kind] ?? OTHER)[isDark() ? 1 : 0];

/** What a face is chosen for. */
export const ROLES = {
  machine: { name: 'Machine', colour: '#d55e00' },
  left: { name: 'Left side', colour: '#d55e00' },
  right: { name: 'Right side', colour: '#a23b8f' },
  floor: { name: 'Floor', colour: '#009e73' },
  hub: { name: 'Hub', colour: '#009e73' },
  protect: { name: 'Protect', colour: '#0050a0' },
  ignore: { name: 'Ignore', colour: '#5b5b5b' },
};
