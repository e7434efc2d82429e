// The playground: a project of files in an editor, the engine in a worker, and the picture's page beside them.
// README.md says what is where.
import { basicSetup } from 'codemirror';
import { indentWithTab } from '@codemirror/commands';
import { nextDiagnostic, previousDiagnostic } from '@codemirror/lint';
import { formatDocument } from '@codemirror/lsp-client';
import { EditorState, Prec, StateEffect } from '@codemirror/state';
import { EditorView, keymap } from '@codemirror/view';
import { Engine } from './engine-worker.js';
import { FileDialog } from './file-dialog.js';
import { Language, isScene, sceneLanguage } from './language.js';
import { areMixed, fromFragment, isName } from './link.js';
import { $, announce, element, endNotice, later, notify } from './page.js';
import { Problems, offsetOf, placeOf } from './problems.js';
import { ProjectStorage, storePrevious, storedOfBrowser, storedOfTab, storedPrevious } from './project-storage.js';
import { compile, startServiceWorker } from './startup.js';

const kDefaults = { width: 480, error: 5 };
const kMaxFile = 5_000_000; // bytes; browsers keep about as much

// The project

const states = new Map(); // by name
let main; // the file that is rendered
let current; // that in the editor
let settings = kDefaults;
let choices = {}; // what was chosen beside the picture: params, camera, frame, pose
let view;

const project = {
  names: () => [...states.keys()],
  doc: (name) => (name === current ? view.state.doc : states.get(name).doc),
  change(name, update) {
    const { state, changes } = states.get(name).update(update);
    states.set(name, state);
    hasChanged();
    return changes;
  },
  show,
  current: () => current,
  view: () => view,
  goTo(name, from, to) {
    show(name);
    goToRange(from, to);
  },
};
const snapshot = () => ({
  files: Object.fromEntries(project.names().map((name) => [name, project.doc(name).toString()])),
  main,
  settings,
  choices,
});

const storage = new ProjectStorage(snapshot);
const engine = new Engine(takeMessage);
const language = new Language(project, {
  send: (message) => engine.post({ to: 'lsp', message }),
  onFindings: (name, findings) => problems.take(name, findings),
  onBusy: (isBusy) => setWork({ isChecking: isBusy && isReady }),
});

const problems = new Problems(project);

const commonExtensions = [
  Prec.high(
    keymap.of([
      { key: 'Shift-F8', run: previousDiagnostic },
      { key: 'F8', run: nextDiagnostic },
      { key: 'Mod-.', run: () => problems.focusFix() },
      { key: 'Mod-s', run: () => storage.saveByUser(), preventDefault: true },
    ]),
  ),
  basicSetup,
  keymap.of([indentWithTab]),
  EditorState.tabSize.of(2),
  EditorView.lineWrapping,
  EditorView.updateListener.of((update) => {
    if (update.docChanged) {
      language.update(view, current);
      hasChanged();
    }
    if (update.selectionSet) sendCursor();
  }),
];
const extensionsOf = (name) => [
  commonExtensions,
  EditorView.contentAttributes.of({ tabindex: '0', 'aria-label': `Text of ${name}`, 'aria-describedby': 'editor-help' }),
  isScene(name) ? [sceneLanguage, language.extension(name)] : [],
];
const stateOf = (name, text) => EditorState.create({ doc: text, extensions: extensionsOf(name) });

/** Shows a file in the editor. */
function show(name) {
  if (name === current) return;
  if (current && states.has(current)) states.set(current, view.state);
  current = name;
  view.setState(states.get(name));
  language.update(view, name);
  showFiles();
  problems.show();
}

/** Replaces the project, without a way back. */
function load(next) {
  states.clear();
  problems.clear();
  current = undefined;
  for (const [name, text] of Object.entries(next.files)) states.set(name, stateOf(name, text));
  main = next.main;
  settings = cleaned(next.settings ?? {});
  const forgotten = Object.fromEntries(Object.keys(choices.params ?? {}).map((name) => [name, null]));
  choices = next.choices ?? {};
  showSettings();
  language.reopen();
  show(main);
  sendProject({ params: { ...forgotten, ...choices.params }, camera: null, frame: null, pose: null, ...choices });
  storage.save();
}

