// The client of the language server in an engine.
'use strict';

const vscode = require('vscode');
const { BaseLanguageClient, BrowserMessageReader, BrowserMessageWriter } = require('vscode-languageclient/browser');
const { clientOf } = require('../client');
const { converters, withPlainPaths } = require('./uris');

class Client extends clientOf(BaseLanguageClient) {
  #engines;
  #files;
  #engine;
  #subscription;

  /** `showCamera(uri, camera)` is what a code lens does: no program renders. */
  constructor({ engines, files, log, showCamera }) {
    super([], { outputChannel: log, uriConverters: converters });
    this.#engines = engines;
    this.#files = files;
    this.#subscription = files.onDidChange((changed) => this.#engine?.post({ to: 'changes', files: changed }));
    const { middleware } = this.clientOptions;
    // The engine has to have the file first; it tells the server itself.
    middleware.workspace.didChangeWatchedFile = ({ uri }) => files.reload(converters.protocol2Code(uri));
    middleware.executeCommand = (command, args, next) => {
      if (command !== 'sdlc.render') return next(command, args);
      const [{ uri, camera }] = args;
      return showCamera(converters.protocol2Code(uri), camera);
    };
  }

  async createMessageTransports() {
    const port = { addEventListener() {}, postMessage: (message) => this.#engine.post({ to: 'lsp', message }) };
    const reader = new BrowserMessageReader(port);
    this.#engine?.end();
    this.#engine = await this.#engines.start((message) => {
      if (message.from === 'lsp') port.onmessage({ data: withPlainPaths(message.message) });
      if (message.from !== 'failed') return;
      this.error(`the engine failed: ${message.text}`, undefined, false);
      reader.fireClose();
    });
    return { reader, writer: new BrowserMessageWriter(port) };
  }

  async dispose(timeout) {
    this.#subscription.dispose();
    try {
      await super.dispose(timeout);
    } finally {
      this.#engine?.end();
    }
  }
}

module.exports = { Client };
