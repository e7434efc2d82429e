// The worker of the playground: the WebAssembly engine. README.md has the messages.
const kFolder = '/playground/'; // of the files, in the memory of the engine
const kStep = 30; // ms between two looks at the messages

let engine;
let early = []; // messages that came before the engine
let files = {};
let main;
let settings = [];
let hasPreview = false;
let isStopped = false; // the render of the preview, by the page
let isStepping = false; // a step is to come
const kept = new Map(); // what the page has said of itself and of the scene: a new preview has to know it

/** Names of files are relative; URIs stay. */
const outOfFolder = (text) => JSON.parse(text.replaceAll(/(?<!file:\/\/)\/playground\//g, ''));
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
  for (const message of kept.values()) engine.tellPreview(message);
  hasPreview = true;
  isStopped = false;
  step();
}

/** With as much memory as the device gives: phones refuse 2 GB. */
async function make(module, threads) {
  const { createEngine } = await import('./index.mjs');
  for (const megabytes of [2048, 1024]) {
    try {
      return await createEngine({ module, threads, megabytes });
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
    }
  }
  return createEngine({ module, threads, megabytes: 512 });
}

const turns = new MessageChannel(); // a timer would wait for 4 ms
/** Goes on while there is work; between two steps the worker takes messages. */
function step() {
  if (isStepping || !hasPreview) return;
  isStepping = true;
  turns.port1.postMessage(null);
}
turns.port2.onmessage = () => {
  isStepping = false;
  attempt(() => {
    const { messages, picture, hasWork } = engine.stepPreview(kStep);
    for (const text of messages) show(outOfFolder(text));
    if (picture) postMessage({ from: 'preview', message: picture }, [picture]);
    if (hasWork) step();
  });
};

function attempt(action) {
  try {
    return action();
  } catch (error) {
    postMessage({ from: 'failed', kind: error.kind === 'memory' ? 'memory' : 'defect', text: error.message });
  }
}

const handlers = {
  async start({ module, threads }) {
    try {
      if (!module) throw new Error('this site has no engine');
      engine = await make(module, threads);
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
    // First: a file may become a folder.
    for (const name of Object.keys(files).filter((each) => !Object.hasOwn(message.files, each))) {
      engine.removeFile(kFolder + name);
      changes.push({ uri: `file://${kFolder}${name}`, type: 3 });
    }
    for (const [name, text] of Object.entries(message.files)) {
      if (files[name] === text) continue;
      engine.writeFile(kFolder + name, text);
      changes.push({ uri: `file://${kFolder}${name}`, type: Object.hasOwn(files, name) ? 2 : 1 });
    }
    files = message.files;
    if (changes.length > 0) {
      handlers.lsp({ message: { jsonrpc: '2.0', method: 'workspace/didChangeWatchedFiles', params: { changes } } });
    }
    const isOther = main !== message.main;
    main = message.main;
    if (!message.render) return handlers.stop();
    if (isOther || !hasPreview || isStopped) return startPreview();
    if (changes.length > 0) engine.changePreview({ files: true });
    step();
  },
  settings(message) {
    settings = message.arguments;
    if (hasPreview && !isStopped) startPreview();
  },
  preview({ message }) {
    if (message.type === 'view' || message.type === 'visible') kept.set(message.type, message);
    if (message.type === 'choose') {
      const before = kept.get('choose');
      kept.set('choose', { ...before, ...message, params: { ...before?.params, ...message.params } });
      if (isStopped) return; // it would be rendered
    }
    if (!hasPreview) return;
    engine.tellPreview(message);
    step();
  },
  cursor({ path, line, column }) {
    if (!hasPreview) return;
    engine.changePreview({ cursor: { path: kFolder + path, line, column } });
    step();
  },
  stop() {
    isStopped = true;
    if (hasPreview) engine.changePreview({ stop: true });
    show({ type: 'progress', share: 0, is_running: false });
  },
  lsp({ message }) {
    const answers = engine.receive(JSON.stringify(message)).map(outOfFolder);
    for (const answer of answers) postMessage({ from: 'lsp', message: answer });
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