/** Replaces the project; the notice has the way back. The text before is kept if it is the user's. */
function replace(next, text, isNextOwn = true) {
  const old = snapshot();
  const wasOwn = storage.isOwn;
  isStopped = false;
  load(next);
  if (JSON.stringify(old.files) === JSON.stringify(next.files)) return;
  storage.isOwn = isNextOwn;
  storage.store(); // makes room
  const isKept = !wasOwn || storePrevious(old);
  notify(isKept ? text : `${text} This browser has no room for the text before: only this button leads to it.`, [
    'Back to the text before',
    () => replace(old, 'This is the text before.', wasOwn),
  ]);
  if (wasOwn && isKept && !$('example').querySelector('[value=before]')) offerBefore();
}

function offerBefore() {
  $('example').append(element('option', 'the text before', { value: 'before' }));
}

// The engine

let picture; // a port to the picture's page
const pageState = {}; // its last messages `view` and `visible`, for a new worker
let isStopped = false; // by the user or after a failure, until the next change
let isReady = false;
let hasEnded = false; // the engine has, because it failed without a picture, too
const kNoWork = {
  isChecking: false, // the language server
  isCompiling: false, // what is rendered next
  isRendering: false,
};
const work = { ...kNoWork };
let sent; // the last {files, main}, as JSON
let compiled; // that of the last scene

const settingsArguments = () => [
  ...(settings.width ? [`--width=${settings.width}`] : []),
  ...(settings.error ? [`--error=${settings.error}%`] : []),
];

/** What is valid of settings. */
function cleaned({ width, error }) {
  const { min, max } = $('width');
  return {
    width: width > 0 ? Math.round(Math.min(Math.max(width, min), max)) : undefined,
    error: error > 0 ? Math.min(error, $('error').max) : undefined,
  };
}

/** `isForced`: the engine compiles unchanged files, too. */
function sendFiles(isForced = true) {
  if (hasEnded) return restartEngine();
  const { files } = snapshot();
  const next = JSON.stringify({ files, main });
  if (isForced || sent !== next) setWork({ isCompiling: isReady && !isStopped });
  sent = next;
  engine.post({ to: 'files', files, main, render: !isStopped });
}
function sendProject(chosen = choices) {
  engine.post({ to: 'settings', arguments: settingsArguments() });
  sendFiles();
  if (Object.keys(chosen).length > 0) engine.post({ to: 'preview', message: { type: 'choose', ...chosen } });
}
const sendFilesSoon = later(100, () => sendFiles(false)); // after the findings, which are wanted first
const sendCursor = later(100, () => {
  const { doc, selection } = view.state;
  engine.post({ to: 'cursor', path: current, ...placeOf(doc, selection.main.head) });
});

function hasChanged() {
  storage.isOwn = true;
  isStopped = false;
  endNotice();
  sendFilesSoon();
  storage.saveSoon();
}

/** `status`: what is said in place of problems, which nobody knows now. */
function forgetEngine(status) {
  isReady = false;
  setWork(kNoWork);
  problems.takeOfScene([]);
  problems.status = status;
}

/** It gets the project when it is ready. */
function restartEngine() {
  forgetEngine('Loading…');
  hasEnded = false;
  engine.restart();
}

/** After a change of what is rendered. */
function renderAgain() {
  isStopped = false;
  sendFiles();
}

function setWork(change) {
  const hadChecks = hasChecks();
  Object.assign(work, change);
  if (hasChecks() && !hadChecks) showCheckingSoon();
  if (!hasChecks() && isReady && problems.status) problems.status = null;
  const isBusy = work.isCompiling || work.isRendering;
  $('render').textContent = isBusy || !isStopped ? 'Stop' : 'Render';
  $('render').disabled = !isBusy && !isStopped;
}

const hasChecks = () => work.isChecking || work.isCompiling;
// Most checks take less.
const showCheckingSoon = later(400, () => {
  if (hasChecks()) problems.status = 'Checking…';
});

function stopOrRender() {
  isStopped = !isStopped;
  if (!isStopped) return sendFiles();
  setWork({ isCompiling: false, isRendering: false });
  if (sent !== compiled) problems.takeOfScene([]);
  announce('Stopped');
  engine.stop(() => {
    notify('The engine did not answer, and has been started again.');
    restartEngine();
  });
}

