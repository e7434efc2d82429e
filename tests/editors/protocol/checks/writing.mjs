// Completion and signature help.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { CAMERA, protocol } from '../client.mjs';

const SNIPPETS = new URL('../../../../editors/vscode/snippets/scene.json', import.meta.url);

const { CompletionItemKind, InsertTextFormat } = protocol;

async function complete(client, marked, name = 'a.scene') {
  const at = client.open(name, marked);
  const result = await client.request('textDocument/completion', { textDocument: at.textDocument, position: at.position });
  return Array.isArray(result) ? result : result.items;
}

const labels = (items) => items.map(({ label }) => label);

function assertOffers(items, ...expected) {
  for (const label of expected) assert.ok(labels(items).includes(label), `no ${label} in ${labels(items)}`);
}

export const checks = [
  {
    name: 'completion offers kinds and statements',
    async test(client) {
      const items = await complete(client, `scene 1\n${CAMERA}sp|`);
      assertOffers(items, 'sphere');
      assert.ok(!labels(items).includes('radius'));
    },
  },
  {
    name: 'completion offers properties, with their types and text',
    async test(client) {
      const items = await complete(client, `scene 1\n${CAMERA}sphere { center: (0, 0, 0), ra| }\n`);
      const radius = items.find(({ label }) => label === 'radius');
      assert.equal(radius.kind, CompletionItemKind.Property);
      assert.match(JSON.stringify(radius), /length/);
      assert.match(JSON.stringify(radius.documentation), /From the centre to the surface/);
      assert.ok(!labels(items).includes('center'), 'it is there already');
    },
  },
  {
    name: 'completion offers the words of a property',
    test: async (client) => assertOffers(await complete(client, 'scene 1\nrender { tone: | }\n'), 'srgb', 'sqrt', 'linear'),
  },
  {
    name: 'completion offers names in scope, and materials',
    async test(client) {
      const items = await complete(client, `scene 1\nlet glass = transmissive(ior: 1.5)\nsphere { material: | }\n`);
      assertOffers(items, 'glass', 'diffuse', 'specular');
    },
  },
  {
    name: 'completion offers the names of an import',
    async test(client) {
      client.write('library.scene', 'scene 1\nlet brass = specular(color: tan)\n');
      assertOffers(await complete(client, 'scene 1\nimport "library.scene" as l\nlet a = l.|\n'), 'brass');
    },
  },
  {
    name: 'completion offers named arguments',
    test: async (client) => {
      const items = await complete(client, 'scene 1\nlet a = specular(color: tan, |)\n');
      assert.ok(labels(items).some((label) => label.startsWith('fuzz')), labels(items).join());
    },
  },
  {
    name: 'completion offers files to import',
    async test(client) {
      client.write('library.scene', 'scene 1\n');
      assertOffers(await complete(client, 'scene 1\nimport "|"'), 'library.scene');
    },
  },
  {
    name: 'completion offers snippets',
    async test(client) {
      const items = await complete(client, `scene 1\n${CAMERA}fo|`);
      const loop = items.find(({ label }) => label === 'for');
      assert.equal(loop.insertTextFormat, InsertTextFormat.Snippet);
    },
  },
  {
    name: 'the extension for VS Code has no snippet that the server offers',
    async test(client) {
      const prefixes = Object.values(JSON.parse(readFileSync(SNIPPETS, 'utf8'))).map(({ prefix }) => prefix);
      const offered = [...(await complete(client, '|')), ...(await complete(client, `scene 1\n${CAMERA}|`))];
      assert.deepEqual(prefixes.filter((prefix) => labels(offered).includes(prefix)), []);
    },
  },
  {
    name: 'completion offers the keys of a config',
    test: async (client) => {
      const items = await complete(client, '{ "camera": { "look_from": [0, 0, 0], "|" } }', 'a.json');
      assert.ok(labels(items).some((label) => label.includes('look_at')), labels(items).join());
    },
  },
  {
    name: 'signature help shows the argument at the cursor',
    async test(client) {
      const { textDocument, position } = client.open('a.scene', 'scene 1\nlet a = clamp(1, |)\n');
      const help = await client.request('textDocument/signatureHelp', { textDocument, position });
      assert.match(help.signatures[0].label, /clamp\(x, low, high\)/);
      assert.equal(help.activeParameter ?? help.signatures[0].activeParameter, 1);
    },
  },
];
