// The commands of the palette and of the code lens.
import { existsSync, rmSync } from 'node:fs';
import { until } from '../workbench.mjs';
import { BALL, MATERIALS, USER, scene } from './scenes.mjs';

async function openForRender(bench) {
  rmSync(bench.file('picture.png'), { force: true });
  await bench.open('ball.scene', scene(BALL));
  return () => until('a picture', () => existsSync(bench.file('picture.png')));
}

export const checks = [
  {
    name: 'the code lens of a camera renders',
    async run(bench) {
      const rendered = await openForRender(bench);
      await bench.click('.codelens-decoration a', 'Render');
      await rendered();
    },
  },
  {
    name: 'the command Render renders',
    async run(bench) {
      const rendered = await openForRender(bench);
      await bench.command('sdlc: Render');
      await rendered();
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
