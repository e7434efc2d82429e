// The worker of the playground: the WebAssembly engine. README.md has the messages.
import { createEngine, hasThreads } from './index.mjs';

const kFolder = '/playground/'; // of the files, in the memory of the engine
const kStep = 30; // ms between two looks at the messages

let engine;
let early = []; // messages that came before the engine
let files = {};
let main;
let settings = [];
let isRendering = false; // a preview has been started
let isStepping = false; // a step is to come
const views = new Map(); // what the page has said of itself: a new preview has to know it

const outOfFolder = (message) => JSON.parse(JSON.stringify(message).replaceAll(kFolder, ''));
const show = (message) => postMessage({ from: 'preview', message });

/** Settings as the arguments of `sdlc render`: `--width=480`, `--error=5%`, `--denoise`. */
function optionsOf(flags) {
  const options = { arguments: ['preview', main, ...flags], render: {} };
  for (const flag of flags) {
    const [, name, value] = /^--([\w-]+)(?:=(.*))?$/.exec(flag);
    if (value === undefined) options[name] = true;
    else if (name === 'time') options.seconds = parseFloat(value);
    else if (value.endsWith('%')) options.render[name] = parseFloat(value) / 100;
    else options.render[name.replaceAll('-', '_')] = Number.isNaN(Number(value)) ? value : Number(value);
  }
  return options;
}

function startPreview() {
  engine.startPreview(main, optionsOf(settings));
  for (const message of views.values()) engine.tellPreview(message);
  isRendering = true;
  step();
}

/** Goes on while there is work; between two steps the worker takes messages. */
function step() {
  if (isStepping || !isRendering) return;
  isStepping = true;
  later(() => {
    isStepping = false;
    if (!isRendering) return;
    attempt(() => {
      const { messages, opened, picture, hasWork } = engine.stepPreview(kStep);
      for (const message of messages) show(outOfFolder(message));
      for (const { path, line, column } of opened) {
        postMessage({ from: 'open', path: path.replace(kFolder, ''), line, column });
      }
      if (picture) postMessage({ from: 'preview', message: picture }, [picture]);
      if (hasWork) step();
    });
  });
}

// A timer would wait for 4 ms.
const turns = new MessageChannel();
const waiting = [];
turns.port2.onmessage = () => waiting.shift()();
function later(action) {
  waiting.push(action);
  turns.port1.postMessage(null);
}

function attempt(action) {
  try {
    return action();
  } catch (error) {
    if (error.kind === 'parameter') throw error;
    postMessage({ from: 'failed', kind: error.kind === 'memory' ? 'memory' : 'defect', text: error.message });
  }
}

const handlers = {
  async start({ threads }) {
    try {
      engine = await createEngine({ threads: hasThreads() ? threads : 1 });
      engine.enterFolder(kFolder);
    } catch (error) {
      return postMessage({ from: 'failed', kind: 'absent', text: error.message });
    }
    postMessage({ from: 'ready', version: engine.version, threads: engine.threads });
    const messages = early;
    early = [];
    messages.forEach(take);
  },
  files(message) {
    const changes = [];
    for (const [name, text] of Object.entries(message.files)) {
      if (files[name] === text) continue;
      engine.writeFile(kFolder + name, text);
      changes.push({ uri: `file://${kFolder}${name}`, type: name in files ? 2 : 1 });
    }
    for (const name of Object.keys(files).filter((each) => !(each in message.files))) {
      engine.removeFile(kFolder + name);
      changes.push({ uri: `file://${kFolder}${name}`, type: 3 });
    }
    files = message.files;
    if (changes.length > 0) {
      handlers.lsp({ message: { jsonrpc: '2.0', method: 'workspace/didChangeWatchedFiles', params: { changes } } });
    }
    const isOther = main !== message.main;
    main = message.main;
    if (!message.render) isRendering = false;
    else if (isOther || !isRendering) startPreview();
    else if (changes.length > 0) engine.changePreview({ files: true });
    step();
  },
  settings(message) {
    settings = message.arguments;
    if (isRendering) startPreview();
  },
  preview({ message }) {
    if (message.type === 'view' || message.type === 'visible') views.set(message.type, message);
    if (message.type === 'choose') views.set('choose', { ...views.get('choose'), ...message, params: { ...views.get('choose')?.params, ...message.params } });
    if (!isRendering) return;
    engine.tellPreview(message.type === 'open' ? { ...message, place: { ...message.place, path: kFolder + message.place.path } } : message);
    step();
  },
  cursor({ path, line, column }) {
    if (!isRendering) return;
    engine.changePreview({ cursor: { path: kFolder + path, line, column } });
    step();
  },
  stop() {
    isRendering = false;
    show({ type: 'progress', share: 0, is_running: false });
  },
  lsp({ message }) {
    for (const answer of engine.receive(JSON.stringify(message))) postMessage({ from: 'lsp', message: JSON.parse(answer) });
  },
  convert({ id, text }) {
    engine.writeFile('/dropped.json', text);
    const { text: scene, findings } = engine.convert('/dropped.json');
    const failure = findings.diagnostics.map(({ message }) => message).join('\n');
    postMessage({ from: 'convert', id, ...(scene == null ? { failure } : { text: scene }) });
  },
  ping: ({ id }) => postMessage({ from: 'pong', id }),
};

function take(data) {
  if (data.to === 'start' || data.to === 'ping') return handlers[data.to](data);
  if (!engine) return early.push(data);
  attempt(() => handlers[data.to]?.(data));
}
self.onmessage = ({ data }) => take(data);
