// What shows a scene: hover, colours, hints, outline, folds.
import { until } from '../workbench.mjs';
import { BALL, scene } from './scenes.mjs';

export const checks = [
  {
    name: 'hover shows the value of a name',
    async run(bench) {
      await bench.open('values.scene', scene('let a = 2 * pi', BALL));
      await bench.goto(4, 5);
      await bench.press('Control+k', 'Control+i');
      await bench.seeText('.monaco-hover', '6.283');
    },
  },
  {
    name: 'hover explains a property',
    async run(bench) {
      await bench.open('values.scene', scene(BALL));
      await bench.goto(4, 36);
      await bench.press('Control+k', 'Control+i');
      await bench.seeText('.monaco-hover', 'From the centre to the surface');
    },
  },
  {
    name: 'the colour picker keeps the spelling',
    async run(bench) {
      await bench.open('colors.scene', scene(BALL.replace('tan', '#d2b48c')));
      await bench.click('.colorpicker-color-decoration');
      await bench.see('.colorpicker-widget .saturation-box');
      const box = await (await bench.page.$('.colorpicker-widget .saturation-box')).boundingBox();
      await bench.page.mouse.click(box.x + box.width - 20, box.y + 20);
      await bench.screenshot('color-picker');
      await bench.press('Escape');
      await bench.saved('colors.scene', 'has another colour in hexadecimal',
        (text) => /diffuse\(color: #(?!d2b48c)[0-9a-f]{6}\)/.test(text));
    },
  },
  {
    name: 'semantic tokens colour names by their meaning',
    async run(bench) {
      await bench.open('tokens.scene', scene('let glass = transmissive(ior: 1.5)', BALL.replace('diffuse(color: tan)', 'glass')));
      await bench.goto(5, 57);
      await bench.command('Developer: Inspect Editor Tokens and Scopes');
      await bench.seeText('.token-inspect-widget', 'semantic token type');
      await bench.screenshot('semantic-token');
      await bench.press('Escape');
    },
  },
  {
    name: 'inlay hints appear when they are switched on, and vanish',
    async run(bench) {
      await bench.open('hints.scene', scene('let a = 2 * pi', BALL));
      const lineOfValue = async () => (await bench.text()).split('\n')[3];
      await until('the text', async () => (await lineOfValue()) === 'let a = 2 * pi');
      bench.settings({ 'sdlc.inlayHints': true });
      await until('a hint', async () => (await lineOfValue()).includes('6.28'));
      await bench.screenshot('inlay-hints');
      bench.settings({ 'sdlc.inlayHints': false });
      await until('no hint', async () => (await lineOfValue()) === 'let a = 2 * pi');
    },
  },
  {
    name: 'the outline lists objects and names',
    async run(bench) {
      await bench.open('outline.scene', scene('let size = 1', 'def pair(gap: number) {', '  sphere { center: (gap, 0, 0), radius: size }', '}', BALL));
      await bench.command('Explorer: Focus on Outline View');
      for (const name of ['main', 'size', 'pair', 'ball']) {
        await bench.seeText('.outline-tree .monaco-list-row', name);
      }
    },
  },
  {
    name: 'blocks fold',
    async run(bench) {
      await bench.open('folds.scene', scene('sphere {', '  center: (0, 0, 0)', '  radius: 1', '}', '', '/* a', 'comment', '*/'));
      await bench.command('Fold All');
      await until('folded lines', async () => {
        const text = await bench.text();
        return !text.includes('center') && !text.includes('comment') && text.includes('sphere {');
      });
      await bench.screenshot('folds');
      await bench.command('Unfold All');
    },
  },
  {
    name: 'the name of an imported file is a link',
    async run(bench) {
      await bench.write('materials.scene', 'scene 1\nlet a = 1\n');
      await bench.open('link.scene', scene('import "materials.scene" as mat'));
      await bench.see('.detected-link');
    },
  },
];
