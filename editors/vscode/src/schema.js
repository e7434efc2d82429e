// The schema of configs that VS Code's own JSON support uses. While the server runs it is empty: the server completes,
// explains and checks configs itself, and nothing appears twice.
'use strict';

const vscode = require('vscode');

/** The scheme of its address in package.json. */
const SCHEME = 'sdlc-schema';

class ConfigSchema {
  #changed = new vscode.EventEmitter();
  onDidChange = this.#changed.event;

  constructor(server, extensionUri) {
    this.server = server;
    this.file = vscode.Uri.joinPath(extensionUri, 'schemas/sdlc-config.schema.json');
    server.onDidChangeState(() => this.#changed.fire(vscode.Uri.parse(`${SCHEME}://configs/schema.json`)));
  }

  async provideTextDocumentContent() {
    if (this.server.isNeeded && !this.server.hasFailed) return '{}';
    return new TextDecoder().decode(await vscode.workspace.fs.readFile(this.file));
  }
}

module.exports = { ConfigSchema, SCHEME };