function takeMessage(message) {
  if (message.from === 'ready') {
    isReady = true;
    language.connect();
    language.update(view, current);
    sendProject();
    for (const kept of Object.values(pageState)) engine.post({ to: 'preview', message: kept });
  } else if (message.from === 'lsp') {
    language.receive(message.message);
  } else if (message.from === 'preview') {
    takePreview(message.message);
  } else if (message.from === 'convert') {
    conversions.get(message.id)?.(message);
    conversions.delete(message.id);
  } else if (message.from === 'failed') {
    takeFailure(message);
  }
}

function takeFailure({ kind, text }) {
  const wasReady = isReady;
  forgetEngine('No checks');
  for (const take of conversions.values()) take({ failure: text });
  conversions.clear();
  if (kind === 'absent') return notify(`There are no pictures and no checks here: ${text}.`, null, true);
  if (!wasReady) return notify(`The engine does not start: ${text}`, ['Try again', restartEngine]);
  const what = kind === 'memory' ? 'The memory of the browser is too small for this scene' : `The engine failed (${text})`;
  if (isStopped) {
    // It was not the picture.
    hasEnded = true;
    return notify(`${what}, also without a picture. The text is kept. It is started again with the next change.`);
  }
  isStopped = true; // the same scene would fail again
  notify(`${what}. It has been started again; the text is kept. The next change is rendered.`);
  restartEngine();
}

let finished; // the last picture that has been announced
function takePreview(message) {
  if (message instanceof ArrayBuffer) {
    const length = new DataView(message).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(message, 4, length)));
    if (header.is_finished && header.scene !== finished) {
      finished = header.scene;
      const percent = (share) => `${Number((100 * share).toPrecision(3))} %`;
      const { error } = header;
      announce(`Picture finished${error ? `, error ${percent(error.value)}, 95 % interval ${percent(error.from)} to ${percent(error.to)}` : ''}`);
    }
    if (header.is_finished) setWork({ isRendering: false });
    return picture?.postMessage(message, [message]);
  }
  if (message.type === 'scene') {
    compiled = sent;
    problems.takeOfScene(message.findings);
    // A correct scene counts as rendering until its `progress` comes, so that Stop stays enabled.
    setWork({ isCompiling: false, isRendering: !isStopped && (message.is_correct || work.isRendering) });
  }
  if (message.type === 'progress') setWork({ isRendering: message.is_running && !isStopped });
  if (message.type === 'failure') setWork({ isRendering: false });
  picture?.postMessage(message);
}

/** Takes a message of the picture's page. */
function takeFromPicture(message) {
  if (message.type === 'open') return goTo(message.place);
  if (message.type === 'view' || message.type === 'visible') pageState[message.type] = message;
  if (message.type === 'choose') {
    const { type, params, ...others } = message;
    const known = (object) => Object.fromEntries(Object.entries(object).filter(([, value]) => value !== null));
    choices = known({ ...choices, ...others, params: known({ ...choices.params, ...params }) });
    storage.saveSoon();
    if (isStopped) renderAgain();
  }
  engine.post({ to: 'preview', message });
}

addEventListener('message', ({ data, source, ports }) => {
  if (source !== $('picture').contentWindow) return;
  if (data === 'picture') {
    picture = ports[0];
    picture.onmessage = (event) => takeFromPicture(event.data);
  } else if (data?.key) {
    // A key of the editor, pressed in the picture.
    view.focus();
    view.contentDOM.dispatchEvent(new KeyboardEvent('keydown', { ...data, bubbles: true, cancelable: true }));
  }
});

/** `column` counts characters from 1, line too. */
function goTo({ path, line, column }) {
  if (!states.has(path)) return;
  show(path);
  goToRange(offsetOf(view.state.doc, { line, column }));
  if (!isShown('text')) notify(`The cursor is at ${path}:${line}:${column}.`, ['Show the text', showText], false);
}
function goToRange(from, to = from) {
  view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: 'center' }) });
  view.focus();
}

// Files

function showFiles() {
  $('files').replaceChildren(
    ...project.names().map((name) => {
      const button = element('button', name === main && states.size > 1 ? `${name} ●` : name, {
        type: 'button',
        title: name === main ? 'This scene is rendered' : '',
        onclick() {
          show(name);
          view.focus();
        },
      });
      button.setAttribute('aria-current', String(name === current));
      const item = element('li', '');
      item.append(button);
      return item;
    }),
  );
}

