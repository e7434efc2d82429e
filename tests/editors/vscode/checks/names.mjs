// What follows names, also across files.
import { until } from '../workbench.mjs';
import { MATERIALS, USER } from './scenes.mjs';

async function openBoth(bench) {
  bench.write('materials.scene', MATERIALS);
  await bench.open('user.scene', USER);
  // The column of `brass` after `material: mat.`
  await bench.goto(5, USER.split('\n')[4].indexOf('brass') + 2);
}

async function renameTo(bench, name) {
  await bench.press('F2');
  await until('the box for the name', () => bench.page.evaluate(() => Boolean(document.activeElement?.closest('.rename-box'))));
  await bench.press('Control+a');
  await bench.type(name);
  await bench.press('Enter');
}

export const checks = [
  {
    name: 'go to definition opens the other file',
    async run(bench) {
      await openBoth(bench);
      await bench.press('F12');
      await bench.see('.tab.active[data-resource-name="materials.scene"]');
      await bench.seeText('.statusbar-item', 'Ln 3, Col 5');
    },
  },
  {
    name: 'references list all uses',
    async run(bench) {
      await openBoth(bench);
      await bench.press('Shift+F12');
      await bench.see('.reference-zone-widget');
      await bench.seeText('.reference-zone-widget .head', '3');
    },
  },
  {
    name: 'rename changes both files',
    async run(bench) {
      await openBoth(bench);
      await renameTo(bench, 'polished_brass');
      await until('the new name', async () => (await bench.text()).includes('mat.polished_brass'));
      await bench.command('File: Save All');
      const renamed = (text) => text.replaceAll('brass =', 'polished_brass =').replaceAll('mat.brass', 'mat.polished_brass');
      await until('both files', () => bench.read('user.scene') === renamed(USER) && bench.read('materials.scene') === renamed(MATERIALS));
    },
  },
  {
    name: 'rename refuses a name that clashes, with the reason',
    async run(bench) {
      bench.write('materials.scene', MATERIALS);
      await bench.open('clash.scene', 'scene 1\nlet one = 1\nlet two = one + 1\n');
      await bench.goto(2, 5);
      await renameTo(bench, 'two');
      await until('a reason', async () => {
        const shown = [...(await bench.texts('.monaco-editor-overlaymessage')), ...(await bench.texts('.notification-toast'))];
        return shown.some((text) => text.includes('two'));
      });
    },
  },
];
