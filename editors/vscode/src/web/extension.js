// The extension in a browser, with the engine of WebAssembly.
'use strict';

const vscode = require('vscode');
const { activate: register } = require('../activate');
const { ExplainPages } = require('../explain');
const { Server } = require('../server');
const { Client } = require('./client');
const { Engines } = require('./engines');
const { Files } = require('./files');
const { Previews } = require('./preview');

class WebServer extends Server {
  async connect() {
    this.files.forget();
    return { client: new Client(this), detail: 'WebAssembly' };
  }

  async explanations() {
    const file = vscode.Uri.joinPath(this.context.extensionUri, 'dist/web/explain.json');
    return new TextDecoder().decode(await vscode.workspace.fs.readFile(file));
  }
}

let server;

function activate(context) {
  const { extensionUri } = context;
  server = new WebServer(context);
  server.files = new Files(server.log);
  server.engines = new Engines(extensionUri, server.files);
  const previews = new Previews(server, { engines: server.engines, files: server.files, extensionUri });
  server.showCamera = (uri, camera) => previews.showCamera(uri, camera);
  context.subscriptions.push(
    vscode.workspace.onDidOpenTextDocument((document) => server.files.add(document)),
    // Their files have to be read.
    vscode.workspace.onDidChangeWorkspaceFolders(() => server.isNeeded && server.restart()),
  );
  const settings = ['sdlc.sandbox', 'sdlc.configs'];
  return register(context, { server, pages: new ExplainPages(server), previews, settings, commands: {} });
}

function deactivate() {
  return server?.stop();
}

module.exports = { activate, deactivate };