/** After files were added, renamed or removed. */
function haveFilesChanged(name) {
  current = undefined;
  language.reopen();
  show(name);
  hasChanged();
}

function addFile(name, text) {
  states.set(current, view.state);
  states.set(name, stateOf(name, text));
  haveFilesChanged(name);
}

/** Gives the current file another name. Its changes can still be undone. */
function rename(name) {
  const renamed = view.state.update({ effects: StateEffect.reconfigure.of(extensionsOf(name)) }).state;
  const all = [...states].map(([each, state]) => (each === current ? [name, renamed] : [each, state]));
  states.clear();
  for (const [each, state] of all) states.set(each, state);
  haveFilesChanged(name);
}

const fileDialog = new FileDialog({
  names: project.names,
  current: project.current,
  main: () => main,
  apply({ isNew, name, isMain }) {
    if (isMain) main = name;
    if (isNew) return addFile(name, isScene(name) ? 'scene 1\n' : '');
    rename(name);
  },
  remove() {
    const old = snapshot();
    const { [current]: _, ...files } = old.files;
    replace({ ...old, files }, `${current} is deleted.`);
  },
});

const conversions = new Map(); // functions that take the answer, by its id
const convert = (text) =>
  new Promise((resolve) => {
    const id = Math.random();
    conversions.set(id, resolve);
    engine.post({ to: 'convert', id, text });
  });

/** A JSON config becomes a scene; other files are added, or replace those of the same name. */
async function takeFile(file) {
  if (file.size > kMaxFile) return notify(`${file.name} is too large for this page, which takes 5 MB.`);
  const text = await file.text();
  const name = file.name.replace(/[^\w.-]/g, '-');
  if (!isName(name)) return notify(`${file.name}: a file needs a name that begins with a letter.`);
  if (/\.json$/i.test(name)) {
    if (!isReady) return notify('A config cannot be converted while there is no engine.');
    const answer = await convert(text);
    if (answer.text == null) return notify(`${file.name} cannot be converted: ${answer.failure}`);
    const scene = name.replace(/\.json$/i, '.scene');
    return replace({ files: { [scene]: answer.text }, main: scene, settings }, `${file.name} is a scene now.`, false);
  }
  if (areMixed([...project.names(), name])) return notify(`${name} is the name of a folder here.`);
  if (!states.has(name)) {
    addFile(name, text);
    return notify(`${name} is added.`);
  }
  const old = snapshot();
  replace({ ...old, files: { ...old.files, [name]: text } }, `${name} is replaced.`);
  show(name);
}
const takeFiles = async (files) => {
  for (const file of files) await takeFile(file);
};

// Controls

let hasKey = false; // a key is changing the closed list of examples: Enter opens what it selects

async function openExample(value) {
  if (!value) return;
  $('example').value = '';
  if (value === 'before') {
    const before = storedPrevious();
    if (before) replace(before, 'This is the text before.');
    return;
  }
  const [first, ...others] = value.split(' ');
  try {
    const texts = [first, ...others].map(async (path) => {
      const response = await fetch(`../examples/${path}`);
      if (!response.ok) throw new Error(response.statusText);
      return [path, await response.text()];
    });
    const files = Object.fromEntries(await Promise.all(texts));
    replace({ files, main: first, settings }, `The example ${first} is open.`, false);
  } catch (error) {
    notify(`The example cannot be loaded: ${error.message}`);
  }
}

const isShown = (id) => $(id).getClientRects().length > 0;
function showText() {
  showSide('text');
  view.focus();
}
function showSide(side) {
  endNotice();
  document.body.classList.toggle('shows-picture', side === 'picture');
  for (const each of ['text', 'picture']) $(`show-${each}`).setAttribute('aria-pressed', String(each === side));
}

function showSettings() {
  $('width').value = settings.width ?? '';
  $('error').value = settings.error ?? '';
}

function takeSettings() {
  settings = cleaned({ width: Number($('width').value), error: Number($('error').value) });
  showSettings();
  engine.post({ to: 'settings', arguments: settingsArguments() });
  renderAgain();
  storage.saveSoon();
}

