// The client of `sdlc lsp`.
'use strict';

const { LanguageClient } = require('vscode-languageclient/node');
const { clientOf, settings } = require('../client');

class Client extends clientOf(LanguageClient) {
  /**
   * @param {string} program the absolute path of sdlc
   * @param {string | undefined} folder the working folder of the server
   * @param {vscode.LogOutputChannel} log
   */
  constructor(program, folder, log) {
    const args = settings().sandbox ? ['lsp', '--sandbox'] : ['lsp'];
    super([{ command: program, args, options: { cwd: folder } }], { outputChannel: log });
  }
}

module.exports = { Client };
