// Definitions, references, rename, calls.
import assert from 'node:assert/strict';
import { pathToFileURL } from 'node:url';
import { join } from 'node:path';
import { edited, editsFor } from '../client.mjs';

const LIBRARY = 'scene 1\nlet brass = specular(color: tan)\nfn twice(x) = 2 * x\n';
const USER = 'scene 1\nimport "library.scene" as l\nlet a = l.|brass\nlet b = l.brass\nlet c = l.twice(1)\n';

function openUser(client, marked = USER) {
  client.write('library.scene', LIBRARY);
  return client.open('user.scene', marked);
}

const place = (location) => [location.uri ?? location.targetUri, (location.range ?? location.targetSelectionRange).start.line];

export const checks = [
  {
    name: 'definition goes to the other file',
    async test(client) {
      const { textDocument, position } = openUser(client);
      const found = await client.request('textDocument/definition', { textDocument, position });
      assert.deepEqual([found].flat().map(place), [[client.uri('library.scene'), 1]]);
    },
  },
  {
    name: 'references are in both files',
    async test(client) {
      const { textDocument, position } = openUser(client);
      const found = await client.request('textDocument/references', { textDocument, position, context: { includeDeclaration: true } });
      assert.deepEqual(found.map(place).sort(), [[client.uri('library.scene'), 1], [client.uri('user.scene'), 2], [client.uri('user.scene'), 3]]);
    },
  },
  {
    name: 'highlights are those of the file',
    async test(client) {
      const { textDocument, position } = openUser(client);
      const found = await client.request('textDocument/documentHighlight', { textDocument, position });
      assert.equal(found.length, 2);
    },
  },
  {
    name: 'rename changes both files',
    async test(client) {
      const { textDocument, position, text } = openUser(client);
      const range = await client.request('textDocument/prepareRename', { textDocument, position });
      assert.equal(range.placeholder ?? 'brass', 'brass');
      const edit = await client.request('textDocument/rename', { textDocument, position, newName: 'gold' });
      assert.equal(edited(text, editsFor(edit, client.uri('user.scene'))), text.replaceAll('brass', 'gold'));
      assert.equal(edited(LIBRARY, editsFor(edit, client.uri('library.scene'))), LIBRARY.replace('brass', 'gold'));
    },
  },
  {
    name: 'rename refuses a clash with the reason',
    async test(client) {
      const { textDocument, position } = client.open('a.scene', 'scene 1\nlet |one = 1\nlet two = one\n');
      await assert.rejects(client.connection.sendRequest('textDocument/rename', { textDocument, position, newName: 'two' }), /two/);
    },
  },
  {
    name: 'rename refuses what is no name',
    async test(client) {
      const { textDocument, position } = client.open('a.scene', 'scene 1\nlet |one = 1\n');
      for (const newName of ['', '1a', 'for', 'a b', 'a\u0000']) {
        await assert.rejects(client.connection.sendRequest('textDocument/rename', { textDocument, position, newName }), Error);
      }
    },
  },
  {
    name: 'calls of functions are known in both directions',
    async test(client) {
      const { textDocument, position } = client.open('a.scene', 'scene 1\nfn one(x) = x\nfn tw|o(x) = one(x) + one(x)\nlet a = two(1)\n');
      const [item] = await client.request('textDocument/prepareCallHierarchy', { textDocument, position });
      assert.equal(item.name, 'two');
      const outgoing = await client.request('callHierarchy/outgoingCalls', { item });
      assert.deepEqual(outgoing.map(({ to, fromRanges }) => [to.name, fromRanges.length]), [['one', 2]]);
      const incoming = await client.request('callHierarchy/incomingCalls', { item: outgoing[0].to });
      assert.deepEqual(incoming.map(({ from }) => from.name), ['two']);
    },
  },
  {
    name: 'names are found in all folders of the workspace',
    async test(client) {
      client.write('more/library.scene', LIBRARY);
      const added = { uri: pathToFileURL(join(client.folder, 'more')).href, name: 'more' };
      client.notify('workspace/didChangeWorkspaceFolders', { event: { added: [added], removed: [] } });
      const { textDocument, position } = client.open('user.scene', USER.replace('library', 'more/library'));
      const found = await client.request('textDocument/definition', { textDocument, position });
      assert.deepEqual([found].flat().map(place), [[client.uri('more/library.scene'), 1]]);
    },
  },
];