const actions = {
  'notice-close click': () => notify(''),
  'example keydown': (event) => {
    hasKey = event.key !== 'Enter';
    setTimeout(() => (hasKey = false));
    if (event.key !== 'Enter' || !$('example').value) return;
    event.preventDefault();
    openExample($('example').value);
  },
  'example change': () => !hasKey && openExample($('example').value),
  'example blur': () => ($('example').value = ''),
  'open click': () => $('chosen').click(),
  'chosen change': () => takeFiles($('chosen').files).then(() => ($('chosen').value = '')),
  'link click': () => storage.copyLink(),
  'format click': () => {
    formatDocument(view);
    view.focus();
  },
  'width change': takeSettings,
  'error change': takeSettings,
  'render click': stopOrRender,
  'help click': () => $('keys-dialog').showModal(),
  'show-text click': () => showSide('text'),
  'show-picture click': () => showSide('picture'),
  'new-file click': () => fileDialog.open(true),
  'change-file click': () => fileDialog.open(false),
};
for (const [name, action] of Object.entries(actions)) {
  const [id, event] = name.split(' ');
  $(id).addEventListener(event, action);
}

for (const type of ['dragover', 'dragleave', 'drop']) {
  addEventListener(
    type,
    (event) => {
      if (!event.dataTransfer?.types.includes('Files')) return;
      event.preventDefault();
      event.stopPropagation();
      document.body.classList.toggle('is-dropping', type === 'dragover');
      if (type === 'drop') takeFiles([...event.dataTransfer.files]);
    },
    true,
  );
}

// The start

async function startEngine() {
  problems.status = 'Loading…';
  const threads = crossOriginIsolated ? Math.min(16, navigator.hardwareConcurrency || 1) : 1;
  const name = document.body.dataset.engine.split(' ')[threads > 1 ? 1 : 0];
  try {
    engine.start({ module: name ? await compile(name) : null, threads });
  } catch (error) {
    problems.status = 'No checks';
    notify(`The engine cannot be loaded: ${error.message}`, ['Try again', startEngine]);
  }
}

let navigations = 0; // to links

/** The project of the address; null if there is none, or if the address has changed meanwhile. */
async function openLink() {
  const { hash } = location;
  if (hash.length < 2 || hash === '#text') return null; // the latter skips the header
  const navigation = ++navigations;
  try {
    const linked = await fromFragment(hash.slice(1));
    return navigation === navigations ? linked : null;
  } catch (error) {
    if (navigation === navigations) notify(`The link is damaged (${error.message}). What this browser has kept is shown.`);
    return null;
  }
}

async function start() {
  // Before any text is shown, because the page may be loaded once more. A slow network is not waited for.
  if (location.protocol !== 'file:') {
    const isStarted = startServiceWorker(() => view).catch(() => {}); // the browser may refuse all that keeps something
    await Promise.race([isStarted, new Promise((resolve) => setTimeout(resolve, 5000))]);
  }
  const example = new URLSearchParams(location.search).get('example');
  if (location.search) history.replaceState(null, '', location.pathname + location.hash);
  view = new EditorView({ parent: $('editor') });
  const kept = storedOfTab();
  const own = kept ?? storedOfBrowser();
  const first = { files: { 'main.scene': $('first-scene').content.textContent }, main: 'main.scene', settings: kDefaults };
  if (storedPrevious()) offerBefore();
  // The address of a page that is loaded again may be older than what is kept.
  const isLoadedAgain = kept && performance.getEntriesByType('navigation')[0].type === 'reload';
  const linked = isLoadedAgain || location.hash.slice(1) === own?.fragment ? null : await openLink();
  load(own ?? linked ?? first);
  storage.isOwn = own?.isOwn ?? Boolean(own ?? linked);
  if (example) {
    const option = [...$('example').options].find(({ text }) => text === example);
    if (option) await openExample(option.value);
  } else if (own && linked) replace(linked, 'This text is from the link. What this browser had kept is not lost.');
  addEventListener('hashchange', async () => {
    const next = await openLink();
    if (next) replace(next, 'This text is from the link.');
  });
  $('picture').src = $('picture').dataset.src;
  if (location.protocol !== 'file:') return startEngine();
  problems.status = 'No checks';
  notify(`Pages that are opened from a folder cannot compute: there are no pictures and no checks. A server of the folder
    is enough, such as “python3 -m http.server”.`, null, true);
}
start();
