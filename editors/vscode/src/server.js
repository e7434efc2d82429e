// The life of the language server: it is restarted when what it depends on changes.
'use strict';

const vscode = require('vscode');
const { State } = require('vscode-languageclient');
const { selector } = require('./selector');

/** The running server and what reports on it. Starts and stops follow each other, never overlap. A subclass has
 * `connect()`, and `help`: what to do without a server, by the titles of buttons. */
class Server {
  constructor(context) {
    this.context = context;
    this.log = vscode.window.createOutputChannel('sdlc', { log: true });
    this.status = vscode.languages.createLanguageStatusItem('sdlc', selector());
    this.status.name = 'sdlc';
    this.status.command = { command: 'sdlc.showLog', title: 'Log' };
    this.client = undefined;
    this.help = {};
    this.isNeeded = false; // since the first document that is ours
    this.hasFailed = false;
    this.stateChanged = new vscode.EventEmitter();
    this.onDidChangeState = this.stateChanged.event;
    this.hasRun = new vscode.EventEmitter();
    this.onDidRun = this.hasRun.event; // also after a crash
    this.queue = Promise.resolve();
    context.subscriptions.push(this.log, this.status);
  }

  /** Starts the server if a document is the first that is ours. */
  async need(document) {
    if (this.isNeeded || vscode.languages.match(selector(), document) === 0) return;
    this.isNeeded = true;
    await this.restart();
  }

  /** Calls one of its commands about a document. */
  ask(command, uri) {
    if (!this.client?.isRunning()) throw new Error('The server is not running, see its log.');
    const argument = { uri: this.client.code2ProtocolConverter.asUri(uri) };
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
      const { client, detail } = await this.connect();
      this.client = client;
      client.onDidChangeState(({ newState }) => newState === State.Running && this.hasRun.fire());
      await client.start();
      const { version } = client.initializeResult.serverInfo;
      this.log.info(`sdlc ${version}: ${detail}`);
      this.#show(`sdlc ${version}`, detail, vscode.LanguageStatusSeverity.Information, false);
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
    const help = { ...this.help, 'Show Log': () => this.log.show() };
    vscode.window.showErrorMessage(error.message, ...Object.keys(help)).then((choice) => help[choice]?.());
  }
}

module.exports = { Server };
