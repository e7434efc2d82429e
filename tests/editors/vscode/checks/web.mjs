// The extension for browsers: the checks of the other one that need no program, and these.
import { until } from '../workbench.mjs';
import { seePreview } from './commands.mjs';
import { BALL, MATERIALS, USER, scene } from './scenes.mjs';

export const shared = ({ name }) => /Explain|Check This File in|Show Log/.test(name);

const color = (frame) =>
  frame.evaluate("[...picture.image.getContext('2d').getImageData(0, 0, 1, 1).data].join()");

export const checks = [
  {
    name: 'the preview shows what is typed, the cursor, and the place of a click',
    async run(bench) {
      await bench.open('preview.scene', scene('background { color: white }', BALL.replace('diffuse', 'unlit')));
      await bench.command('sdlc: Preview Beside');
      const frame = await seePreview(bench);
      await bench.goto(5, 10);
      await until('an outline', () => frame.evaluate('outline?.rows.length > 0'));
      await bench.goto(4, 1);
      await until('no outline', () => frame.evaluate('outline.rows.length === 0'));
      await bench.screenshot('web-preview');
      const canvas = await frame.$('#canvas');
      await canvas.click(); // in the middle is the ball
      await bench.seeText('.statusbar-item', 'Ln 5, Col 1');

      await bench.goto(4, 21);
      await bench.press('Shift+End');
      await bench.type('#0000ff }');
      await until('the text that is not saved', async () => (await color(frame)) === '0,0,255,255');
      await bench.press('Shift+Home');
      await bench.type('background { colour: red }');
      await until('a finding', () =>
        frame.evaluate("document.getElementById('findings').innerText.includes('did you mean `color`')"));
      await bench.screenshot('web-preview-broken');
      await bench.command('File: Revert File');
      await until('the saved text', async () => (await color(frame)) === '255,255,255,255');
      await bench.command('View: Close Editors in Other Groups');
    },
  },
  {
    name: 'the preview has the choices of a scene',
    async run(bench) {
      await bench.open('choices.scene', scene('param blue = 0', 'background { color: rgb(0, 0, 255 * blue) }', BALL));
      await bench.command('sdlc: Preview Beside');
      const frame = await seePreview(bench);
      await frame.evaluate('choose({ params: { blue: "1" } })');
      await until('another background', async () => (await color(frame)) === '0,0,255,255');
      await bench.screenshot('web-choices');
    },
  },
  {
    name: 'the code lens of a camera shows what it sees',
    async run(bench) {
      const other = 'camera other { from: (0, 1, -5), at: (0, 0, 0), fov: 40deg }';
      await bench.open('lens.scene', scene(other, BALL));
      await until('two of them', async () => (await bench.texts('.codelens-decoration a')).length === 2);
      const lenses = await bench.page.$$('.codelens-decoration a');
      await lenses[1].click();
      const frame = await seePreview(bench);
      await until('the camera', () => frame.evaluate("document.getElementById('camera').value === 'other'"));
    },
  },
  {
    name: 'an import is read, and a change of its file',
    async run(bench) {
      bench.write('materials.scene', MATERIALS.replace('let brass', 'let bronze'));
      await bench.open('user.scene', USER.replace('materials', 'nowhere'));
      await bench.see('.squiggly-error');
      await bench.goto(4, 12);
      await bench.press('Control+k', 'Control+i');
      await bench.seeText('.monaco-hover', `cannot read \`${bench.file('nowhere.scene')}\``);
      await bench.open('user.scene', USER);
      await bench.see('.squiggly-error');
      bench.write('materials.scene', MATERIALS);
      await bench.gone('.squiggly-error');
    },
  },
  {
    name: 'a data file is read, also one that is written later',
    async run(bench) {
      await bench.open('data.scene',
        scene('import "points.csv" as points', 'for p in points { sphere { center: (p.x, 0, 0), radius: 1 } }'));
      await bench.see('.squiggly-error');
      bench.write('points.csv', 'x\n1\n3\n');
      await bench.gone('.squiggly-error');
    },
  },
  {
    name: 'commands that need a program are not offered',
    async run(bench) {
      await bench.open('ball.scene', scene(BALL));
      await bench.quickInput('F1');
      await bench.type('sdlc: ');
      await bench.seeText('.quick-input-list .monaco-list-row', 'sdlc: Preview Beside');
      const offered = (await bench.texts('.quick-input-list .monaco-list-row')).join('\n');
      await bench.screenshot('web-commands');
      await bench.press('Escape');
      if (/sdlc: (Render|Measure)/.test(offered)) throw new Error(`offered: ${offered}`);
      if (bench.calls().length > 0) throw new Error(`the program was run: ${bench.calls()}`);
    },
  },
];
