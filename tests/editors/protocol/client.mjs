// A client of `sdlc lsp`: the JSON-RPC of vscode-jsonrpc, and every message recorded.
import { spawn } from 'node:child_process';
import { EventEmitter, once } from 'node:events';
import { mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';

const require = createRequire(join(process.env.SDLC_NODE_MODULES, 'any.js'));
const rpc = require('vscode-jsonrpc/node');
export const protocol = require('vscode-languageserver-protocol/node');

/** Messages of the server, with the type that the protocol gives to each: { type, value }. */
export const recorded = [];

/** The name in vscode-languageserver-protocol of the type of each method. */
const typeNames = new Map(
  Object.entries(protocol)
    .filter(([, value]) => value?.type?.method)
    .map(([name, value]) => [value.type.method, name]),
);

export function record(kind, method, value) {
  const name = typeNames.get(method);
  if (!name) throw new Error(`the protocol has no ${method}`);
  recorded.push({ type: `${kind}<typeof protocol.${name}.type>`, method, value });
}

/** What a modern editor says that it can do. */
export const CAPABILITIES = {
  general: { positionEncodings: ['utf-16'] },
  window: { workDoneProgress: true, showDocument: { support: true }, showMessage: {} },
  workspace: {
    applyEdit: true,
    configuration: true,
    workspaceFolders: true,
    didChangeWatchedFiles: { dynamicRegistration: true },
    workspaceEdit: { documentChanges: true },
    inlayHint: { refreshSupport: true },
    semanticTokens: { refreshSupport: true },
    codeLens: { refreshSupport: true },
  },
  textDocument: {
    codeAction: {
      codeActionLiteralSupport: { codeActionKind: { valueSet: ['quickfix', 'source', 'source.fixAll'] } },
      isPreferredSupport: true,
      resolveSupport: { properties: ['edit'] },
    },
    completion: {
      completionItem: { snippetSupport: true, documentationFormat: ['markdown'], labelDetailsSupport: true, insertReplaceSupport: true },
    },
    documentSymbol: { hierarchicalDocumentSymbolSupport: true },
    hover: { contentFormat: ['markdown', 'plaintext'] },
    publishDiagnostics: { relatedInformation: true, codeDescriptionSupport: true, versionSupport: true },
    rename: { prepareSupport: true },
    semanticTokens: {
      requests: { full: { delta: true }, range: true },
      tokenTypes: [], tokenModifiers: [], formats: ['relative'],
    },
    signatureHelp: { signatureInformation: { documentationFormat: ['markdown'], parameterInformation: { labelOffsetSupport: true } } },
  },
};

/** It only ends a check that fails anyway. */
const PATIENCE_MS = 20_000;

export const CAMERA = 'camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n';

export class Client {
  /**
   * Starts a server in a folder, and initializes it.
   *
   * @param {string} folder
   * @param {{ flags?: string[], capabilities?: object, options?: object, folders?: string[] }} more
   */
  static async start(folder, { flags = [], capabilities = CAPABILITIES, options = {}, folders = [folder] } = {}) {
    const client = new Client();
    client.folder = folder;
    client.settings = { threads: 1, ...options };
    client.events = new EventEmitter();
    client.diagnostics = new Map(); // uri → the last that was published
    client.requests = []; // of the server
    client.messages = []; // window/showMessage
    client.progress = [];
    client.edits = [];
    client.versions = new Map();
    client.process = spawn(process.env.SDLC, ['lsp', ...flags], { cwd: folder, stdio: ['pipe', 'pipe', 'inherit'] });
    client.ended = once(client.process, 'exit');
    client.connection = rpc.createMessageConnection(client.process.stdout, client.process.stdin);
    client.#listen();
    client.process.stdin.on('error', () => {}); // the server may have ended
    client.connection.listen();
    const workspaceFolders = folders.map((path) => ({ uri: pathToFileURL(path).href, name: path }));
    const params = { processId: process.pid, rootUri: null, workspaceFolders, capabilities, initializationOptions: client.settings };
    client.initialized = await client.request('initialize', params);
    client.capabilities = client.initialized.capabilities;
    client.notify('initialized', {});
    return client;
  }

  #listen() {
    const onRequest = (method, answer) =>
      this.connection.onRequest(method, (params) => {
        // Without parameters, vscode-jsonrpc passes its token.
        record('Params', method, rpc.CancellationToken.is(params) ? undefined : params);
        this.requests.push({ method, params });
        this.events.emit('change');
        return answer(params);
      });
    const onNotification = (method, handle) =>
      this.connection.onNotification(method, (params) => {
        record('NotificationParams', method, params);
        handle(params);
        this.events.emit('change');
      });
    onRequest('client/registerCapability', () => null);
    onRequest('workspace/configuration', ({ items }) => items.map(({ section }) => (section === 'sdlc' ? this.settings : null)));
    onRequest('workspace/applyEdit', ({ edit }) => {
      this.edits.push(edit);
      return { applied: true };
    });
    onRequest('window/workDoneProgress/create', () => null);
    onRequest('window/showDocument', () => ({ success: true }));
    onRequest('window/showMessageRequest', ({ actions }) => this.choose?.(actions) ?? null);
    for (const kind of ['inlayHint', 'semanticTokens', 'codeLens']) onRequest(`workspace/${kind}/refresh`, () => null);
    onNotification('textDocument/publishDiagnostics', (params) => this.diagnostics.set(params.uri, params));
    onNotification('window/showMessage', (params) => this.messages.push(params));
    onNotification('window/logMessage', () => {});
    this.connection.onNotification('$/progress', (params) => {
      this.progress.push(params);
      this.events.emit('change');
    });
  }

  /** Waits until `condition` holds; checked after each message of the server. */
  async until(what, condition) {
    for (;;) {
      const result = condition();
      if (result) return result;
      const silence = AbortSignal.timeout(PATIENCE_MS);
      await once(this.events, 'change', { signal: silence }).catch(() => {
        throw new Error(`never happened: ${what}`);
      });
    }
  }

  /** Repeats `attempt`, which asks the server, until its result is truthy: for what the server does in the background. */
  async retry(what, attempt) {
    const end = Date.now() + PATIENCE_MS;
    for (;;) {
      const result = await attempt();
      if (result) return result;
      if (Date.now() > end) throw new Error(`never happened: ${what}`);
    }
  }

  /** A request whose answer is recorded. `token` cancels it. */
  async request(method, params, token) {
    const result = await this.connection.sendRequest(method, params, ...(token ? [token] : []));
    record('Result', method, result);
    return result;
  }

  notify(method, params) {
    this.connection.sendNotification(method, params);
  }

  uri(name) {
    return pathToFileURL(join(this.folder, name)).href;
  }

  /** Writes a file, without a word to the server. */
  write(name, text) {
    mkdirSync(dirname(join(this.folder, name)), { recursive: true });
    writeFileSync(join(this.folder, name), text);
  }

  /** Writes a file, and reports it as an editor does that watches the folder. */
  writeWatched(name, text) {
    this.write(name, text);
    this.notify('workspace/didChangeWatchedFiles', { changes: [{ uri: this.uri(name), type: 1 }] });
  }

  /**
   * Opens a text. Where it has a `|`, that is the cursor, and not part of the text.
   *
   * @returns {{ textDocument: { uri: string }, position: object, text: string }}
   */
  open(name, marked, { languageId = name.endsWith('.json') ? 'json' : 'scene' } = {}) {
    const at = marked.indexOf('|');
    const text = at < 0 ? marked : marked.slice(0, at) + marked.slice(at + 1);
    const uri = this.uri(name);
    if (this.versions.has(uri)) this.notify('textDocument/didClose', { textDocument: { uri } });
    this.diagnostics.delete(uri);
    this.versions.set(uri, 1);
    this.notify('textDocument/didOpen', { textDocument: { uri, languageId, version: 1, text } });
    return { textDocument: { uri }, position: positionAt(text, Math.max(at, 0)), text };
  }

  /** Changes a text; without `range`, all of it. */
  change(name, ...contentChanges) {
    const uri = this.uri(name);
    const version = this.versions.get(uri) + 1;
    this.versions.set(uri, version);
    this.notify('textDocument/didChange', { textDocument: { uri, version }, contentChanges });
    return version;
  }

  /** The diagnostics of a file for which the condition holds, as soon as it does. */
  async findings(name, condition = () => true) {
    const current = () => this.diagnostics.get(this.uri(name))?.diagnostics;
    return this.until(`diagnostics of ${name}`, () => current() && condition(current()) && current());
  }

  /** Waits until a file is checked: until a later one has findings. Returns the findings, which may never have been sent. */
  async checked(name) {
    this.open('sentinel.scene', 'scene 2\n');
    await this.findings('sentinel.scene', (all) => all.length > 0);
    return this.diagnostics.get(this.uri(name))?.diagnostics ?? [];
  }

  /** Ends the server; returns its exit status. */
  async stop() {
    await this.request('shutdown', undefined);
    this.notify('exit');
    const [status] = await this.ended;
    this.connection.dispose();
    return status;
  }
}

/** The position in UTF-16 of an index of a text. */
export function positionAt(text, index) {
  const before = text.slice(0, index).split('\n');
  return { line: before.length - 1, character: before.at(-1).length };
}

function indexAt(text, { line, character }) {
  return text.split('\n').slice(0, line).reduce((sum, row) => sum + row.length + 1, 0) + character;
}

/** The text after edits of the protocol. */
export function edited(text, edits) {
  const sorted = [...edits].sort((a, b) => indexAt(text, b.range.start) - indexAt(text, a.range.start));
  return sorted.reduce(
    (result, { range, newText }) => result.slice(0, indexAt(text, range.start)) + newText + result.slice(indexAt(text, range.end)),
    text,
  );
}

/** The edits of a workspace edit for a document, in both of its forms. */
export function editsFor(workspaceEdit, uri) {
  const changes = workspaceEdit.documentChanges ?? [];
  return workspaceEdit.changes?.[uri] ?? changes.filter((change) => change.textDocument.uri === uri).flatMap((change) => change.edits);
}
