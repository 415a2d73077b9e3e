// A headless Chromium, driven over its debugging pipe: nothing but Node.js is needed for that.
import { spawn } from 'node:child_process';
import { accessSync, constants, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const NAMES = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable'];
const FLAGS = ['--headless', '--no-first-run', '--disable-quic', '--disable-background-networking', '--disable-component-update',
  '--disable-sync', '--hide-scrollbars', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--remote-debugging-pipe'];

export function findBrowser() {
  const folders = (process.env.PATH ?? '').split(':').filter(Boolean);
  const files = process.env.FLANK_BROWSER ? [process.env.FLANK_BROWSER] : NAMES.flatMap((name) => folders.map((folder) => join(folder, name)));
  return files.find((file) => {
    try {
      accessSync(file, constants.X_OK);
      return true;
    } catch {
      return false;
    }
  });
}

export const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Processor seconds of a process, of all that it started, and of those of them that have ended: what else the machine does is not in it. */
export function processorSeconds(root) {
  const stats = new Map();
  for (const name of readdirSync('/proc').filter((one) => /^\d+$/.test(one)))
    try {
      const words = readFileSync(`/proc/${name}/stat`, 'utf8').replace(/^.*\) /s, '').split(' ');
      stats.set(Number(name), { parent: Number(words[1]), ticks: words.slice(11, 15).reduce((sum, word) => sum + Number(word), 0) });
    } catch { /* it has ended */ }
  const mine = (process) => process === root || (stats.has(process) && mine(stats.get(process).parent));
  return [...stats].filter(([process]) => mine(process)).reduce((sum, [, { ticks }]) => sum + ticks / 100, 0);
}

export class Browser {
  constructor(extra = []) {
    this.folder = mkdtempSync(join(tmpdir(), 'flank-clients-'));
    const root = process.getuid?.() === 0 ? ['--no-sandbox'] : [];
    this.process = spawn(findBrowser(), [...FLAGS, ...root, ...extra, `--user-data-dir=${this.folder}`, 'about:blank'],
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    this.waiting = new Map();
    this.pages = new Map();
    this.count = 0;
    let text = '';
    this.process.stdio[4].setEncoding('utf8').on('data', (chunk) => {
      const parts = (text + chunk).split('\0');
      text = parts.pop();
      parts.forEach((part) => this.receive(JSON.parse(part)));
    });
  }

  receive(message) {
    if (!message.id) return this.pages.get(message.sessionId)?.happened(message);
    const { resolve, reject } = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    message.error ? reject(new Error(message.error.message)) : resolve(message.result);
  }

  send(method, params = {}, sessionId = undefined) {
    const id = ++this.count;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }

  /** A page of a file or an address, opened in a window of a size; waits until the page says that it is ready. */
  async open(file, { width = 1400, height = 900, media = [], hash = '' } = {}) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank', newWindow: true });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const page = new Page(this, sessionId, targetId);
    this.pages.set(sessionId, page);
    for (const domain of ['Page', 'Runtime', 'Network', 'Log']) await page.send(`${domain}.enable`);
    await page.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
    await page.send('Emulation.setEmulatedMedia', { features: media });
    await page.send('Page.navigate', { url: `${/^http:/.test(file) ? '' : 'file://'}${file}${hash}` });
    await page.until('document.documentElement?.dataset.ready !== undefined', 60);
    return page;
  }

  async close() {
    const gone = new Promise((resolve) => this.process.once('exit', resolve));
    const stuck = setTimeout(() => this.process.kill('SIGKILL'), 5000);
    this.send('Browser.close').catch(() => this.process.kill());
    await gone;
    clearTimeout(stuck);
    // Its helpers end a little later than the browser, and write until they do.
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 150, retryDelay: 100 });
  }
}

class Page {
  constructor(browser, sessionId, targetId) {
    Object.assign(this, { browser, sessionId, targetId, complaints: [], requests: [] });
  }

  send(method, params) {
    return this.browser.send(method, params, this.sessionId);
  }

  happened({ method, params }) {
    if (method === 'Runtime.exceptionThrown') this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type))
      this.complaints.push(params.args.map((a) => a.value ?? a.description).join(' '));
    if (method === 'Log.entryAdded' && params.entry.level === 'error') this.complaints.push(params.entry.text);
    if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
  }

  /** The value of an expression in the page. */
  async value(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  async until(expression, seconds = 10) {
    const end = Date.now() + 1000 * seconds;
    while (!(await this.value(`(async () => Boolean(await (${expression})))()`))) {
      if (Date.now() > end) throw new Error(`never came true: ${expression}\n${this.complaints.join('\n')}`);
      await sleep(50);
    }
  }

  async key(key, code = key) {
    const codes = { ArrowRight: 39, ArrowLeft: 37, ArrowUp: 38, Home: 36, End: 35, ' ': 32, Tab: 9 };
    const event = { key, code, windowsVirtualKeyCode: codes[key] ?? 0, text: key === ' ' ? ' ' : undefined };
    await this.send('Input.dispatchKeyEvent', { type: 'keyDown', ...event });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', ...event, text: undefined });
  }

  async click(selector) {
    const [x, y] = await this.value(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.scrollIntoView({ block: 'center' });
      const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()`);
    await this.press(x, y);
  }

  /** A click at a place of the window; `shift`: with the key held. */
  async press(x, y, shift = false) {
    for (const type of ['mousePressed', 'mouseReleased'])
      await this.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', clickCount: 1, modifiers: shift ? 8 : 0 });
  }

  /** Another size of the window, and other wishes of who looks. */
  async resize({ width, height, media = [] }) {
    await this.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
    await this.send('Emulation.setEmulatedMedia', { features: media });
    await this.frames();
  }

  move(x, y) {
    return this.send('Input.dispatchMouseEvent', { type: 'mouseMoved', x, y });
  }

  /** Files of the machine dropped at a place of the window. */
  async drop(x, y, ...files) {
    const data = { items: [], files, dragOperationsMask: 1 };
    for (const type of ['dragEnter', 'dragOver', 'drop']) await this.send('Input.dispatchDragEvent', { type, x, y, data });
  }

  /** A picture of the window as bytes of a PNG. */
  async picture() {
    return Buffer.from((await this.send('Page.captureScreenshot', { format: 'png' })).data, 'base64');
  }

  /** Two frames: what was asked to be drawn is drawn. */
  frames() {
    return this.value('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))');
  }

  close() {
    this.browser.pages.delete(this.sessionId);
    return this.browser.send('Target.closeTarget', { targetId: this.targetId });
  }
}
