// The life of the extension: one language server, restarted when its program or its flags change.
'use strict';

const vscode = require('vscode');
const { State } = require('vscode-languageclient/node');
const { Client } = require('./client');
const { registerCommands } = require('./commands');
const { ExplainPages, SCHEME: EXPLAIN } = require('./explain');
const { Previews, VIEW_TYPE } = require('./preview');
const { checkedVersion, findProgram } = require('./program');
const { ConfigSchema, SCHEME: SCHEMA } = require('./schema');
const { selector } = require('./selector');
const { registerSnippets } = require('./snippets');

/** The running server and what reports on it. Starts and stops follow each other, never overlap. */
class Server {
  constructor(context) {
    this.context = context;
    this.log = vscode.window.createOutputChannel('sdlc', { log: true });
    this.status = vscode.languages.createLanguageStatusItem('sdlc', selector());
    this.status.name = 'sdlc';
    this.status.command = { command: 'sdlc.showLog', title: 'Log' };
    this.client = undefined;
    this.program = undefined;
    this.isNeeded = false; // since the first document that is ours
    this.hasFailed = false;
    this.stateChanged = new vscode.EventEmitter();
    this.onDidChangeState = this.stateChanged.event;
    this.hasRun = new vscode.EventEmitter();
    this.onDidRun = this.hasRun.event; // also after a crash
    this.queue = Promise.resolve();
    context.subscriptions.push(this.log, this.status);
  }

  /** The folder in which sdlc runs: the first of the workspace. */
  folder() {
    return vscode.workspace.workspaceFolders?.find(({ uri }) => uri.scheme === 'file')?.uri.fsPath;
  }

  /** Starts the server if a document is the first that is ours. */
  async need(document) {
    if (this.isNeeded || vscode.languages.match(selector(), document) === 0) return;
    this.isNeeded = true;
    await this.restart();
  }

  /** Calls one of its commands. */
  ask(command, argument) {
    if (!this.client?.isRunning()) throw new Error('The server is not running, see its log.');
    return this.client.sendRequest('workspace/executeCommand', { command, arguments: [argument] });
  }

  restart() {
    this.queue = this.queue.then(async () => {
      await this.#stop();
      await this.#start();
    });
    return this.queue;
  }

  stop() {
    this.queue = this.queue.then(() => this.#stop());
    return this.queue;
  }

  async #stop() {
    const client = this.client;
    this.client = undefined;
    try {
      await client?.dispose();
    } catch (error) {
      this.log.warn(`stopping the server: ${error.message}`);
    }
  }

  async #start() {
    this.isNeeded = true;
    this.#setFailed(false);
    this.status.selector = selector();
    this.#show('sdlc', 'starting', vscode.LanguageStatusSeverity.Information, true);
    try {
      const isTrusted = vscode.workspace.isTrusted;
      const setting = vscode.workspace.getConfiguration('sdlc').get('path');
      this.program = undefined;
      const program = findProgram(setting, { env: process.env, folder: this.folder(), isTrusted });
      const version = await checkedVersion(program);
      this.program = program;
      this.log.info(`sdlc ${version}: ${program}`);
      this.client = new Client(program, this.folder(), this.log);
      this.client.onDidChangeState(({ newState }) => newState === State.Running && this.hasRun.fire());
      await this.client.start();
      this.#show(`sdlc ${version}`, program, vscode.LanguageStatusSeverity.Information, false);
    } catch (error) {
      await this.#stop();
      this.#setFailed(true);
      this.#report(error);
    }
  }

  #setFailed(hasFailed) {
    this.hasFailed = hasFailed;
    this.stateChanged.fire();
  }

  #show(text, detail, severity, busy) {
    Object.assign(this.status, { text, detail, severity, busy });
  }

  /** Shows why there is no server. Does not wait for an answer: a restart must remain possible. */
  #report(error) {
    this.log.error(error.message);
    this.#show('no sdlc', error.message, vscode.LanguageStatusSeverity.Error, false);
    const [help, settings, log] = ['How to Install', 'Open Settings', 'Show Log'];
    vscode.window.showErrorMessage(error.message, help, settings, log).then((choice) => {
      if (choice === help) {
        const page = vscode.Uri.joinPath(this.context.extensionUri, 'README.md').with({ fragment: 'install-sdlc' });
        vscode.commands.executeCommand('markdown.showPreview', page);
      } else if (choice === settings) {
        vscode.commands.executeCommand('workbench.action.openSettings', 'sdlc.path');
      } else if (choice === log) {
        this.log.show();
      }
    });
  }
}

let server;

async function activate(context) {
  server = new Server(context);
  const pages = new ExplainPages(server);
  const previews = new Previews(server);
  const schema = new ConfigSchema(server, context.extensionUri);
  const restartIfNeeded = () => server.isNeeded && server.restart();
  context.subscriptions.push(
    vscode.workspace.registerTextDocumentContentProvider(EXPLAIN, pages),
    vscode.workspace.registerTextDocumentContentProvider(SCHEMA, schema),
    ...registerCommands(server, pages, previews),
    registerSnippets(),
    vscode.workspace.onDidOpenTextDocument((document) => server.need(document)),
    vscode.window.onDidChangeTextEditorSelection((change) => previews.follow(change)),
    vscode.window.registerWebviewPanelSerializer(VIEW_TYPE, previews),
    vscode.workspace.onDidRenameFiles((change) => previews.rename(change)),
    vscode.workspace.onDidGrantWorkspaceTrust(restartIfNeeded),
    vscode.workspace.onDidChangeConfiguration((change) => {
      const needsRestart = ['sdlc.path', 'sdlc.sandbox', 'sdlc.configs'];
      if (needsRestart.some((setting) => change.affectsConfiguration(setting))) restartIfNeeded();
    }),
  );
  for (const document of vscode.workspace.textDocuments) await server.need(document);
}

function deactivate() {
  return server?.stop();
}

module.exports = { activate, deactivate };
