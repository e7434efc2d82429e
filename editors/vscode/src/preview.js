// The page of `sdlc serve` beside the editor: it shows the text as it is, and outlines what the
// statement at the cursor makes.
'use strict';

const { randomBytes } = require('node:crypto');
const path = require('node:path');
const vscode = require('vscode');
const { selector } = require('./selector');

const VIEW_TYPE = 'sdlc.preview';

/**
 * The page of the server, in a frame: it has its own protection. It takes the colours of the editor, not of the
 * system, and passes the keys of the editor on. The editor opens it again after a restart, by its `scene`.
 */
function frame(url, scene) {
  const origin = `${url.scheme}://${url.authority}`;
  const nonce = randomBytes(16).toString('hex');
  const policy = `default-src 'none'; frame-src ${origin}; script-src 'nonce-${nonce}'; style-src 'unsafe-inline'`;
  const literal = (value) => JSON.stringify(value).replaceAll('<', '\\u003c');
  return `<!doctype html>
<html lang="en">
<head>
<meta http-equiv="Content-Security-Policy" content="${policy}">
<style>
html, body, iframe { width: 100%; height: 100%; margin: 0; padding: 0; border: 0; display: block; }
.vscode-dark iframe, .vscode-high-contrast iframe { color-scheme: dark; }
.vscode-light iframe, .vscode-high-contrast-light iframe { color-scheme: light; }
</style>
</head>
<body>
<iframe src="${url.toString(true)}" title="The rendered scene" allow="clipboard-write"></iframe>
<script nonce="${nonce}">
acquireVsCodeApi().setState({ scene: ${literal(scene)} });
addEventListener('message', ({ origin, data }) => {
  if (origin === ${literal(origin)}) dispatchEvent(new KeyboardEvent('keydown', data));
});
</script>
</body>
</html>`;
}

/** Where the window of the editor reaches a page of its server, whose port may be forwarded. */
async function externalUri(local) {
  const external = await vscode.env.asExternalUri(local);
  // A proxy puts the port into the path, and may leave out ours.
  if (external.path.endsWith(local.path)) return external;
  return external.with({ path: external.path.replace(/\/$/, '') + local.path });
}

/** The panels that show scenes. */
class Previews {
  #server;
  #shown = new Map(); // by the URI of the scene: { panel, url }

  constructor(server) {
    this.#server = server;
    server.onDidRun(() => this.#refresh());
  }

  /** Shows the scene of a document, which may be the one that includes it. */
  async open(uri) {
    const { url, scene } = await this.#server.ask('sdlc.preview', { uri: uri.toString() });
    const known = this.#shown.get(scene)?.panel;
    if (known) known.reveal(undefined, true);
    const column = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
    const panel = known ?? vscode.window.createWebviewPanel(VIEW_TYPE, '', column);
    if (!known) this.#take(panel, scene);
    await this.#show(panel, scene, url);
  }

  /** Takes a panel over that the editor had before it was restarted. */
  async deserializeWebviewPanel(panel, state) {
    if (!state?.scene) return panel.dispose();
    this.#take(panel, state.scene);
    if (this.#server.client?.isRunning()) await this.#refresh();
    else if (!this.#server.isNeeded) await this.#server.restart();
  }

  /** The scene has another name now; of a folder, the panel says that the file is gone. */
  async rename({ files }) {
    for (const { oldUri, newUri } of files) {
      const shown = this.#shown.get(oldUri.toString());
      if (!shown) continue;
      shown.panel.dispose();
      try {
        await this.open(newUri);
      } catch (error) {
        this.#server.log.error(`preview of ${newUri}: ${error.message}`);
      }
    }
  }

  /** Sends the place of the cursor to the server. */
  follow({ textEditor, selections }) {
    const { document } = textEditor;
    const { client } = this.#server;
    if (this.#shown.size === 0 || !client?.isRunning()) return;
    // Also a config that a scene includes.
    if (vscode.languages.match(selector(), document) === 0 && document.languageId !== 'json') return;
    const { line, character } = selections[0].active;
    client.sendNotification('sdlc/cursor', {
      textDocument: { uri: document.uri.toString() },
      position: { line, character },
    });
  }

  /** The pages of a new server have other addresses. */
  async #refresh() {
    for (const [scene, { panel }] of [...this.#shown]) {
      try {
        const { url } = await this.#server.ask('sdlc.preview', { uri: scene });
        await this.#show(panel, scene, url);
      } catch (error) {
        this.#server.log.error(`preview of ${scene}: ${error.message}`);
      }
    }
  }

  /** A scene has one panel: the newest. */
  #take(panel, scene) {
    const older = this.#shown.get(scene)?.panel;
    this.#shown.set(scene, { panel });
    older?.dispose();
    panel.title = `Preview ${path.basename(vscode.Uri.parse(scene).fsPath)}`;
    panel.webview.options = { enableScripts: true };
    panel.onDidDispose(() => this.#end(panel, scene));
  }

  async #show(panel, scene, url) {
    const external = await externalUri(vscode.Uri.parse(url, true));
    const shown = this.#shown.get(scene);
    if (shown?.panel !== panel) return; // it has been closed in the meantime
    if (shown.url !== url) panel.webview.html = frame(external, scene);
    shown.url = url;
    const editor = vscode.window.activeTextEditor;
    if (editor) this.follow({ textEditor: editor, selections: editor.selections });
  }

  async #end(panel, scene) {
    if (this.#shown.get(scene)?.panel !== panel) return;
    this.#shown.delete(scene);
    if (this.#server.client?.isRunning()) await this.#server.ask('sdlc.endPreview', { uri: scene });
  }
}

module.exports = { Previews, VIEW_TYPE };
