// The commands of the palette and of the code lens.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

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

/** The frame of the preview, once it has a finished picture. */
export function seePreview(bench) {
  return until('a preview', async () => {
    for (const frame of bench.page.frames()) {
      try {
        if (await frame.evaluate('Boolean(picture?.header.is_finished)')) return frame;
      } catch {
        // Another frame, or one that is gone.
      }
    }
    return undefined;
  });
}

/** The programs that serve pages of this workbench. */
function previews(bench) {
  return readdirSync('/proc').filter((process) => {
    try {
      const [, command, scene] = readFileSync(join('/proc', process, 'cmdline'), 'utf8').split('\0');
      return command === 'serve' && scene.startsWith(bench.folder);
    } catch {
      return false;
    }
  });
}

export const checks = [
  {
    name: 'the command Preview Beside shows what is typed, the cursor, and the place of a click',
    async run(bench) {
      const before = previews(bench).length;
      await bench.open('preview.scene', scene('background { color: white }', BALL.replace('diffuse', 'unlit')));
      await bench.command('sdlc: Preview Beside');
      const frame = await seePreview(bench);
      await bench.goto(5, 10);
      await until('an outline', () => frame.evaluate('outline?.rows.length > 0'));
      await bench.goto(4, 1);
      await until('no outline', () => frame.evaluate('outline.rows.length === 0'));
      await bench.screenshot('preview');
      await bench.command('sdlc: Restart Server');
      const old = frame.url();
      const again = await until('the page of the new server', async () => {
        const now = await seePreview(bench);
        return now.url() === old ? undefined : now;
      });
      const canvas = await again.$('#canvas');
      await canvas.click();  // in the middle is the ball
      await bench.seeText('.statusbar-item', 'Ln 5, Col 1');

      await bench.goto(4, 21);
      await bench.press('Shift+End');
      await bench.type('#0000ff }');
      await until('the text that is not saved', () =>
        again.evaluate("picture.header.scene === 2 && [...picture.image.getContext('2d').getImageData(0, 0, 1, 1).data].join() === '0,0,255,255'"));
      await bench.press('Shift+Home');
      await bench.type('background { colour: red }');
      await until('a finding', () => again.evaluate("document.getElementById('findings').innerText.includes('did you mean `color`')"));
      await bench.screenshot('preview-broken');

      await bench.command('View: Close Editors in Other Groups');
      await bench.command('File: Revert File');
      await until('the end of the program', () => previews(bench).length === before);
    },
  },
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
