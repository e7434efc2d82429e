// A stand-in for the engine of the playground: its worker passes all messages to this bridge, which runs the native
// `sdlc lsp` and `sdlc serve --editor`. So the page is tested with the program's own answers.
import { spawn, execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';

const require = createRequire(join(process.env.SDLC_NODE_MODULES, 'bridge.cjs'));
const { WebSocket, WebSocketServer } = require('ws');

/** The text of engine.js for a bridge at `port`. */
export const standIn = (port) => `
const socket = new WebSocket('ws://127.0.0.1:${port}');
socket.binaryType = 'arraybuffer';
const early = [];
const send = (message) => socket.readyState === 1 ? socket.send(JSON.stringify(message)) : early.push(message);
socket.onopen = () => early.splice(0).forEach(send);
socket.onmessage = ({ data }) => {
  if (typeof data !== 'string') return postMessage({ from: 'preview', message: data }, [data]);
  const message = JSON.parse(data);
  if (message.from === 'hang') for (;;);
  postMessage(message);
};
onmessage = ({ data }) => {
  if (data.to === 'ping') return postMessage({ from: 'pong', id: data.id });
  send({ ...data, module: undefined });
};
`;

/** One worker: its folder and its programs. */
function connect(socket, program, received) {
  const folder = mkdtempSync(join(tmpdir(), 'sdlc-playground-'));
  const send = (message) => socket.readyState === WebSocket.OPEN && socket.send(JSON.stringify(message));
  const inFolder = (text) => text.replaceAll('file:///~sdlc~/', `file://${folder}/`);
  const outOfFolder = (text) => text.replaceAll(`file://${folder}/`, 'file:///~sdlc~/').replaceAll(`${folder}/`, '');

  const lsp = spawn(program, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
  const tell = (message) => {
    const text = Buffer.from(inFolder(JSON.stringify(message)));
    lsp.stdin.write(`Content-Length: ${text.length}\r\n\r\n`);
    lsp.stdin.write(text);
  };
  let rest = Buffer.alloc(0);
  lsp.stdout.on('data', (data) => {
    rest = Buffer.concat([rest, data]);
    for (;;) {
      const end = rest.indexOf('\r\n\r\n');
      const length = end < 0 ? NaN : Number(/Content-Length: (\d+)/.exec(rest.subarray(0, end))[1]);
      if (!(rest.length >= end + 4 + length)) return;
      send({ from: 'lsp', message: JSON.parse(outOfFolder(rest.subarray(end + 4, end + 4 + length).toString())) });
      rest = rest.subarray(end + 4 + length);
    }
  });

  let files = {};
  let main;
  let flags = [];
  let serve;      // the program that renders
  let live;       // its WebSocket
  let early = []; // messages to it
  let choices;    // until it knows the scene
  const kept = new Map(); // the last `view` and `visible`
  let chosen;             // all choices: a new program has to know them
  const toLive = (message) => live?.readyState === WebSocket.OPEN ? live.send(JSON.stringify(message)) : early.push(message);
  function stop() {
    serve?.kill();
    live?.terminate();
    serve = live = undefined;
    early = [...kept.values()];
  }
  const tellServe = (message) => serve?.stdin.write(`${JSON.stringify(message)}\n`);
  const edit = (name, text) => tellServe({ type: 'text', path: join(folder, name), text });
  function render() {
    stop();
    choices = chosen ? [chosen] : [];
    const started = spawn(program, ['serve', main, '--editor', ...flags], { cwd: folder, stdio: ['pipe', 'pipe', 'inherit'] });
    serve = started;
    for (const [name, text] of Object.entries(files)) edit(name, text);
    let lines = '';
    started.stdout.on('data', (data) => {
      lines += data;
      for (let end; (end = lines.indexOf('\n')) >= 0; lines = lines.slice(end + 1)) {
        const message = JSON.parse(outOfFolder(lines.slice(0, end)));
        if (message.type !== 'url' || serve !== started) continue;
        live = new WebSocket(`${message.url.replace('http', 'ws')}live`, { origin: new URL(message.url).origin });
        const socketNow = live;
        live.on('open', () => early.splice(0).forEach(toLive));
        live.on('message', (answer, isBinary) => {
          if (live !== socketNow) return;
          if (isBinary) return socket.send(answer, { binary: true });
          if (choices && JSON.parse(answer).type === 'scene') {
            const waiting = choices;
            choices = undefined;
            waiting.forEach(toLive);
          }
          send({ from: 'preview', message: JSON.parse(outOfFolder(answer.toString())) });
        });
        live.on('error', () => {});
      }
    });
  }

  const handlers = {
    start: () => send({ from: 'ready', version: 'stand-in', threads: 1 }),
    files(message) {
      const changed = Object.entries(message.files).filter(([name, text]) => files[name] !== text);
      for (const [name, text] of changed) {
        mkdirSync(dirname(join(folder, name)), { recursive: true });
        writeFileSync(join(folder, name), text);
      }
      const removed = Object.keys(files).filter((name) => !(name in message.files));
      for (const name of removed) rmSync(join(folder, name));
      if (changed.length + removed.length > 0) {
        const changes = changed.map(([name]) => ({ uri: `file:///~sdlc~/${name}`, type: name in files ? 2 : 1 }));
        changes.push(...removed.map((name) => ({ uri: `file:///~sdlc~/${name}`, type: 3 })));
        tell({ jsonrpc: '2.0', method: 'workspace/didChangeWatchedFiles', params: { changes } });
      }
      files = message.files;
      const wasMain = main;
      main = message.main;
      // `serve` does not answer to a text that the scene does not read; the engine does.
      const changesOtherFiles = removed.length > 0 || changed.some(([name]) => name !== main);
      if (!message.render) stop();
      else if (!serve || main !== wasMain || changesOtherFiles) render();
      else changed.forEach(([name, text]) => edit(name, text));
    },
    settings(message) {
      flags = message.arguments;
      if (serve) render();
    },
    preview({ message }) {
      if (message.type === 'view' || message.type === 'visible') kept.set(message.type, message);
      if (message.type === 'choose') chosen = { ...chosen, ...message, params: { ...chosen?.params, ...message.params } };
      if (message.type === 'choose' && choices) choices.push(message);
      else toLive(message);
    },
    cursor({ path, ...place }) {
      tellServe({ type: 'cursor', path: join(folder, path), line: place.line, column: place.column });
    },
    stop() {
      stop();
      send({ from: 'preview', message: { type: 'progress', share: 0, is_running: false, is_stopped: true } });
    },
    lsp: ({ message }) => tell(message),
    convert({ id, text }) {
      writeFileSync(join(folder, 'dropped.json'), text);
      try {
        execFileSync(program, ['convert', 'dropped.json', '-o', 'dropped.scene', '--overwrite'], { cwd: folder, stdio: 'pipe' });
        send({ from: 'convert', id, text: execFileSync('cat', [join(folder, 'dropped.scene')], { encoding: 'utf8' }) });
      } catch (error) {
        send({ from: 'convert', id, failure: String(error.stderr) });
      }
    },
  };
  socket.on('message', (data) => {
    const message = JSON.parse(data);
    received.push(message);
    handlers[message.to]?.(message);
  });
  const end = () => {
    stop();
    lsp.kill();
    rmSync(folder, { recursive: true, force: true });
  };
  socket.on('close', end);
  return { send, end };
}

/** `{port, received, workers, close()}`: `workers` are those that are connected, each with `send(message)`. */
export async function startBridge(program) {
  const server = new WebSocketServer({ host: '127.0.0.1', port: 0 });
  await new Promise((resolve) => server.once('listening', resolve));
  const bridge = { port: server.address().port, received: [], workers: new Set() };
  server.on('connection', (socket) => {
    const worker = connect(socket, program, bridge.received);
    bridge.workers.add(worker);
    socket.on('close', () => bridge.workers.delete(worker));
  });
  bridge.close = () => {
    for (const socket of server.clients) socket.terminate();
    server.close();
  };
  return bridge;
}
