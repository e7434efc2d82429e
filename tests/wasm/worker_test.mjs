// The worker of the playground and of the extension for VS Code.
import assert from 'node:assert/strict';
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { Worker } from 'node:worker_threads';

const folder = mkdtempSync(join(tmpdir(), 'sdlc-worker-'));
after(() => rmSync(folder, { recursive: true }));
const root = join(import.meta.dirname, '../..');
cpSync(join(root, 'site/playground/engine.js'), join(folder, 'engine.mjs'));
cpSync(join(root, 'wasm/index.mjs'), join(folder, 'index.mjs'));
cpSync(join(process.env.SDLC_WASM, 'sdlc.mjs'), join(folder, 'sdlc.mjs'));
// What a worker of a page has.
writeFileSync(join(folder, 'worker.mjs'), `
import { parentPort } from 'node:worker_threads';
globalThis.self = globalThis;
globalThis.postMessage = (message, transfer) => parentPort.postMessage(message, transfer);
// A port of Node takes up to a thousand of its own messages before those of others.
globalThis.MessageChannel = class {
  port1 = { postMessage: () => setImmediate(() => this.port2.onmessage()) };
  port2 = {};
};
await import('./engine.mjs');
parentPort.on('message', (data) => self.onmessage({ data }));
`);
const module = await WebAssembly.compile(readFileSync(join(process.env.SDLC_WASM, 'sdlc.wasm')));

/** A worker that has been started, with `see(holds)`: the first message for which that is true. */
async function startedWorker(t) {
  const worker = new Worker(join(folder, 'worker.mjs'));
  t.after(() => worker.terminate());
  const waiting = new Set();
  worker.on('message', (message) => {
    for (const [holds, take] of waiting) if (holds(message)) take(message);
  });
  const see = (holds) => new Promise((resolve, reject) => {
    worker.once('error', reject);
    const entry = [holds, (message) => {
      waiting.delete(entry);
      resolve(message);
    }];
    waiting.add(entry);
  });
  const post = (message) => worker.postMessage(message);
  const lsp = (message) => post({ to: 'lsp', message: { jsonrpc: '2.0', ...message } });
  const ready = see(({ from }) => from === 'ready');
  post({ to: 'start', module, folder: '/workspace/' });
  await ready;
  const findings = () => see(({ message }) => message?.method === 'textDocument/publishDiagnostics');
  return { post, lsp, see, findings };
}

const kScene = `scene 1
import "parts.scene" as parts
camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }
background { top: white, bottom: white }
render { width: 16, samples: 4 }
sphere ball { center: (0, 0, 0), radius: parts.size, material: diffuse(color: tan) }
`;
const bytes = (text) => new TextEncoder().encode(text);
const uri = 'file:///workspace/disk/a%20b/ball.scene';

async function initialize({ lsp, see }) {
  const answer = see(({ message }) => message?.id === 1);
  const params = { processId: null, rootUri: 'file:///workspace/disk', capabilities: {} };
  lsp({ id: 1, method: 'initialize', params });
  await answer;
  lsp({ method: 'initialized', params: {} });
}

function open(worker, text) {
  const textDocument = { uri, languageId: 'scene', version: 1, text };
  worker.lsp({ method: 'textDocument/didOpen', params: { textDocument } });
}

test('imports are files that were sent, and a later change of one is checked', async (t) => {
  const worker = await startedWorker(t);
  worker.post({ to: 'changes', files: { 'disk/a b/parts.scene': bytes('scene 1\nlet length = 1\n') } });
  await initialize(worker);
  const unknown = worker.findings();
  open(worker, kScene);
  assert.match(JSON.stringify((await unknown).message.params.diagnostics), /parts.size/);
  const none = worker.findings();
  worker.post({ to: 'changes', files: { 'disk/a b/parts.scene': bytes('scene 1\nlet size = 1\n') } });
  assert.deepEqual((await none).message.params.diagnostics, []);
  const missing = worker.findings();
  worker.post({ to: 'changes', files: { 'disk/a b/parts.scene': null, 'disk/never.csv': null } });
  assert.notDeepEqual((await missing).message.params.diagnostics, []);
});

test('changes of a text that have waited are checked once', async (t) => {
  const worker = await startedWorker(t);
  worker.post({ to: 'changes', files: { 'disk/a b/parts.scene': 'scene 1\nlet size = 1\n' } });
  await initialize(worker);
  open(worker, kScene);
  let count = 0;
  worker.see(({ message }) => message?.method === 'textDocument/publishDiagnostics' && ++count < 0);
  const last = worker.see(({ message }) => JSON.stringify(message).includes('lenght'));
  for (let version = 2; version <= 30; ++version) {
    const position = { line: 0, character: 7 };
    worker.lsp({
      method: 'textDocument/didChange',
      params: {
        textDocument: { uri, version },
        contentChanges: [{ range: { start: position, end: position }, text: version === 30 ? '\nlenght' : 'x' }],
      },
    });
  }
  await last;
  assert.ok(count <= 2, `${count} checks of 29 changes`);  // the first may begin before the others come
});

