// The studio as a process, for the tests.
import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { BINARY } from './folder.mjs';

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
