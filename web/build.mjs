// Bundles the pages (esbuild), writes each as one HTML template, and all of them as a C++ source that holds them.
// usage: node build.mjs NODE_MODULES FOLDER OUTPUT.cpp
import { createHash } from 'node:crypto';
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [packages, folder, cpp] = process.argv.slice(2);
// The packages lie in the build tree, where an import from here would not look.
const { build } = createRequire(join(packages, 'here.js'))('esbuild');
const source = join(dirname(fileURLToPath(import.meta.url)), 'src');

/** Compilers limit the length of one literal; adjacent ones are joined. */
const LITERAL = 8000;

async function bundle(entry, extra) {
  const result = await build({
    entryPoints: [join(source, entry)],
    bundle: true,
    minify: true,
    write: false,
    charset: 'utf8',
    legalComments: 'inline',
    logLevel: 'warning',
    nodePaths: [packages],
    ...extra,
  });
  return result.outputFiles[0].text;
}

/** What ends a script or a style early inside HTML. */
const inline = (text) => text.replace(/<\/(script|style)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');

function literals(text) {
  const bytes = Buffer.from(text, 'utf8');
  const parts = [];
  for (let at = 0; at < bytes.length; ) {
    let end = Math.min(at + LITERAL, bytes.length);
    while (end < bytes.length && (bytes[end] & 0xc0) === 0x80) --end;
    parts.push(`R"~page~(${bytes.subarray(at, end).toString('utf8')})~page~"`);
    at = end;
  }
  return parts.join('\n');
}

/** A page without its data: template, script and style in one. */
async function page({ template, script, style }) {
  const code = inline((await bundle(script, { format: 'iife', target: 'es2020' })).trim());
  const looks = inline((await bundle(style, { target: 'es2020' })).trim());
  // A page runs this one script: what a name in a file could bring in does not run.
  return readFileSync(join(source, template), 'utf8')
    .replace('SCRIPT_HASH', () => createHash('sha256').update(code, 'utf8').digest('base64'))
    .replace('/*STYLE*/', () => looks)
    .replace('/*SCRIPT*/', () => code);
}

const PAGES = [
  { name: 'page', call: 'page_template', template: 'index.html', script: 'main.js', style: 'style.css' },
  { name: 'faces', call: 'faces_template', template: 'faces.html', script: 'faces.js', style: 'faces.css' },
  { name: 'studio', call: 'studio_template', template: 'studio.html', script: 'studio.js', style: 'studio.css' },
];
let text = '// Made by web/build.mjs.\n#include "flank/report/page_template.h"\n\nnamespace flank::internal {\n';
for (const entry of PAGES) {
  const whole = await page(entry);
  writeFileSync(join(folder, `${entry.name}.html`), whole);
  text += `\nstd::string_view ${entry.call}() {\n  static constexpr char kPage[] =\n${literals(whole)};\n  return {kPage, sizeof kPage - 1};\n}\n`;
}
writeFileSync(cpp, `${text}\n}  // namespace flank::internal\n`);
