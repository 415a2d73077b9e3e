// The studio as a process and as a page, for the tests.
import { spawn } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { findBrowser } from './browser.mjs';
import { BINARY, flank, root } from './folder.mjs';

/** Seconds: a machine that does much else draws slowly without a graphics card. */
export const PATIENCE = 240;
const PICTURES = process.env.FLANK_PICTURES;
/** The part on the page. */
export const CHOOSER = 'window.flankStudio.parts.chooser';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}

/** Ends the test where the command, its studio or the browser is missing. */
export function skipIfMissing() {
  if (!BINARY) skip('FLANK_BINARY does not name the command');
  if (!findBrowser()) skip('no Chromium here; `make test-clients` installs it');
  const missing = flank('studio', '/no/such/part', '-o', join(root, 'none'), '--no-browser').stderr;
  if (/without/.test(missing)) skip(missing);
}

/** Keeps a picture of the page, where pictures are wanted. */
export async function keep(page, name) {
  if (!PICTURES) return;
  mkdirSync(PICTURES, { recursive: true });
  writeFileSync(join(PICTURES, `${name}.png`), await page.picture());
}

/** Drops a file on the page and waits until its faces are drawn. */
export async function drop(page, file) {
  const [, stem, ending] = /([^/]*)(\.\w+)$/.exec(file);
  await page.drop(300, 400, file);
  // A second one of the same name gets a number.
  await page.until(`/^${stem}(-\\d+)?\\${ending}$/.test(${CHOOSER}?.data.file) && document.querySelector('#drop').hidden`, PATIENCE);
  await page.frames();
}

/** Fills in a field of the form. */
export const fill = (page, name, value) => page.value(`(() => { const e = document.querySelector('#field-${name}'); e.value = ${JSON.stringify(value)}; e.dispatchEvent(new Event('input', { bubbles: true })); })()`);

/** What the report in the right pane says. */
export const report = (expression) => `(() => { const d = document.querySelector('iframe.report')?.contentDocument; return d?.documentElement?.dataset.ready !== undefined && (${expression}); })()`;

export class StudioProcess {
  /** Begins it; `url` is there once it is served. */
  static async begin(folder, ...words) {
    const studio = new StudioProcess();
    studio.folder = folder;
    studio.process = spawn(BINARY, ['studio', ...words, '-o', folder, '--no-browser', '--json'], { stdio: ['ignore', 'pipe', 'inherit'] });
    studio.ended = new Promise((done) => studio.process.once('exit', (code, signal) => done(code ?? signal)));
    for await (const line of createInterface({ input: studio.process.stdout })) {
      studio.url = JSON.parse(line).url;
      break;
    }
    if (!studio.url) throw new Error('the studio did not begin');
    return studio;
  }

  async get(path) {
    return (await fetch(`${this.url}api/${path}`)).json();
  }

  end(signal = 'SIGINT') {
    this.process.kill(signal);
    return this.ended;
  }
}
