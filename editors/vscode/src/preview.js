// The page of `sdlc serve` beside the editor: it shows the text as it is, and outlines what the
// statement at the cursor makes.
'use strict';

const path = require('node:path');
const vscode = require('vscode');
const { selector } = require('./selector');

/**
 * Only the page of the server, in a frame: it has its own protection. Scripts are enabled for the page; there are none
 * here. It takes the colours of the editor, not of the system.
 */
function frame(url) {
  const origin = `${url.scheme}://${url.authority}`;
  const policy = `default-src 'none'; frame-src ${origin}; style-src 'unsafe-inline'`;
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
<body><iframe src="${url.toString(true)}" title="The rendered scene" allow="clipboard-write"></iframe></body>
</html>`;
}

/** Where the window of the editor reaches a page of its server, whose port may be forwarded. */
async function externalUri(local) {
  const external = await vscode.env.asExternalUri(local);
  // A proxy puts the port into the path, and may leave out ours.
  if (external.path.endsWith(local.path)) return external;
  return external.with({ path: external.path.replace(/\/$/, '') + local.path });
}

/** The panels that show scenes, by the URI of the scene. */
class Previews {
  #server;
  #panels = new Map();

  constructor(server) {
    this.#server = server;
  }

  /** Shows the page at `url`, which is the same for a scene as long as its server runs. */
  async show({ url, scene }) {
    let panel = this.#panels.get(scene);
    if (!panel) {
      const title = `Preview ${path.basename(vscode.Uri.parse(scene).fsPath)}`;
      const column = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
      panel = vscode.window.createWebviewPanel('sdlc.preview', title, column, { enableScripts: true });
      panel.onDidDispose(() => this.#end(scene));
      this.#panels.set(scene, panel);
    } else {
      panel.reveal(undefined, true);
    }
    const html = frame(await externalUri(vscode.Uri.parse(url, true)));
    if (panel.webview.html !== html) panel.webview.html = html;
    const editor = vscode.window.activeTextEditor;
    if (editor) this.follow({ textEditor: editor, selections: editor.selections });
  }

  async #end(scene) {
    this.#panels.delete(scene);
    const { client } = this.#server;
    if (!client?.isRunning()) return;
    await client.sendRequest('workspace/executeCommand', { command: 'sdlc.endPreview', arguments: [{ uri: scene }] });
  }

  /** Sends the place of the cursor to the server. */
  follow({ textEditor, selections }) {
    const { document } = textEditor;
    const client = this.#server.client;
    if (this.#panels.size === 0 || !client?.isRunning()) return;
    if (vscode.languages.match(selector(), document) === 0) return;
    const { line, character } = selections[0].active;
    client.sendNotification('sdlc/cursor', {
      textDocument: { uri: document.uri.toString() },
      position: { line, character },
    });
  }
}

module.exports = { Previews };
