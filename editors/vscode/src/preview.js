// The page of `sdlc serve` beside the editor: it shows the text as it is, and outlines what the
// statement at the cursor makes.
'use strict';

const vscode = require('vscode');
const { selector } = require('./selector');

const VIEW_TYPE = 'sdlc.preview';

const makeNonce = () => [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16)).join('');
const literal = (value) => JSON.stringify(value).replaceAll('<', '\\u003c');

/**
 * The page in a frame: it takes the colours of the editor, not of the system. The editor opens it again after a
 * restart, by its `scene`. `attributes` are those of the frame; `onMessage` is the text of what takes its messages.
 */
function frame({ scene, attributes, policy, nonce, onMessage }) {
  const common = `default-src 'none'; script-src 'nonce-${nonce}'; style-src 'unsafe-inline'`;
  return `<!doctype html>
<html lang="en">
<head>
<meta http-equiv="Content-Security-Policy" content="${common}; ${policy}">
<style>
html, body, iframe { width: 100%; height: 100%; margin: 0; padding: 0; border: 0; display: block; }
.vscode-dark iframe, .vscode-high-contrast iframe { color-scheme: dark; }
.vscode-light iframe, .vscode-high-contrast-light iframe { color-scheme: light; }
</style>
</head>
<body>
<iframe ${attributes} title="The rendered scene" allow="clipboard-write"></iframe>
<script nonce="${nonce}">
const editor = acquireVsCodeApi();
editor.setState({ scene: ${literal(scene)} });
const passKey = (key) => dispatchEvent(new KeyboardEvent('keydown', key));
addEventListener('message', ${onMessage});
</script>
</body>
</html>`;
}

/** The panels that show scenes. A subclass has
 * - `locate(uri)`: the `scene` of a document, its URI as text, and what else `show()` uses;
 * - `show(shown, located)`: fills a panel; `revive()`: fills those that the editor has opened again;
 * - `move(document, position)`: the cursor is there; `hasEnded(shown)`: the panel is closed. */
class Previews {
  shown = new Map(); // by the URI of the scene: { scene, panel }

  constructor(server) {
    this.server = server;
  }

  /** Shows the scene of a document, which may be the one that includes it. */
  async open(uri) {
    const located = await this.locate(uri);
    const { scene } = located;
    const known = this.shown.get(scene)?.panel;
    if (known) known.reveal(undefined, true);
    const column = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
    const panel = known ?? vscode.window.createWebviewPanel(VIEW_TYPE, '', column, this.options);
    if (!known) this.#take(panel, scene);
    await this.showHere(this.shown.get(scene), located);
  }

  /** Shows what it finds, with the place of the cursor. */
  async showHere(shown, located) {
    await this.show(shown, located);
    const editor = vscode.window.activeTextEditor;
    if (editor) this.follow({ textEditor: editor, selections: editor.selections });
  }

  /** Takes a panel over that the editor had before it was restarted. */
  async deserializeWebviewPanel(panel, state) {
    if (!state?.scene) return panel.dispose();
    this.#take(panel, state.scene);
    await this.revive(this.shown.get(state.scene));
  }

  /** The scene has another name now; of a folder, the panel says that the file is gone. */
  async rename({ files }) {
    for (const { oldUri, newUri } of files) {
      const shown = this.shown.get(oldUri.toString());
      if (!shown) continue;
      shown.panel.dispose();
      try {
        await this.open(newUri);
      } catch (error) {
        this.server.log.error(`preview of ${newUri}: ${error.message}`);
      }
    }
  }

  /** Sends the place of the cursor. */
  follow({ textEditor, selections }) {
    const { document } = textEditor;
    if (this.shown.size === 0) return;
    // Also a config that a scene includes.
    if (vscode.languages.match(selector(), document) === 0 && document.languageId !== 'json') return;
    this.move(document, selections[0].active);
  }

  /** A scene has one panel: the newest. */
  #take(panel, scene) {
    const older = this.shown.get(scene)?.panel;
    const shown = { scene, panel };
    this.shown.set(scene, shown);
    older?.dispose();
    panel.title = `Preview ${vscode.Uri.parse(scene).path.split('/').at(-1)}`;
    panel.webview.options = { enableScripts: true };
    panel.onDidDispose(() => {
      if (this.shown.get(scene) === shown) this.shown.delete(scene);
      this.hasEnded(shown);
    });
  }
}

module.exports = { Previews, VIEW_TYPE, frame, makeNonce };
