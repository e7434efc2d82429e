// The language client: how the server is started, and what is added to its answers.
'use strict';

const vscode = require('vscode');
const { LanguageClient, RevealOutputChannelOn } = require('vscode-languageclient/node');
const { selector } = require('./selector');

/** The settings as the server takes them: an untrusted workspace is always a sandbox. */
function settings() {
  const { threads, inlayHints, sandbox, trace } = vscode.workspace.getConfiguration('sdlc');
  return { threads, inlayHints, sandbox: sandbox || !vscode.workspace.isTrusted, trace };
}

/** The diagnostic with a link from its code to the page that explains it. */
function withPage(diagnostic) {
  const code = diagnostic.code?.value ?? diagnostic.code;
  if (typeof code !== 'string' || !/^[EWS]\d{3}$/.test(code)) return diagnostic;
  const argument = encodeURIComponent(JSON.stringify([code]));
  diagnostic.code = { value: code, target: vscode.Uri.parse(`command:sdlc.explainCode?${argument}`) };
  return diagnostic;
}

const middleware = {
  handleDiagnostics: (uri, diagnostics, next) => next(uri, diagnostics.map(withPage)),
  workspace: {
    configuration: async (params, token, next) => {
      const answers = await next(params, token);
      return answers.map((answer, i) => (params.items[i].section === 'sdlc' ? settings() : answer));
    },
    didChangeConfiguration: async (_sections, _next) => {},
  },
};

/**
 * @param {string} program the absolute path of sdlc
 * @param {string | undefined} folder the working folder of the server
 * @param {vscode.LogOutputChannel} log
 */
function makeClient(program, folder, log) {
  const args = settings().sandbox ? ['lsp', '--sandbox'] : ['lsp'];
  const client = new LanguageClient('sdlc', 'sdlc', { command: program, args, options: { cwd: folder } }, {
    documentSelector: selector(),
    initializationOptions: settings(),
    middleware,
    outputChannel: log,
    revealOutputChannelOn: RevealOutputChannelOn.Never,
    markdown: { isTrusted: false },
  });
  sendChangedSettings(client);
  return client;
}

function sendChangedSettings(client) {
  const subscription = vscode.workspace.onDidChangeConfiguration((change) => {
    if (!change.affectsConfiguration('sdlc') || !client.isRunning()) return;
    client.sendNotification('workspace/didChangeConfiguration', { settings: { sdlc: settings() } });
  });
  const dispose = client.dispose.bind(client);
  client.dispose = (...args) => {
    subscription.dispose();
    return dispose(...args);
  };
}

module.exports = { makeClient };
