// The commands of the palette and of the code lens.
import { until } from '../workbench.mjs';
import { BALL, MATERIALS, USER, scene } from './scenes.mjs';

/** The picture, in an editor beside the scene. */
async function seePicture(bench) {
  await until('a picture', async () => {
    const tabs = await bench.page.$$eval('.tab', (found) => found.map((tab) => tab.dataset.resourceName));
    return tabs.some((name) => name?.endsWith('.png'));
  });
  await bench.seeInWebview('a picture', (document) => [...document.images].some((image) => image.naturalWidth === 32));
  await bench.screenshot('picture');
}

export const checks = [
  {
    name: 'the code lens of a camera renders',
    async run(bench) {
      await bench.open('lens.scene', scene(BALL));
      await bench.click('.codelens-decoration a', 'Render');
      await seePicture(bench);
    },
  },
  {
    name: 'the command Render renders',
    async run(bench) {
      await bench.open('command.scene', scene(BALL));
      await bench.command('sdlc: Render');
      await seePicture(bench);
    },
  },
  {
    name: 'the command Measure runs in a terminal',
    async run(bench) {
      await bench.open('ball.scene', scene(BALL));
      await bench.command('sdlc: Measure Error Against Time');
      await until('sdlc measure', () => bench.calls().some((call) => call.startsWith(`measure ${bench.file('ball.scene')}`)));
      await bench.seeText('.terminal .xterm-rows', 'ball.scene');
    },
  },
  {
    name: 'the command Explain lists the codes of the file first',
    async run(bench) {
      await bench.open('ball.scene', scene(BALL.replace('radius', 'radus')));
      await bench.see('.squiggly-error');
      await bench.goto(4, 35);
      await bench.command('sdlc: Explain a Diagnostic');
      await bench.seeText('.quick-input-list .monaco-list-row.focused', 'E104');
      await bench.press('Enter');
      await bench.seeText('.tab.active', 'E104');
      await bench.seeInWebview('the page', (document) => document.body?.innerText.toLowerCase().includes('unknown property'));
    },
  },
  {
    name: 'the command Check This File in… offers the scenes that import it',
    async run(bench) {
      bench.write('user.scene', USER);
      bench.write('other.scene', USER);
      await bench.open('materials.scene', MATERIALS);
      await bench.command('sdlc: Check This File in…');
      await until('both scenes', async () => {
        const shown = (await bench.texts('.quick-input-list .monaco-list-row, .notification-toast')).join('\n');
        return shown.includes('user.scene') && shown.includes('other.scene');
      });
      await bench.press('Escape');
    },
  },
  {
    name: 'the command Restart Server starts another one',
    async run(bench) {
      const servers = () => bench.calls().filter((call) => call.startsWith('lsp')).length;
      const before = servers();
      await bench.open('ball.scene', scene(BALL.replace('radius', 'radus')));
      await bench.command('sdlc: Restart Server');
      await until('another server', () => servers() === before + 1);
      await bench.see('.squiggly-error');
    },
  },
  {
    name: 'the command Show Log shows it, and the trace the protocol',
    async run(bench) {
      bench.settings({ 'sdlc.trace.server': 'messages' });
      await bench.open('ball.scene', scene(BALL));
      await bench.command('sdlc: Show Log');
      await bench.seeText('.output-view-content .view-line, .panel .view-line', 'textDocument/');
      bench.settings({ 'sdlc.trace.server': 'off' });
      await bench.command('View: Hide Panel');
    },
  },
];
