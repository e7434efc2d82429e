// Previews by `sdlc serve`, which the language server starts.
'use strict';

const vscode = require('vscode');
const { Previews: Base, frame, makeNonce } = require('../preview');

/** The page of the server, which has its own protection. It passes the keys of the editor on. */
function serverFrame(url, scene) {
  const origin = `${url.scheme}://${url.authority}`;
  return frame({
    scene,
    nonce: makeNonce(),
    attributes: `src="${url.toString(true)}"`,
    policy: `frame-src ${origin}`,
    onMessage: `({ origin, data }) => origin === ${JSON.stringify(origin)} && passKey(data)`,
  });
}

/** Where the window of the editor reaches a page of its server, whose port may be forwarded. */
async function externalUri(local) {
  const external = await vscode.env.asExternalUri(local);
  // A proxy puts the port into the path, and may leave out ours.
  if (external.path.endsWith(local.path)) return external;
  return external.with({ path: external.path.replace(/\/$/, '') + local.path });
}

class Previews extends Base {
  constructor(server) {
    super(server);
    server.onDidRun(() => this.#refresh());
  }

  locate(uri) {
    return this.server.ask('sdlc.preview', uri);
  }

  async show(shown, { url, scene }) {
    const external = await externalUri(vscode.Uri.parse(url, true));
    if (this.shown.get(scene) !== shown) return; // it has been closed in the meantime
    if (shown.url !== url) shown.panel.webview.html = serverFrame(external, scene);
    shown.url = url;
  }

  async revive() {
    if (this.server.client?.isRunning()) await this.#refresh();
    else if (!this.server.isNeeded) await this.server.restart();
  }

  move(document, { line, character }) {
    const { client } = this.server;
    if (!client?.isRunning()) return;
    client.sendNotification('sdlc/cursor', {
      textDocument: { uri: document.uri.toString() },
      position: { line, character },
    });
  }

  /** The pages of a new server have other addresses. */
  async #refresh() {
    for (const [scene, shown] of [...this.shown]) {
      try {
        await this.showHere(shown, await this.locate(vscode.Uri.parse(scene)));
      } catch (error) {
        this.server.log.error(`preview of ${scene}: ${error.message}`);
      }
    }
  }

  async hasEnded({ scene }) {
    if (this.shown.has(scene) || !this.server.client?.isRunning()) return; // another panel shows it
    await this.server.ask('sdlc.endPreview', vscode.Uri.parse(scene));
  }
}

module.exports = { Previews };
