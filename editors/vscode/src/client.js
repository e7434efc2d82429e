// The language client: how the server is started, and what is added to its answers.
'use strict';

const vscode = require('vscode');
const { CloseAction, ErrorAction, RevealOutputChannelOn } = require('vscode-languageclient');
const { selector } = require('./selector');

/** The settings as the server takes them: an untrusted workspace is always a sandbox. */
function settings() {
  const { threads, inlayHints, sandbox, trace } = vscode.workspace.getConfiguration('sdlc');
  // A copy: the object of VS Code cannot be sent to a worker.
  return { threads, inlayHints, sandbox: sandbox || !vscode.workspace.isTrusted, trace: { ...trace } };
}

/** The diagnostic with a link from its code to the page that explains it. */
function withPage(diagnostic) {
  const code = diagnostic.code?.value ?? diagnostic.code;
  if (typeof code !== 'string' || !/^[EWS]\d{3}$/.test(code)) return diagnostic;
  const argument = encodeURIComponent(JSON.stringify([code]));
  diagnostic.code = { value: code, target: vscode.Uri.parse(`command:sdlc.explainCode?${argument}`) };
  return diagnostic;
}

/** The group of editors for a text: where it is open, else one without a preview, which it would cover. */
function columnOf(uri) {
  const groups = vscode.window.tabGroups.all;
  const isText = ({ input }) => input instanceof vscode.TabInputText && input.uri.toString() === uri.toString();
  const isPreview = ({ input }) => input instanceof vscode.TabInputWebview && input.viewType.endsWith('sdlc.preview');
  const group = groups.find(({ tabs }) => tabs.some(isText)) ?? groups.find(({ tabs }) => !tabs.some(isPreview));
  return group?.viewColumn ?? vscode.ViewColumn.Beside;
}

/** Shows a text beside a preview. */
function showText(uri, selection, preserveFocus = false) {
  return vscode.window.showTextDocument(uri, { viewColumn: columnOf(uri), preserveFocus, selection });
}

/** Shows a picture beside the text, and a page of `sdlc explain` rendered; other documents as usual. */
async function showDocument(params, next, uri) {
  const page = /\/([EWS]\d{3})\.md$/.exec(uri.path);
  if (page) {
    await vscode.commands.executeCommand('sdlc.explainCode', page[1]);
    return { success: true };
  }
  if (params.selection) {
    const { start, end } = params.selection;
    const selection = new vscode.Range(start.line, start.character, end.line, end.character);
    await showText(uri, selection, !params.takeFocus);
    return { success: true };
  }
  if (!/\.(png|jpe?g|gif|webp|bmp)$/i.test(uri.path)) return next(params);
  const options = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: !params.takeFocus };
  await vscode.commands.executeCommand('vscode.open', uri, options);
  return { success: true };
}

const middleware = (client) => ({
  window: {
    showDocument: (params, next) => showDocument(params, next, client.protocol2CodeConverter.asUri(params.uri)),
  },
  handleDiagnostics: (uri, diagnostics, next) => next(uri, diagnostics.map(withPage)),
  workspace: {
    configuration: async (params, token, next) => {
      const answers = await next(params, token);
      return answers.map((answer, i) => (params.items[i].section === 'sdlc' ? settings() : answer));
    },
    didChangeConfiguration: async (_sections, _next) => {},
  },
});

/** A client that restarts a server that crashes, but not one that never worked. `Base` is a client of the library, made
 * from what `connection` has. */
const clientOf = (Base) => class extends Base {
  #hasStarted = false;
  #subscription;
  #fail;

  constructor(connection, options) {
    super('sdlc', 'sdlc', ...connection, {
      documentSelector: selector(),
      initializationOptions: settings(),
      revealOutputChannelOn: RevealOutputChannelOn.Never,
      initializationFailedHandler: () => false,
      errorHandler: {
        error: (...args) => this.#failed(...args),
        closed: () => this.#closed(),
      },
      ...options,
    });
    this.clientOptions.middleware = middleware(this);
    this.usualHandler = this.createDefaultErrorHandler();
    this.#subscription = vscode.workspace.onDidChangeConfiguration((change) => {
      if (!change.affectsConfiguration('sdlc') || !this.isRunning()) return;
      this.sendNotification('workspace/didChangeConfiguration', { settings: { sdlc: settings() } });
    });
  }

  /** A write fails, not a read, if the server has ended before it is connected. */
  async #failed(error, message, count) {
    if (this.#hasStarted) return this.usualHandler.error(error, message, count);
    this.#fail(error);
    return { action: ErrorAction.Shutdown, handled: true };
  }

  async #closed() {
    if (this.#hasStarted) return this.usualHandler.closed();
    this.#fail(new Error('it ends at once'));
    return { action: CloseAction.DoNotRestart, handled: true };
  }

  /** Resolves when the server has answered; rejects if it ends before that. */
  async start() {
    // A restart after a crash is the usual handler's.
    if (this.#hasStarted) return super.start();
    const failure = new Promise((_, reject) => (this.#fail = reject));
    try {
      await Promise.race([super.start(), failure]);
    } catch (error) {
      throw new Error(`The language server does not start, see the log (${error.message}).`);
    }
    this.#hasStarted = true;
  }

  async dispose(timeout) {
    this.#subscription.dispose();
    if (this.#hasStarted) await super.dispose(timeout);
  }
};

module.exports = { clientOf, settings, showText };
