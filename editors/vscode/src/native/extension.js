// The extension with the program `sdlc` of this machine.
'use strict';

const vscode = require('vscode');
const { activate: register } = require('../activate');
const { ExplainPages } = require('../explain');
const { Server } = require('../server');
const { Client } = require('./client');
const { measure, render } = require('./commands');
const { Previews } = require('./preview');
const { checkedVersion, findProgram, run } = require('./program');

class NativeServer extends Server {
  constructor(context) {
    super(context);
    this.program = undefined;
    this.help = {
      'How to Install': () => {
        const page = vscode.Uri.joinPath(context.extensionUri, 'README.md').with({ fragment: 'install-sdlc' });
        vscode.commands.executeCommand('markdown.showPreview', page);
      },
      'Open Settings': () => vscode.commands.executeCommand('workbench.action.openSettings', 'sdlc.path'),
    };
  }

  async connect() {
    const { isTrusted, workspaceFolders } = vscode.workspace;
    // sdlc runs in the first folder of the workspace.
    const folder = workspaceFolders?.find(({ uri }) => uri.scheme === 'file')?.uri.fsPath;
    const setting = vscode.workspace.getConfiguration('sdlc').get('path');
    this.program = undefined;
    const program = findProgram(setting, { env: process.env, folder, isTrusted });
    await checkedVersion(program);
    this.program = program;
    return { client: new Client(program, folder, this.log), detail: program };
  }

  /** One call for all pages, once per program. */
  async explanations() {
    const { program } = this;
    if (!program) throw new Error('sdlc is missing, see its log');
    if (this.explained?.program !== program) {
      this.explained = { program, text: await run(program, ['explain', '--format', 'json']) };
    }
    return this.explained.text;
  }
}

let server;

function activate(context) {
  server = new NativeServer(context);
  return register(context, {
    server,
    pages: new ExplainPages(server),
    previews: new Previews(server),
    settings: ['sdlc.path', 'sdlc.sandbox', 'sdlc.configs'],
    commands: {
      'sdlc.renderScene': (document) => render(server, document),
      'sdlc.measureScene': (document) => measure(server, document),
    },
  });
}

function deactivate() {
  return server?.stop();
}

module.exports = { activate, deactivate };
