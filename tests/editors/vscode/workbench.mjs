// A VS Code in a throw-away home: code-server, and a headless Chromium that shows it. All waiting is for conditions.
import { execFileSync, spawn } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { createServer } from 'node:net';
import { dirname, join } from 'node:path';

const require = createRequire(join(process.env.SDLC_NODE_MODULES, 'any.js'));
const puppeteer = require('puppeteer-core');

/** Generous: it only ends a check that would fail anyway. */
export const PATIENCE_MS = 30_000;

const USER_SETTINGS = {
  'editor.minimap.enabled': false,
  'files.simpleDialog.enable': true,
  'security.workspace.trust.startupPrompt': 'never',
  'telemetry.telemetryLevel': 'off',
  // Text of the page, not a picture.
  'terminal.integrated.gpuAcceleration': 'off',
  'workbench.enableExperiments': false,
  'workbench.startupEditor': 'none',
  'workbench.tips.enabled': false,
};

function freePort() {
  return new Promise((resolve, reject) => {
    const server = createServer().on('error', reject);
    server.listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** Tries `attempt` until its result is truthy. */
export async function until(what, attempt) {
  const end = Date.now() + PATIENCE_MS;
  for (;;) {
    const result = await attempt();
    if (result) return result;
    if (Date.now() > end) throw new Error(`never happened: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

export class Workbench {
  /**
   * @param {string} home a folder for everything
   * @param {{ vsix: string, path: string, isTrusting?: boolean, settings?: object }} options `path` is the PATH
   */
  static async start(home, { vsix, path, isTrusting = true, settings = {} }) {
    const bench = new Workbench();
    bench.home = home;
    bench.folder = join(home, 'scenes');
    // VS Code takes the PATH of a login shell.
    const env = { ...process.env, HOME: home, PATH: path, SHELL: '/bin/bash' };
    writeFileSync(join(home, '.bash_profile'), `export PATH='${path}'\n`);
    const data = ['--user-data-dir', join(home, 'data'), '--extensions-dir', join(home, 'extensions')];
    const entry = process.env.SDLC_CODE_SERVER;
    mkdirSync(join(home, 'data/User'), { recursive: true });
    mkdirSync(bench.folder, { recursive: true });
    writeFileSync(join(home, 'data/User/settings.json'), JSON.stringify({ ...USER_SETTINGS, ...settings }));
    execFileSync('node', [entry, ...data, '--install-extension', vsix], { env, stdio: 'pipe' });

    const port = await freePort();
    const flags = ['--auth', 'none', '--bind-addr', `127.0.0.1:${port}`, ...data, '--disable-telemetry',
      '--disable-update-check', ...(isTrusting ? ['--disable-workspace-trust'] : [])];
    bench.server = spawn('node', [entry, ...flags, bench.folder], { env, stdio: 'pipe', detached: true });
    bench.log = '';
    for (const stream of [bench.server.stdout, bench.server.stderr]) stream.on('data', (text) => (bench.log += text));
    await until('code-server listens', () => bench.log.includes('HTTP server listening'));

    bench.browser = await puppeteer.launch({
      executablePath: process.env.CHROMIUM,
      args: ['--no-sandbox', '--disable-gpu', '--window-size=1280,800'],
      defaultViewport: { width: 1280, height: 800 },
      userDataDir: join(home, 'chromium'),
      env: { ...process.env, HOME: home },
    });
    bench.page = await bench.browser.newPage();
    bench.page.setDefaultTimeout(PATIENCE_MS);
    await bench.page.goto(`http://127.0.0.1:${port}/?folder=${bench.folder}`);
    await bench.page.waitForSelector('.explorer-folders-view .monaco-list');
    return bench;
  }

  async stop() {
    await this.browser?.close();
    // The group: code-server has processes of its own.
    try {
      process.kill(-this.server.pid, 'SIGTERM');
    } catch {
      // It has ended.
    }
  }

  /** Adds to the settings of the workspace, in the file, which VS Code watches. */
  settings(more) {
    this.workspaceSettings = { ...this.workspaceSettings, ...more };
    this.write('.vscode/settings.json', JSON.stringify(this.workspaceSettings, null, 2));
  }

  file(name) {
    return join(this.folder, name);
  }

  write(name, text) {
    mkdirSync(dirname(this.file(name)), { recursive: true });
    writeFileSync(this.file(name), text);
  }

  read(name) {
    return readFileSync(this.file(name), 'utf8');
  }

  // Keys and text. `press('Control+Shift+o')` holds the keys before the last.
  async press(...chords) {
    for (const chord of chords) {
      const keys = chord.split('+');
      for (const key of keys.slice(0, -1)) await this.page.keyboard.down(key);
      await this.page.keyboard.press(keys.at(-1));
      for (const key of keys.slice(0, -1).reverse()) await this.page.keyboard.up(key);
    }
  }

  type(text) {
    return this.page.keyboard.type(text);
  }

  // Conditions of the page.
  see(selector) {
    return until(`to see ${selector}`, () => this.isVisible(selector));
  }

  gone(selector) {
    return until(`the end of ${selector}`, async () => !(await this.isVisible(selector)));
  }

  async isVisible(selector) {
    for (const element of await this.page.$$(selector)) {
      if (await element.isVisible()) return true;
    }
    return false;
  }

  texts(selector) {
    return this.page.$$eval(selector, (found) => found.map((element) => element.textContent.replaceAll('\u00a0', ' ')));
  }

  /** Waits for an element of `selector` whose text contains `text`; resolves to its text. */
  seeText(selector, text) {
    return until(`${selector} with ${text}`, async () => (await this.texts(selector)).find((found) => found.includes(text)));
  }

  /** Waits until `holds(document)` is true in a frame of a web view, such as a preview. */
  seeInWebview(what, holds) {
    return until(`a web view with ${what}`, async () => {
      for (const frame of this.page.frames()) {
        try {
          if (await frame.evaluate(`(${holds})(document)`)) return true;
        } catch {
          // The frame is gone.
        }
      }
      return false;
    });
  }

  /** Clicks the first element of `selector` whose text contains `text`. */
  async click(selector, text = '', options = {}) {
    const box = await until(`${selector} with ${text}`, async () => {
      for (const candidate of await this.page.$$(selector)) {
        const content = await candidate.evaluate((node) => node.textContent.replaceAll('\u00a0', ' '));
        const place = content.includes(text) && (await candidate.boundingBox());
        if (place) return place;
      }
      return undefined;
    });
    await this.page.mouse.click(box.x + box.width / 2, box.y + box.height / 2, options);
  }

  /** Opens the input at the top by a key; again while nobody listens to keys yet. */
  quickInput(key) {
    return until(`${key} opens an input`, async () => {
      await this.press(key);
      return this.page.waitForSelector('.quick-input-box input', { visible: true, timeout: 2000 })
        .catch(() => undefined);
    });
  }

  /** Runs a command of the palette, by its title. */
  async command(title) {
    await this.quickInput('F1');
    await this.type(title);
    await this.click('.quick-input-list .monaco-list-row', title);
  }

  /** Closes all editors. What the active one has not saved is lost; no check leaves another. */
  async closeAll() {
    const isDirty = () => this.page.$('.tab.active.dirty');
    if (await isDirty()) {
      await this.command('View: Revert and Close Editor');
      await until('the editor is closed', async () => !(await isDirty()));
    }
    await this.command('View: Close All Editors');
  }

  /** Writes a file and opens it; waits until its text is shown. */
  async open(name, text) {
    if (text !== undefined) this.write(name, text);
    await this.closeAll();
    await this.quickInput('Control+p');
    await this.type(this.file(name));
    await this.seeText('.quick-input-list .monaco-list-row.focused', name);
    await this.press('Enter');
    await this.see(`.tab.active[data-resource-name="${name}"]`);
    await this.see('.monaco-editor .view-line');
  }

  /** Puts the cursor at a line and column, both from 1. */
  async goto(line, column) {
    await this.quickInput('Control+g');
    await this.type(`${line}:${column}`);
    await this.press('Enter');
    await this.gone('.quick-input-widget');
    await this.seeText('.statusbar-item', `Ln ${line}, Col ${column}`);
  }

  /** The text of the active editor as shown: as many lines as the window has. */
  async text() {
    const lines = await this.page.$$eval('.editor-instance .view-lines .view-line', (found) =>
      found
        .map((line) => [parseFloat(line.style.top), line.textContent.replaceAll('\u00a0', ' ')])
        .sort((a, b) => a[0] - b[0])
        .map((line) => line[1]));
    return lines.join('\n');
  }

  /** Saves the active file, and waits until its text on the disk satisfies a condition. */
  async saved(name, what, condition) {
    return until(`${name}: ${what}`, async () => {
      // Also a change that comes after the first time.
      if (await this.page.$('.tab.active.dirty')) await this.press('Control+s');
      return condition(this.read(name)) && this.read(name);
    });
  }

  /** Closes whatever a failed check left open. */
  async reset() {
    await this.press('Escape', 'Escape', 'Escape');
    await this.closeAll().catch(() => {});
  }

  /** Copies the logs of VS Code, with that of the extension, to the screenshots. */
  saveLogs(name) {
    cpSync(join(this.home, 'data/logs'), join(process.env.SDLC_SCREENS, `logs-${name}`), { recursive: true });
  }

  async screenshot(name) {
    await this.page.screenshot({ path: join(process.env.SDLC_SCREENS, `${name}.png`) });
  }
}
