// Hover, colours, tokens, hints, symbols, folds, lenses.
import assert from 'node:assert/strict';
import { CAMERA, edited } from '../client.mjs';

const SCENE = `scene 1
${CAMERA}
/// Two balls.
def pair(gap: number) {
  sphere { center: (gap, 0, 0), radius: 1 }
  sphere { center: (-gap, 0, 0), radius: 1 }
}
let a = 2 * pi
fn double(x) = 2 * x
let b = double(a)
pair both { gap: b, material: diffuse(color: #fc0) }
`;

async function hover(client, marked, name = 'a.scene') {
  const { textDocument, position } = client.open(name, marked);
  const result = await client.request('textDocument/hover', { textDocument, position });
  return result?.contents.value ?? '';
}

export const checks = [
  {
    name: 'hover shows the value of a let',
    test: async (client) => assert.match(await hover(client, 'scene 1\nlet |a = 2 * pi\n'), /6\.283/),
  },
  {
    name: 'hover shows a colour in hexadecimal and linear',
    test: async (client) => {
      const text = await hover(client, 'scene 1\nlet c = |tan\n');
      assert.match(text, /#d2b48c/);
      assert.match(text, /linear\(/);
    },
  },
  {
    name: 'hover explains a property',
    test: async (client) => assert.match(await hover(client, 'scene 1\nsphere { |radius: 1 }\n'), /From the centre to the surface/),
  },
  {
    name: 'hover shows the comment of a declaration',
    test: async (client) => assert.match(await hover(client, SCENE.replace('pair both', '|pair both')), /Two balls/),
  },
  {
    name: 'hover explains the code of an allowance',
    test: async (client) =>
      assert.match(await hover(client, 'scene 1\n// sdlc: allow(W|402) later\nsphere { center: (0, 0, 0), radius: 0 }\n'), /W402/),
  },
  {
    name: 'hover explains a key of a config',
    test: async (client) => assert.match(await hover(client, '{ "camera": { "|vfov": 40 } }', 'a.json'), /angle of view/),
  },
  {
    name: 'colours have swatches, and their presentations keep the spelling',
    async test(client) {
      const { textDocument, text } = client.open('a.scene', 'scene 1\nlet c = #fc0\nlet d = rgb(255, 0, 0)\n');
      const colors = await client.request('textDocument/documentColor', { textDocument });
      assert.equal(colors.length, 2);
      assert.deepEqual(colors[0].color, { red: 1, green: 0.8, blue: 0, alpha: 1 });
      const [picked] = await client.request('textDocument/colorPresentation', {
        textDocument, range: colors[0].range, color: { red: 1, green: 0, blue: 0, alpha: 1 },
      });
      const edit = picked.textEdit ?? { range: colors[0].range, newText: picked.label };
      assert.match(edited(text, [edit]), /let c = #f00\n/);
    },
  },
  {
    name: 'document symbols are a tree of objects and names',
    async test(client) {
      const { textDocument } = client.open('a.scene', SCENE);
      const symbols = await client.request('textDocument/documentSymbol', { textDocument });
      const names = symbols.map(({ name }) => name);
      for (const name of ['a', 'b', 'double', 'pair']) assert.ok(names.some((found) => found.includes(name)), names.join());
      assert.equal(symbols.find(({ name }) => name === 'pair').children.length, 2);
    },
  },
  {
    name: 'workspace symbols are found in files that are not open',
    async test(client) {
      client.write('library.scene', 'scene 1\nlet polished_brass = specular(color: tan)\n');
      client.notify('workspace/didChangeWatchedFiles', { changes: [{ uri: client.uri('library.scene'), type: 1 }] });
      client.open('a.scene', SCENE);
      await client.retry('the folder is read', async () => {
        const symbols = await client.request('workspace/symbol', { query: 'polbrass' });
        return symbols?.some(({ name }) => name.includes('polished_brass'));
      });
    },
  },
  {
    name: 'blocks and comments fold',
    async test(client) {
      const { textDocument } = client.open('a.scene', `${SCENE}/*\na\n*/\n`);
      const folds = await client.request('textDocument/foldingRange', { textDocument });
      assert.ok(folds.some(({ startLine, endLine }) => startLine === 4 && endLine >= 6), JSON.stringify(folds));
      assert.ok(folds.some(({ kind }) => kind === 'comment'), JSON.stringify(folds));
    },
  },
  {
    name: 'selection grows from a word to the statement',
    async test(client) {
      const { textDocument, position } = client.open('a.scene', 'scene 1\nlet a = 1 + dou|ble(2)\n');
      const [range] = await client.request('textDocument/selectionRange', { textDocument, positions: [position] });
      assert.deepEqual(range.range, { start: { line: 1, character: 12 }, end: { line: 1, character: 18 } });
      const widths = [];
      for (let at = range; at; at = at.parent) widths.push(at.range.end.character - at.range.start.character);
      assert.ok(widths.length >= 3, widths.join());
    },
  },
  {
    name: 'file names are links',
    async test(client) {
      client.write('library.scene', 'scene 1\n');
      const { textDocument } = client.open('a.scene', 'scene 1\nimport "library.scene" as l\n');
      const [link] = await client.request('textDocument/documentLink', { textDocument });
      assert.equal(link.target, client.uri('library.scene'));
    },
  },
  {
    name: 'semantic tokens cover the names, whole, in part and as a change',
    async test(client) {
      const { legend } = client.capabilities.semanticTokensProvider;
      const { textDocument } = client.open('a.scene', SCENE);
      const full = await client.request('textDocument/semanticTokens/full', { textDocument });
      assert.equal(full.data.length % 5, 0);
      for (let i = 3; i < full.data.length; i += 5) assert.ok(full.data[i] < legend.tokenTypes.length);
      const range = { start: { line: 9, character: 0 }, end: { line: 10, character: 0 } };
      const part = await client.request('textDocument/semanticTokens/range', { textDocument, range });
      assert.ok(part.data.length > 0 && part.data.length < full.data.length);
      client.change('a.scene', { range: { start: { line: 0, character: 0 }, end: { line: 0, character: 0 } }, text: '// c\n' });
      const delta = await client.request('textDocument/semanticTokens/full/delta', { textDocument, previousResultId: full.resultId });
      assert.ok(delta.edits, JSON.stringify(delta).slice(0, 200));
    },
  },
  {
    name: 'inlay hints appear only when they are switched on',
    async test(client) {
      const { textDocument } = client.open('a.scene', SCENE);
      const range = { start: { line: 0, character: 0 }, end: { line: 20, character: 0 } };
      const hints = () => client.request('textDocument/inlayHint', { textDocument, range });
      assert.deepEqual((await hints()) ?? [], []);
      client.settings = { ...client.settings, inlayHints: true };
      client.notify('workspace/didChangeConfiguration', { settings: { sdlc: client.settings } });
      await client.until('a refresh', () => client.requests.some(({ method }) => method === 'workspace/inlayHint/refresh'));
      assert.match(JSON.stringify(await hints()), /6\.28/);
    },
  },
  {
    name: 'a camera has a lens that renders, with progress',
    options: { options: { threads: 2 } },
    async test(client) {
      client.write('a.scene', `scene 1\n${CAMERA}render { width: 8, samples: 8, output: "a.png" }\n`);
      const { textDocument } = client.open('a.scene', `scene 1\n${CAMERA}render { width: 8, samples: 8, output: "a.png" }\n`);
      const [lens] = await client.request('textDocument/codeLens', { textDocument });
      const { command, arguments: values } = lens.command;
      assert.equal(command, 'sdlc.render');
      await client.request('workspace/executeCommand', { command, arguments: values });
      const ended = () => client.progress.some(({ value }) => value.kind === 'end');
      await client.until('the end of the progress', ended);
      assert.deepEqual(client.progress.map(({ value }) => value.kind).filter((kind) => kind !== 'report'), ['begin', 'end']);
    },
  },
];
