// Findings, and what is done about them.
import assert from 'node:assert/strict';
import { rmSync } from 'node:fs';
import { join } from 'node:path';
import { CAMERA, edited, editsFor } from '../client.mjs';

const BALL = 'sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }\n';
const RADUS = `scene 1\n${CAMERA}${BALL.replace('radius', 'radus')}`;

async function actions(client, at, only) {
  const found = await client.findings(at.name, (all) => all.length > 0);
  const context = { diagnostics: found, ...(only ? { only } : {}) };
  const range = found[0].range;
  return client.request('textDocument/codeAction', { textDocument: at.textDocument, range, context });
}

/** The edit of an action, which may be resolved first. */
async function editOf(client, action) {
  const resolved = action.edit || !action.data ? action : await client.request('codeAction/resolve', action);
  return resolved.edit;
}

export const checks = [
  {
    name: 'a finding has a place, a severity, a code and a source',
    async test(client) {
      client.open('a.scene', RADUS);
      const [finding] = await client.findings('a.scene', (all) => all.length > 0);
      assert.equal(finding.code, 'E104');
      assert.equal(finding.severity, 1);
      assert.equal(finding.source, 'sdlc');
      assert.deepEqual(finding.range, { start: { line: 2, character: 33 }, end: { line: 2, character: 38 } });
    },
  },
  {
    name: 'a finding has related places',
    async test(client) {
      client.open('a.scene', `scene 1\n${CAMERA}let a = 1\nlet a = 2\n`);
      const [finding] = await client.findings('a.scene', (all) => all.length > 0);
      assert.ok(finding.relatedInformation.length > 0);
    },
  },
  {
    name: 'diagnostics follow incremental changes',
    async test(client) {
      client.open('a.scene', RADUS);
      await client.findings('a.scene', (all) => all.length === 1);
      client.change('a.scene', { range: { start: { line: 2, character: 36 }, end: { line: 2, character: 36 } }, text: 'i' });
      await client.findings('a.scene', (all) => all.length === 0);
      client.change('a.scene', { text: RADUS });
      await client.findings('a.scene', (all) => all.length === 1);
    },
  },
  {
    name: 'diagnostics of many quick changes are those of the last',
    async test(client) {
      client.open('a.scene', `scene 1\n${CAMERA}${BALL}`);
      for (let i = 0; i <= 50; ++i) client.change('a.scene', { text: `scene 1\n${CAMERA}${BALL}let a = unknown${i}\n` });
      await client.findings('a.scene', (all) => all.some(({ message }) => message.includes('unknown50')));
      client.change('a.scene', { text: `scene 1\n${CAMERA}${BALL}` });
      await client.findings('a.scene', (all) => all.length === 0);
    },
  },
  {
    name: 'a closed file that nothing uses has no diagnostics',
    async test(client) {
      const { textDocument } = client.open('a.scene', RADUS);
      await client.findings('a.scene', (all) => all.length === 1);
      client.notify('textDocument/didClose', { textDocument });
      await client.findings('a.scene', (all) => all.length === 0);
    },
  },
  {
    name: 'a quick fix replaces a misspelt property',
    async test(client) {
      const at = { name: 'a.scene', ...client.open('a.scene', RADUS) };
      const all = await actions(client, at);
      const fix = all.find(({ kind, title }) => kind === 'quickfix' && title.includes('radius'));
      assert.ok(fix, JSON.stringify(all));
      const edit = await editOf(client, fix);
      assert.equal(edited(at.text, editsFor(edit, at.textDocument.uri)), RADUS.replace('radus', 'radius'));
    },
  },
  {
    name: 'fix all applies safe fixes',
    async test(client) {
      const slips = `scene 1\n${CAMERA}${BALL.replace('center:', 'center =').replace('radius:', 'radius =')}`;
      const at = { name: 'a.scene', ...client.open('a.scene', slips) };
      const all = await actions(client, at, ['source.fixAll']);
      assert.ok(all.every(({ kind }) => kind.startsWith('source.fixAll')), JSON.stringify(all));
      const edit = await editOf(client, all[0]);
      assert.equal(edited(at.text, editsFor(edit, at.textDocument.uri)), `scene 1\n${CAMERA}${BALL}`);
    },
  },
  {
    name: 'the command sdlc.fixAll sends the edit',
    async test(client) {
      const at = client.open('a.scene', `scene 1\n${CAMERA}${BALL.replace('radius:', 'radius =')}`);
      await client.request('workspace/executeCommand', { command: 'sdlc.fixAll', arguments: [{ uri: at.textDocument.uri }] });
      await client.until('an edit', () => client.edits.length > 0);
      assert.equal(edited(at.text, editsFor(client.edits[0], at.textDocument.uri)), `scene 1\n${CAMERA}${BALL}`);
    },
  },
  {
    name: 'a warning can be allowed at its place',
    async test(client) {
      const text = `scene 1\n${CAMERA}${BALL.replace('radius: 1', 'radius: 0')}`;
      const at = { name: 'a.scene', ...client.open('a.scene', text) };
      const allow = (await actions(client, at)).find(({ title }) => /llow/.test(title));
      const edit = await editOf(client, allow);
      const allowed = edited(at.text, editsFor(edit, at.textDocument.uri));
      assert.match(allowed, /\/\/ sdlc: allow\(W402\)/);
      client.change('a.scene', { text: allowed });
      await client.findings('a.scene', (all) => all.length === 0);
    },
  },
  {
    name: 'the command sdlc.explain gives the page of a code',
    async test(client) {
      const page = await client.request('workspace/executeCommand', { command: 'sdlc.explain', arguments: [{ code: 'E104' }] });
      assert.match(JSON.stringify(page) ?? '', /unknown property/i);
    },
  },
  {
    name: 'an open import wins over its file',
    async test(client) {
      client.write('library.scene', 'scene 1\nlet old = 1\n');
      client.open('library.scene', 'scene 1\nlet fresh = 1\n');
      client.open('a.scene', `scene 1\n${CAMERA}${BALL}import "library.scene" as l\nlet b = l.fresh\n`);
      const all = await client.checked('a.scene');
      assert.ok(all.every(({ severity }) => severity > 1), JSON.stringify(all));
    },
  },
  {
    name: 'a change of an open import is seen in the scene that imports it',
    async test(client) {
      client.write('library.scene', 'scene 1\nlet paint = diffuse(color: tan)\n');
      client.open('a.scene', `scene 1\nimport "library.scene" as l\n${CAMERA}${BALL.replace('diffuse(color: tan)', 'l.paint')}`);
      client.open('library.scene', 'scene 1\nlet paint = diffuse(color: tan)\n');
      assert.deepEqual(await client.checked('a.scene'), []);
      client.change('library.scene', { text: 'scene 1\nlet pant = diffuse(color: tan)\n' });
      await client.findings('a.scene', (all) => all.length > 0);
    },
  },
  {
    name: 'an imported file is checked in the scene that imports it',
    async test(client) {
      // The sphere is inside another one only in that scene.
      client.writeWatched('a.scene', `scene 1\n${CAMERA}${BALL}include "part.scene"\n`);
      client.open('part.scene', 'scene 1\nsphere { center: (0, 0, 0), radius: 0.5, material: diffuse(color: tan) }\n');
      await client.findings('part.scene', (all) => all.some(({ code }) => code === 'W408'));
    },
  },
  {
    name: 'the command sdlc.chooseScene offers the scenes that read a file',
    async test(client) {
      const user = `scene 1\n${CAMERA}include "part.scene"\n`;
      client.writeWatched('one.scene', user);
      client.writeWatched('two.scene', user);
      const { textDocument } = client.open('part.scene', 'scene 1\nsphere { center: (0, 0, 0), radius: 1, material: unlit(color: tan) }\n');
      let offered = [];
      client.choose = (actions) => {
        offered = actions;
        return actions.at(-1);
      };
      const all = await client.retry('the folder is read', async () => {
        await client.request('workspace/executeCommand', { command: 'sdlc.chooseScene', arguments: [{ uri: textDocument.uri }] });
        const all = offered.map(({ title }) => title).join();
        return all.includes('one.scene') && all.includes('two.scene') && all;
      });
      assert.match(all, /(one|two)\.scene \(now\)/);
    },
  },
  {
    name: 'a file that changes on the disk is read again',
    async test(client) {
      client.write('library.scene', 'scene 1\nlet paint = diffuse(color: tan)\n');
      client.open('a.scene', `scene 1\nimport "library.scene" as l\n${CAMERA}${BALL.replace('diffuse(color: tan)', 'l.paint')}`);
      assert.deepEqual(await client.checked('a.scene'), []);
      rmSync(join(client.folder, 'library.scene'));
      client.notify('workspace/didChangeWatchedFiles', { changes: [{ uri: client.uri('library.scene'), type: 3 }] });
      await client.findings('a.scene', (all) => all.length > 0);
    },
  },
  {
    name: '.sdlc.toml is read again when it changes',
    async test(client) {
      client.open('a.scene', `scene 1\n${CAMERA}${BALL.replace('radius: 1', 'radius: 0')}`);
      await client.findings('a.scene', (all) => all.length === 1);
      client.write('.sdlc.toml', '[lint]\nignore = ["W402"]\n');
      client.notify('workspace/didChangeWatchedFiles', { changes: [{ uri: client.uri('.sdlc.toml'), type: 1 }] });
      await client.findings('a.scene', (all) => all.length === 0);
    },
  },
  {
    name: 'a config is checked, with fixes',
    async test(client) {
      const text = '{ "image": { "width": 8, "heigth": 8, "color": [1, 2, 3] }, "saving": { "path": "a.png" } }\n';
      const at = { name: 'a.json', ...client.open('a.json', text) };
      const all = await actions(client, at);
      const fix = all.find(({ title }) => title.includes('height'));
      const edit = await editOf(client, fix);
      assert.equal(edited(text, editsFor(edit, at.textDocument.uri)), text.replace('heigth', 'height'));
    },
  },
  {
    name: 'broken texts of all kinds are checked without an end of the server',
    async test(client) {
      const texts = ['', '\uFEFF', '\uFEFFscene 1\n', 'scene 1\r\n', 'scene 1\r', 'scene', 'sphere {', '\u0000', '\u{1F30D}', '}'.repeat(300),
        '('.repeat(5000), 'scene 1\nlet a = "', 'scene 1\n/*', '{"', '\uD83C'];
      for (const [i, text] of texts.entries()) {
        client.open(`broken${i}.scene`, text);
        await client.checked(`broken${i}.scene`);
      }
    },
  },
];
