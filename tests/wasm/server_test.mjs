// The language server answers without threads.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { createEngine } from './support.mjs';

async function startedServer() {
  const engine = await createEngine();
  let id = 0;
  const send = (message) =>
    engine.receive(JSON.stringify({ jsonrpc: '2.0', ...message })).map((text) => JSON.parse(text));
  const server = {
    engine,
    notify: (method, params) => send({ method, params }),
    request(method, params) {
      const answer = send({ id: ++id, method, params }).find((message) => message.id === id && !message.method);
      assert.equal(answer.error, undefined);
      return answer.result;
    },
  };
  server.request('initialize', { processId: null, rootUri: null, capabilities: {} });
  server.notify('initialized', {});
  return server;
}

const uri = 'file:///ball.scene';
const open = (server, text) =>
  server.notify('textDocument/didOpen', { textDocument: { uri, languageId: 'scene', version: 1, text } });
const published = (messages) =>
  messages.filter(({ method }) => method === 'textDocument/publishDiagnostics').map(({ params }) => params);

test('findings come with the change that causes them', async () => {
  const server = await startedServer();
  const [first] = published(open(server, 'scene 1\nsphere ball { center: (0, 0, 0), radus: 1 }\n'));
  assert.deepEqual(first.diagnostics.map(({ code }) => code), ['E104']);
  const fixed = { text: 'scene 1\nlet size = 2\nsphere ball { center: (0, 0, 0), radius: size, material: emissive(color: white) }\n' };
  const second = published(server.notify('textDocument/didChange',
    { textDocument: { uri, version: 2 }, contentChanges: [fixed] })).at(-1);
  assert.deepEqual(second.diagnostics.filter(({ severity }) => severity === 1), []);
});

test('hover, completion, definition, formatting and code actions', async () => {
  const server = await startedServer();
  open(server, 'scene 1\nlet size = 2\nsphere ball { center: (0, 0, 0), radus: size }\n');
  const at = (line, character) => ({ textDocument: { uri }, position: { line, character } });
  assert.match(JSON.stringify(server.request('textDocument/hover', at(2, 2))), /sphere/);
  const items = server.request('textDocument/completion', at(2, 33));
  assert.match(JSON.stringify(items), /radius/);
  assert.equal(server.request('textDocument/definition', at(2, 41)).range?.start.line ??
    server.request('textDocument/definition', at(2, 41))[0].range.start.line, 1);
  const range = { start: { line: 2, character: 33 }, end: { line: 2, character: 38 } };
  const actions = server.request('textDocument/codeAction',
    { textDocument: { uri }, range, context: { diagnostics: [] } });
  assert.match(JSON.stringify(actions), /radius/);
});

test('an import is read from the files in memory', async () => {
  const server = await startedServer();
  server.engine.writeFile('/parts.scene', 'scene 1\nlet size = 2\n');
  const [{ diagnostics }] = published(open(server,
    'scene 1\nimport "parts.scene" as parts\nsphere ball { center: (0, 0, 0), radius: parts.sise }\n'));
  assert.match(JSON.stringify(diagnostics), /sise/);
});
