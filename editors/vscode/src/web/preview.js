// Previews by engines of their own, so that a render does not hold up the language server.
'use strict';

const vscode = require('vscode');
const { settings, showText } = require('../client');
const { Previews: Base, frame, makeNonce } = require('../preview');
const { nameOf, uriOf } = require('./uris');

const escape = (text) => text.replaceAll('&', '&amp;').replaceAll('"', '&quot;');

/** The frame around the picture's page: it connects the page to the extension. */
function pageFrame(page, scene) {
  const nonce = makeNonce();
  return frame({
    scene,
    nonce,
    attributes: `srcdoc="${escape(page.replaceAll('@nonce@', nonce))}"`,
    policy: 'img-src data: blob:',
    onMessage: `({ source, data, ports }) => {
      if (source !== document.querySelector('iframe').contentWindow) return globalThis.page?.postMessage(data.message);
      if (data !== 'picture') return passKey(data);
      globalThis.page = ports[0];
      page.onmessage = ({ data }) => editor.postMessage(data);
      editor.postMessage({ type: 'connected' });
    }`,
  });
}

/** Columns count characters, from 1; VS Code counts units of UTF-16 from 0. */
const columnOf = (line, character) => [...line.slice(0, character)].length + 1;
const characterOf = (line, column) => [...line].slice(0, column - 1).join('').length;

class Previews extends Base {
  // The picture would be rendered again when a hidden page is shown.
  options = { enableScripts: true, retainContextWhenHidden: true };

  constructor(server, { engines, files, extensionUri }) {
    super(server);
    this.engines = engines;
    this.files = files;
    this.page = vscode.Uri.joinPath(extensionUri, 'dist/web/picture.html');
    files.onDidChange((changed) => {
      const dirty = new Set(vscode.workspace.textDocuments.filter((each) => each.isDirty).map(({ uri }) => nameOf(uri)));
      this.#change(Object.fromEntries(Object.entries(changed).filter(([name]) => !dirty.has(name))));
    });
    vscode.workspace.onDidChangeTextDocument(({ document }) => {
      if (files.isOurs(document)) this.#change({ [nameOf(document.uri)]: document.getText() });
    });
    vscode.workspace.onDidCloseTextDocument((document) => {
      if (files.isOurs(document)) this.#change({ [nameOf(document.uri)]: files.get(nameOf(document.uri)) });
    });
  }

  locate(uri) {
    return { scene: uri.toString() };
  }

  /** Shows what a camera sees; undefined: the camera of the scene. */
  async showCamera(uri, camera) {
    await this.open(uri);
    const shown = this.shown.get(uri.toString());
    shown.camera = camera;
    this.#choose(shown);
  }

  async show(shown) {
    const { panel, scene } = shown;
    if (shown.isFilled) return;
    shown.isFilled = true;
    panel.webview.onDidReceiveMessage((message) => this.#take(shown, message));
    panel.onDidChangeViewState(() => {
      shown.engine?.post({ to: 'preview', message: { type: 'visible', value: panel.visible } });
    });
    panel.webview.html = pageFrame(new TextDecoder().decode(await vscode.workspace.fs.readFile(this.page)), scene);
  }

  revive(shown) {
    return this.show(shown);
  }

  move(document, { line, character }) {
    const place = {
      path: nameOf(document.uri),
      line: line + 1,
      column: columnOf(document.lineAt(line).text, character),
    };
    for (const { engine } of this.shown.values()) engine?.post({ to: 'cursor', ...place });
  }

  hasEnded(shown) {
    shown.engine?.end();
  }

  async #take(shown, message) {
    if (message.type === 'connected') return this.#start(shown).catch(({ message: text }) => this.#fail(shown, text));
    if (message.type === 'open') return this.#open(message.place);
    shown.engine?.post({ to: 'preview', message });
  }

  async #start(shown) {
    const { panel, scene } = shown;
    const engine = await this.engines.start((message) => {
      if (message.from === 'preview') panel.webview.postMessage({ message: message.message });
      if (message.from === 'failed') this.#fail(shown, message.text);
    });
    if (this.shown.get(scene) !== shown) return engine.end(); // it has been closed in the meantime
    shown.engine?.end();
    shown.engine = engine;
    const texts = vscode.workspace.textDocuments.filter((each) => each.isDirty && this.files.isOurs(each));
    engine.post({
      to: 'changes',
      files: Object.fromEntries(texts.map((document) => [nameOf(document.uri), document.getText()])),
    });
    engine.post({ to: 'preview', message: { type: 'visible', value: panel.visible } });
    this.#choose(shown);
    engine.post({ to: 'show', main: nameOf(vscode.Uri.parse(scene)), sandbox: settings().sandbox });
    const editor = vscode.window.activeTextEditor;
    if (editor) this.follow({ textEditor: editor, selections: editor.selections });
  }

  #choose({ engine, camera }) {
    if (camera) engine?.post({ to: 'preview', message: { type: 'choose', camera } });
  }

  async #fail(shown, text) {
    shown.engine = undefined;
    const again = 'Try Again';
    const choice = await vscode.window.showErrorMessage(`The preview has ended: ${text}.`, again);
    if (choice === again && this.shown.get(shown.scene) === shown) await this.#start(shown);
  }

  #change(files) {
    for (const { engine } of this.shown.values()) engine?.post({ to: 'changes', files });
  }

  async #open({ path, line, column }) {
    const uri = uriOf(path);
    const document = await vscode.workspace.openTextDocument(uri);
    const { text } = document.lineAt(line - 1);
    const position = new vscode.Position(line - 1, characterOf(text, column));
    await showText(uri, new vscode.Range(position, position));
  }
}

module.exports = { Previews };