test('a picture of a scene in a folder, whose names are relative to it, follows the files', async (t) => {
  const worker = await startedWorker(t);
  const main = 'disk/a b/ball.scene';
  const parts = bytes('scene 1\nlet size = 1\n');
  worker.post({ to: 'changes', files: { [main]: bytes(kScene), 'disk/a b/parts.scene': parts } });
  worker.post({ to: 'preview', message: { type: 'visible', value: true } });
  const scene = worker.see(({ message }) => message?.type === 'scene');
  const picture = worker.see(({ message }) => message instanceof ArrayBuffer);
  worker.post({ to: 'show', main });
  assert.equal((await scene).message.name, 'ball.scene');
  const { message } = await picture;
  const size = new DataView(message).getUint32(0, true);
  assert.equal(JSON.parse(new TextDecoder().decode(new Uint8Array(message, 4, size))).full_width, 16);

  const picked = worker.see(({ message: answer }) => answer?.type === 'picked');
  worker.post({ to: 'preview', message: { type: 'pick', x: 8, y: 4 } });
  assert.deepEqual((await picked).message.sphere?.place?.path, main);

  const outline = worker.see(({ message: answer }) => answer?.type === 'outline' && answer.rows.length > 0);
  worker.post({ to: 'cursor', path: main, line: 6, column: 3 });
  await outline;
  const broken = worker.see(({ message: answer }) => answer?.type === 'scene' && !answer.is_correct);
  worker.post({ to: 'changes', files: { [main]: kScene.replace('radius', 'radus') } });
  assert.match(JSON.stringify((await broken).message.findings), /E104/);
});

test('files of the playground are all there are, and settings are those of the command', async (t) => {
  const worker = await startedWorker(t);
  const files = { 'ball.scene': kScene, 'parts.scene': 'scene 1\nlet size = 1\n' };
  worker.post({ to: 'settings', arguments: ['--width=8', '--error=50%'] });
  worker.post({ to: 'preview', message: { type: 'visible', value: true } });
  const picture = worker.see(({ message }) => message instanceof ArrayBuffer);
  const scene = worker.see(({ message }) => message?.type === 'scene');
  worker.post({ to: 'files', files, main: 'ball.scene', render: true });
  assert.match((await scene).message.command, /ball\.scene.*--width=8/);
  assert.match(new TextDecoder().decode((await picture).message), /"full_width":8/);
  const broken = worker.see(({ message }) => message?.type === 'scene' && !message.is_correct);
  worker.post({ to: 'files', files: { 'ball.scene': kScene }, main: 'ball.scene', render: true });
  assert.match(JSON.stringify((await broken).message.findings), /parts\.scene/);
});

test('progress follows each scene, also if it has not changed', async (t) => {
  const worker = await startedWorker(t);
  const post = (text) => {
    const files = { 'ball.scene': text, 'parts.scene': 'scene 1\nlet size = 1\n' };
    worker.post({ to: 'files', files, main: 'ball.scene', render: true });
  };
  worker.post({ to: 'preview', message: { type: 'visible', value: true } });
  const picture = worker.see(({ message }) => message instanceof ArrayBuffer);
  const finished = worker.see(({ message }) => message?.type === 'progress' && !message.is_running);
  post(kScene);
  await picture;
  worker.post({ to: 'preview', message: { type: 'shown' } });
  await finished;
  for (const comment of ['// a', '// b']) {
    const scene = worker.see(({ message }) => message?.type === 'scene');
    post(`${kScene}${comment}\n`);
    await scene;
    const answer = worker.see(({ message }) => ['progress', 'picked'].includes(message?.type));
    worker.post({ to: 'preview', message: { type: 'pick', x: 8, y: 4 } });
    const { type, is_running } = (await answer).message;
    assert.deepEqual({ type, is_running }, { type: 'progress', is_running: false });
  }
});

test('a stop ends the render of a change that still waits', async (t) => {
  const worker = await startedWorker(t);
  const files = { 'ball.scene': kScene, 'parts.scene': 'scene 1\nlet size = 1\n' };
  worker.post({ to: 'settings', arguments: ['--width=64', '--samples=1000000'] });
  worker.post({ to: 'preview', message: { type: 'visible', value: true } });
  const running = worker.see(({ message }) => message?.type === 'progress' && message.is_running);
  worker.post({ to: 'files', files, main: 'ball.scene', render: true });
  await running;
  const stopped = worker.see(({ message }) => message?.type === 'progress' && !message.is_running);
  worker.post({ to: 'settings', arguments: ['--width=32', '--samples=1000000'] });
  worker.post({ to: 'stop' });
  await stopped;
  const again = worker.see(({ message }) => message?.type === 'progress' && message.is_running).then(() => 'again');
  const later = new Promise((resolve) => setTimeout(() => resolve('stopped'), 2000));
  assert.equal(await Promise.race([again, later]), 'stopped');
});
