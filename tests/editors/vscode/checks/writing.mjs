// What helps while a scene is written: findings, fixes, completion, layout.
import { BALL, scene } from './scenes.mjs';

const RADUS = scene(BALL.replace('radius', 'radus'));

async function completions(bench, what) {
  await bench.seeText('.suggest-widget .monaco-list-row .label-name', what);
  return bench.texts('.suggest-widget .monaco-list-row .label-name');
}

export const checks = [
  {
    name: 'squiggles show findings of an opened file',
    async run(bench) {
      await bench.open('ball.scene', RADUS);
      await bench.see('.squiggly-error');
      await bench.see('.monaco-editor .cdr.squiggly-error');
    },
  },
  {
    name: 'squiggles follow the text while it is typed',
    async run(bench) {
      await bench.open('typed.scene', scene(BALL));
      await bench.goto(5, 1);
      await bench.type('let wrong = lenght((1, 2, 3))');
      await bench.see('.squiggly-error');
      for (let i = 0; i < 10; ++i) await bench.press('Control+z');
      await bench.gone('.squiggly-error');
    },
  },
  {
    name: 'the code of a finding opens the page that explains it',
    async run(bench) {
      await bench.open('ball.scene', RADUS);
      await bench.see('.squiggly-error');
      await bench.goto(4, 35);
      await bench.press('Control+k', 'Control+i');
      await bench.seeText('.monaco-hover', 'unknown property');
      await bench.click('.monaco-hover a', 'E104');
      await bench.seeText('.tab.active', 'E104');
      await bench.seeInWebview('the page', (document) => document.body?.innerText.toLowerCase().includes('unknown property'));
    },
  },
  {
    name: 'a quick fix replaces a misspelt property',
    async run(bench) {
      await bench.open('ball.scene', RADUS);
      await bench.see('.squiggly-error');
      await bench.goto(4, 35);
      await bench.press('Control+.');
      await bench.click('.action-widget .monaco-list-row', 'radius');
      await bench.gone('.squiggly-error');
      await bench.saved('ball.scene', 'is fixed', (text) => text === scene(BALL));
    },
  },
  {
    name: 'fix all applies all safe fixes, and no guess',
    async run(bench) {
      const slips = BALL.replace('center:', 'center =').replace('radius:', 'radius =');
      await bench.open('slips.scene', scene(slips, 'let a = lenght((1, 2, 3))'));
      await bench.see('.squiggly-error');
      await bench.command('sdlc: Fix All Safe Findings');
      await bench.saved('slips.scene', 'is fixed', (text) => text === scene(BALL, 'let a = lenght((1, 2, 3))'));
    },
  },
  {
    name: 'source.fixAll of VS Code applies them too',
    async run(bench) {
      await bench.open('slips.scene', scene(BALL.replace('radius:', 'radius =')));
      await bench.see('.squiggly-error');
      await bench.command('Fix All');
      await bench.saved('slips.scene', 'is fixed', (text) => text === scene(BALL));
    },
  },
  {
    name: 'an allowance is a quick fix of a warning',
    async run(bench) {
      await bench.open('zero.scene', scene(BALL.replace('radius: 1', 'radius: 0')));
      await bench.see('.squiggly-warning');
      await bench.goto(4, 35);
      await bench.press('Control+.');
      await bench.click('.action-widget .monaco-list-row', 'llow');
      await bench.saved('zero.scene', 'has an allowance', (text) => text.includes('// sdlc: allow(W402)'));
    },
  },
  {
    name: 'completion offers kinds',
    async run(bench) {
      await bench.open('kinds.scene', scene(BALL));
      await bench.goto(5, 1);
      await bench.type('sp');
      const labels = await completions(bench, 'sphere');
      if (labels.some((label) => label === 'radius')) throw new Error(`radius is no kind: ${labels}`);
    },
  },
  {
    name: 'completion offers properties, and inserts them',
    async run(bench) {
      await bench.open('properties.scene', scene('sphere {', '  center: (0, 0, 0)', '  ', '}'));
      await bench.goto(6, 3);
      await bench.type('ra');
      await completions(bench, 'radius');
      await bench.press('Enter');
      await bench.saved('properties.scene', 'has a radius', (text) => /\n {2}radius: /.test(text));
    },
  },
  {
    name: 'completion offers the words of a property',
    async run(bench) {
      await bench.open('words.scene', 'scene 1\nrender { tone:  }\n');
      await bench.goto(2, 16);
      await bench.press('Control+ ');
      const labels = await completions(bench, 'sqrt');
      for (const word of ['srgb', 'linear', 'neutral']) {
        if (!labels.includes(word)) throw new Error(`no ${word} in ${labels}`);
      }
      if (labels.length > 4) throw new Error(`more than words: ${labels}`);
    },
  },
  {
    name: 'a snippet becomes a scene without findings',
    async run(bench) {
      await bench.open('new.scene', '');
      await bench.type('scene');
      await completions(bench, 'scene');
      await bench.press('Tab');
      await bench.press('Escape');
      await bench.saved('new.scene', 'is a scene', (text) => text.startsWith('scene 1\n'));
      await bench.gone('.squiggly-error');
    },
  },
  {
    name: 'a snippet of the extension is offered where a statement begins',
    async run(bench) {
      await bench.open('orbit.scene', scene());
      await bench.goto(5, 1);
      await bench.type('orb');
      await completions(bench, 'orbit');
      await bench.press('Tab', 'Escape');
      await bench.saved('orbit.scene', 'has an orbit', (text) => text.includes('\n  center: 2 * (cos(around), 0, sin(around))\n'));
      await bench.gone('.squiggly-error');
    },
  },
  {
    name: 'signature help shows the parameters',
    async run(bench) {
      await bench.open('signature.scene', scene('let a = clamp'));
      await bench.goto(4, 14);
      await bench.type('(1, ');
      await bench.seeText('.parameter-hints-widget', 'clamp');
    },
  },
  {
    name: 'formatting gives the canonical layout',
    async run(bench) {
      await bench.open('layout.scene', scene(BALL.replace(/, /g, ' ,  ')));
      await bench.command('Format Document');
      await bench.saved('layout.scene', 'is formatted', (text) => text.includes('center: (0, 0, 0), radius: 1'));
    },
  },
  {
    name: 'a config is checked, once',
    async run(bench) {
      await bench.open('old.sdlc.json', '{ "image": { "width": 8, "heigth": 8, "color": [1, 2, 3] }, "spheres": [] }\n');
      await bench.see('.squiggly-error');
      await bench.command('View: Focus Problems');
      await bench.seeText('.markers-panel .monaco-list-row', 'heigth');
      const rows = await bench.texts('.markers-panel .monaco-list-row');
      if (rows.filter((row) => row.includes('heigth')).length !== 1) throw new Error(rows.join('; '));
      await bench.command('View: Hide Panel');
    },
  },
];
