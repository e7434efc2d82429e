// The worker of the playground and of the extension for VS Code: the WebAssembly engine. README.md has the messages.
const kStep = 30; // ms of a step of the render; messages are taken between steps

let folder; // of the files, in the memory of the engine
let folderInTexts; // not in URIs
let engine;
let early = []; // messages that came before the engine
const files = new Map(); // content by name
let main;
let settings = [];
let hasPreview = false;
let isStopped = false; // the render of the preview, by the page
let sandbox = false;
let hasWork = false; // the preview
const requests = []; // to the language server
const kept = new Map(); // what the page has said of itself and of the scene: a new preview has to know it

/** Names of files are relative; URIs stay. */
const outOfFolder = (text) => JSON.parse(text.replaceAll(folderInTexts, ''));
const show = (message) => postMessage({ from: 'preview', message });

/** Settings as the arguments of `sdlc render`: `--width=480`, `--error=5%`, `--denoise`. */
function optionsOf(flags) {
  const options = { arguments: ['preview', main, ...flags], sandbox, render: {} };
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
  for (const message of kept.values()) engine.sendToPreview(message);
  hasPreview = true;
  isStopped = false;
  stepPreview();
}

function stepPreview() {
  hasWork = hasPreview;
  takeTurn();
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
let isTurnToCome = false;
/** Goes on while there is work; between two turns the worker takes messages. */
function takeTurn() {
  if (isTurnToCome || !(hasWork || requests.length > 0)) return;
  isTurnToCome = true;
  turns.port1.postMessage(null);
}
turns.port2.onmessage = () => {
  isTurnToCome = false;
  attempt(() => {
    if (requests.length > 0) return answer(requests.shift());
    if (!hasWork) return; // it has been stopped
    const step = engine.stepPreview(isStopped ? 0 : kStep);
    // A click is answered, and nothing rendered.
    if (isStopped) engine.changePreview({ stop: true });
    hasWork = step.hasWork && !isStopped;
    for (const text of step.messages) {
      const message = outOfFolder(text);
      if (isStopped && message.type === 'progress') message.is_stopped = true;
      show(message);
    }
    if (step.picture) postMessage({ from: 'preview', message: step.picture }, [step.picture]);
  });
  takeTurn();
};

function answer(message) {
  for (const text of engine.receive(JSON.stringify(message))) postMessage({ from: 'lsp', message: JSON.parse(text) });
}

/** Changes of a text that have waited are checked once. */
function wasAddedTo(last, { method, params }) {
  if (method !== 'textDocument/didChange' || last?.method !== method) return false;
  if (last.params.textDocument.uri !== params.textDocument.uri) return false;
  last.params.textDocument = params.textDocument;
  last.params.contentChanges.push(...params.contentChanges);
  return true;
}

/** Writes files, and removes those whose content is null; false if nothing changes. */
function write(contents) {
  const changes = [];
  // Removed files first: a file may become a folder.
  const isGone = ([, content]) => content === null;
  for (const [name, content] of Object.entries(contents).sort((a, b) => isGone(b) - isGone(a))) {
    const known = files.get(name) ?? null;
    if (content === known) continue;
    if (content === null) engine.removeFile(folder + name);
    else engine.writeFile(folder + name, content);
    if (content === null) files.delete(name);
    else files.set(name, content);
    changes.push({ uri: `file://${(folder + name).split('/').map(encodeURIComponent).join('/')}`, type: known === null ? 1 : content === null ? 3 : 2 });
  }
  if (changes.length === 0) return false;
  handlers.lsp({ message: { jsonrpc: '2.0', method: 'workspace/didChangeWatchedFiles', params: { changes } } });
  return true;
}

function attempt(action) {
  try {
    return action();
  } catch (error) {
    postMessage({ from: 'failed', kind: error.kind === 'memory' ? 'memory' : 'defect', text: error.message });
  }
}

const handlers = {
  async start({ module, threads = 1, folder: root = '/~sdlc~/' }) {
    folder = root;
    folderInTexts = new RegExp(`(?<!file://)${folder}`, 'g');
    try {
      if (!module) throw new Error('this site has no engine');
      engine = await make(module, threads);
      engine.enterFolder(folder);
    } catch (error) {
      return postMessage({ from: 'failed', kind: 'absent', text: error.message });
    }
    postMessage({ from: 'ready', version: engine.version, threads: engine.threads });
    const messages = early;
    early = [];
    messages.forEach(take);
  },
  files(message) {
    const gone = [...files.keys()].filter((name) => !Object.hasOwn(message.files, name));
    const hasChanged = write({ ...message.files, ...Object.fromEntries(gone.map((name) => [name, null])) });
    const isOther = main !== message.main;
    main = message.main;
    if (!message.render) return handlers.stop();
    if (isOther || !hasPreview || isStopped) return startPreview();
    if (hasChanged) engine.changePreview({ files: true });
    stepPreview();
  },
  changes(message) {
    if (!write(message.files) || !hasPreview) return;
    engine.changePreview({ files: true });
    stepPreview();
  },
  show(message) {
    const end = message.main.lastIndexOf('/') + 1;
    engine.enterFolder(folder + message.main.slice(0, end)); // names of files are relative to it
    main = message.main.slice(end);
    sandbox = Boolean(message.sandbox);
    startPreview();
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
    engine.sendToPreview(message);
    stepPreview();
  },
  cursor({ path, line, column }) {
    if (!hasPreview) return;
    engine.changePreview({ cursor: { path: folder + path, line, column } });
    stepPreview();
  },
  stop() {
    isStopped = true;
    hasWork = false;
    if (hasPreview) engine.changePreview({ stop: true });
    show({ type: 'progress', share: 0, is_running: false, is_stopped: true });
  },
  lsp({ message }) {
    if (!wasAddedTo(requests.at(-1), message)) requests.push(message);
    takeTurn();
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
