// Bundles the page (esbuild) and writes it as one HTML template, and as a C++ source that holds it.
// usage: node build.mjs NODE_MODULES OUTPUT.html OUTPUT.cpp
import { createHash } from 'node:crypto';
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [packages, html, cpp] = process.argv.slice(2);
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

const script = await bundle('main.js', { format: 'iife', target: 'es2020' });
const style = await bundle('style.css', { target: 'es2020' });
const code = inline(script.trim());
// The page runs this one script and fetches nothing: what a name in a file could bring in does not run.
const page = readFileSync(join(source, 'index.html'), 'utf8')
  .replace('SCRIPT_HASH', () => createHash('sha256').update(code, 'utf8').digest('base64'))
  .replace('/*STYLE*/', () => inline(style.trim()))
  .replace('/*SCRIPT*/', () => code);
writeFileSync(html, page);
writeFileSync(
  cpp,
  `// Made by web/build.mjs.\n#include "flank/report/page_template.h"\n\nnamespace flank::internal {\n\nstd::string_view page_template() {\n` +
    `  static constexpr char kPage[] =\n${literals(page)};\n  return {kPage, sizeof kPage - 1};\n}\n\n}  // namespace flank::internal\n`,
);
