// What the editor knows of scenes: words, by which it colours at once, and the client of the language server.
import { LSPClient, LSPPlugin, Workspace } from '@codemirror/lsp-client';
import * as lsp from '@codemirror/lsp-client';
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { StateEffect, StateField, Text } from '@codemirror/state';
import { Decoration, EditorView, keymap } from '@codemirror/view';
import { tags } from '@lezer/highlight';

const kRoot = 'file:///~sdlc~/'; // no text has it, and no name of a file
const kRootInTexts = new RegExp(`(?<!file://)${kRoot.slice('file://'.length)}`, 'g');
export const uriOf = (name) => kRoot + name;
const nameOf = (uri) => (uri.startsWith(kRoot) ? decodeURIComponent(uri.slice(kRoot.length)) : null);
export const isScene = (name) => name.endsWith('.scene');

// Colours. The classes are those of code on the site.

const classOf = {
  comment: tags.comment,
  string: tags.string,
  number: tags.number,
  keyword: tags.keyword,
  operator: tags.operator,
  type: tags.typeName,
  property: tags.propertyName,
  invalid: tags.invalid,
};
/* global WORDS -- [[class, expression], …] from the TextMate grammar, by the build */
const words = WORDS.map(([name, expression]) => [name, new RegExp(expression, 'y')]);

export const sceneLanguage = [
  StreamLanguage.define({
    name: 'scene',
    startState: () => ({ depth: 0, brackets: 0 }), // of block comments; open ones
    tokenTable: classOf,
    token(stream, state) {
      if (state.depth > 0 || stream.match('/*')) {
        if (state.depth === 0) state.depth = 1;
        while (!stream.eol() && state.depth > 0) {
          if (stream.match('*/')) --state.depth;
          else if (stream.match('/*')) ++state.depth;
          else stream.next();
        }
        return 'comment';
      }
      if (stream.match(/^\/\/.*/)) return 'comment';
      if (stream.match(/^"(?:\\.|[^"\\])*"?/)) return 'string';
      for (const [name, expression] of words) {
        expression.lastIndex = stream.pos;
        const found = expression.exec(stream.string);
        if (!found) continue;
        stream.pos += (found[1] ?? found[0]).length;
        return name;
      }
      if (stream.match(/^[A-Za-z0-9_]+/)) return null;
      const character = stream.next();
      if ('([{'.includes(character)) ++state.brackets;
      if (')]}'.includes(character)) state.brackets = Math.max(0, state.brackets - 1);
      return null;
    },
    indent: ({ brackets }, textAfter, { unit }) => Math.max(0, brackets - (/^\s*[}\])]/.test(textAfter) ? 1 : 0)) * unit,
    languageData: {
      commentTokens: { line: '//', block: { open: '/*', close: '*/' } },
      closeBrackets: { brackets: ['(', '[', '{', '"'] },
      indentOnInput: /^\s*[}\])]$/,
    },
  }),
  syntaxHighlighting(HighlightStyle.define(Object.entries(classOf).map(([name, tag]) => ({ tag, class: name })))),
];

const semanticClass = {
  namespace: 'type', class: 'type', struct: 'function', enumMember: 'number', label: 'property', variable: 'name',
  parameter: 'name',
};
const setColors = StateEffect.define();
const serverColors = StateField.define({
  create: () => Decoration.none,
  update(colors, transaction) {
    for (const effect of transaction.effects) if (effect.is(setColors)) return effect.value;
    return colors.map(transaction.changes);
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** Colours by what names mean. */
async function colorBy(client, view, uri) {
  const { doc } = view.state;
  const { data } = await client.request('textDocument/semanticTokens/full', { textDocument: { uri } });
  if (view.state.doc !== doc) return;
  const { tokenTypes } = client.serverCapabilities.semanticTokensProvider.legend;
  const marks = [];
  for (let i = 0, line = 1, column = 0; i < data.length; i += 5) {
    column = data[i] > 0 ? data[i + 1] : column + data[i + 1];
    line += data[i];
    const from = doc.line(line).from + column;
    const type = tokenTypes[data[i + 3]];
    marks.push(Decoration.mark({ class: semanticClass[type] ?? type }).range(from, from + data[i + 2]));
  }
  view.dispatch({ effects: setColors.of(Decoration.set(marks)) });
}

// The language server

/** All scenes of the project are open, so that the server knows their unsaved texts. */
class Scenes extends Workspace {
  files = [];
  #version = 0;

  constructor(client, project) {
    super(client);
    this.project = project;
  }

  /** After files were added, renamed or removed. */
  reopen() {
    for (const { uri } of this.files) this.client.didClose(uri);
    this.files = this.project
      .names()
      .filter(isScene)
      .map((name) => ({
        uri: uriOf(name),
        name,
        languageId: 'scene',
        version: ++this.#version,
        doc: this.project.doc(name),
        view: null,
        getView() {
          return this.view;
        },
      }));
    for (const file of this.files) this.client.didOpen(file);
  }

  syncFiles() {
    const updates = [];
    for (const file of this.files) {
      const plugin = file.view && LSPPlugin.get(file.view);
      const changes = plugin ? plugin.unsyncedChanges : file.changes;
      if (!changes || changes.empty) continue;
      updates.push({ file, prevDoc: file.doc, changes });
      file.doc = this.project.doc(file.name);
      file.version = ++this.#version;
      file.changes = null;
      plugin?.clear();
    }
    return updates;
  }

  openFile(uri, _language, view) {
    const file = this.getFile(uri);
    if (file) file.view = view;
  }

  closeFile(uri) {
    const file = this.getFile(uri);
    if (file) file.view = null;
  }

  updateFile(uri, update) {
    const file = this.getFile(uri);
    if (!file) return;
    if (file.view) return file.view.dispatch(update);
    file.changes = this.project.change(file.name, update);
    this.client.sync();
  }

  displayFile(uri) {
    if (this.getFile(uri)) this.project.show(nameOf(uri));
    return Promise.resolve(this.getFile(uri)?.view ?? null);
  }
}

const kAllowed = new Set(
  'A BLOCKQUOTE BR CODE DEL EM H1 H2 H3 H4 H5 H6 HR LI OL P PRE SPAN STRONG TABLE TBODY TD TH THEAD TR UL'.split(' '),
);
/** HTML made of the Markdown of comments, which may be of a stranger's scene: other elements become text. */
function sanitized(html) {
  const { body } = new DOMParser().parseFromString(html, 'text/html');
  for (const node of body.querySelectorAll('*')) {
    if (!kAllowed.has(node.tagName)) node.replaceWith(node.textContent);
    for (const { name, value } of [...node.attributes]) {
      if (name !== 'class' && !(name === 'href' && /^https?:/.test(value))) node.removeAttribute(name);
    }
  }
  return body.innerHTML;
}

const isEqual = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/** A page has no flags. */
export const withoutFlags = (message) => message.replace(/(`--limit \w+=N`) allows more/, 'the program allows more with $1');

/**
 * The client for `project` (names(), doc(name), change(name, update), show(name)). `send(message)` gives a message to
 * the server; `onFindings(name, findings)` takes those of a file: `{message, code, severity, at(), fixes}`, where
 * `fixes` are `{title, apply()}`. It is called again when the fixes are known. `onBusy(isBusy)` is called when a text
 * has changed, and when it has been checked.
 */
export class Language {
  #receive = () => {};
  #taken = new Map(); // what was taken last, by URI: {mapping, older, diagnostics, findings, isComplete}
  #colorTimer = 0;

  constructor(project, { send, onFindings, onBusy }) {
    this.project = project;
    this.onFindings = onFindings;
    this.onBusy = onBusy;
    this.transport = {
      send: (text) => send(JSON.parse(text)),
      subscribe: (handler) => (this.#receive = handler),
      unsubscribe: () => (this.#receive = () => {}),
    };
    this.client = new LSPClient({
      sanitizeHTML: sanitized,
      rootUri: kRoot,
      timeout: 60_000, // while it renders on one thread, it answers late
      workspace: (client) => new Scenes(client, project),
      extensions: [
        {
          clientCapabilities: {
            textDocument: {
              publishDiagnostics: { versionSupport: true },
              codeAction: { codeActionLiteralSupport: { codeActionKind: { valueSet: ['quickfix'] } } },
              semanticTokens: { formats: ['relative'] },
            },
          },
          notificationHandlers: {
            'textDocument/publishDiagnostics': (_client, message) => {
              this.#take(message);
              return true;
            },
          },
        },
      ],
    });
  }

  /** With a server that has just been started. */
  connect() {
    if (this.client.connected) this.client.disconnect();
    this.#forget();
    this.client.connect(this.transport);
  }

  /** After files were added, renamed or removed. */
  reopen() {
    this.#forget();
    this.client.workspace.reopen();
  }

  #forget() {
    for (const { mapping, older } of this.#taken.values()) [mapping, ...older].forEach((each) => each.destroy());
    this.#taken.clear();
  }

  /** Names of files in texts are relative. */
  receive(message) {
    this.#receive(JSON.stringify(message).replaceAll(kRootInTexts, ''));
  }

  extension(name) {
    return [
      this.client.plugin(uriOf(name), 'scene'),
      lsp.serverCompletion({ override: true }),
      lsp.hoverTooltips({ hoverTime: 300 }),
      lsp.signatureHelp(),
      keymap.of([
        ...lsp.formatKeymap,
        ...lsp.renameKeymap,
        ...lsp.jumpToDefinitionKeymap,
        ...lsp.findReferencesKeymap,
      ]),
      serverColors,
    ];
  }

  /** After each change of the text that `view` shows, and when it shows another file. */
  update(view, name) {
    this.client.sync();
    clearTimeout(this.#colorTimer);
    this.onBusy(isScene(name) && this.client.connected);
    if (!isScene(name)) return;
    const timer = setTimeout(async () => {
      await colorBy(this.client, view, uriOf(name)).catch(() => {}); // the server checks before it answers
      if (timer === this.#colorTimer) this.onBusy(false);
    }, 120);
    this.#colorTimer = timer;
  }

  async #take({ uri, version, diagnostics }) {
    const { client } = this;
    const name = nameOf(uri);
    const file = client.workspace.getFile(uri);
    if (!name || (file && version != null && version !== file.version)) return;
    const isOurs = this.project.names().includes(name); // also a data file, which is not open
    const doc = file?.doc ?? (isOurs ? this.project.doc(name) : Text.empty);
    const at = ({ line, character }, of = doc) => {
      const { from, to } = of.line(Math.min(line + 1, of.lines));
      return Math.min(from + character, to);
    };
    const last = this.#taken.get(uri);
    const places = diagnostics.map(({ range }) => [at(range.start), at(range.end)]);
    const isKnown =
      last?.isComplete &&
      isEqual(last.diagnostics, diagnostics) &&
      isEqual(last.findings.map((finding) => finding.at()), places);
    if (isKnown) {
      if (version != null && file?.view) this.onBusy(false);
      return; // they keep their fixes
    }
    // Places are followed through later changes.
    const mapping = client.workspaceMapping();
    const findings = diagnostics.map((diagnostic, index) => {
      const message = withoutFlags(diagnostic.message);
      const isSame = (other) =>
        other.code === diagnostic.code && other.message === message && isEqual(other.at(), places[index]);
      return {
        ...diagnostic,
        message,
        at: () => [diagnostic.range.start, diagnostic.range.end].map((place) => mapping.mapPos(uri, at(place))),
        fixes: last?.findings.find(isSame)?.fixes ?? [], // until the new ones are known
      };
    });
    const older = last ? [last.mapping, ...last.older] : []; // of the fixes until then
    const taken = { mapping, older, diagnostics, findings, isComplete: false };
    this.#taken.set(uri, taken);
    this.onFindings(name, findings);
    if (version != null && file?.view) this.onBusy(false);
    const dropOlder = () => older.splice(0).forEach((each) => each.destroy());
    if (!file || findings.length === 0) return dropOlder();
    await new Promise((resolve) => setTimeout(resolve, 100)); // the next key may come
    if (this.#taken.get(uri) !== taken) return;
    const end = { line: doc.lines - 1, character: doc.line(doc.lines).length };
    const actions = await client.request('textDocument/codeAction', {
      textDocument: { uri },
      range: { start: { line: 0, character: 0 }, end },
      context: { diagnostics, only: ['quickfix'] },
    });
    if (this.#taken.get(uri) !== taken) return;
    for (const finding of findings) finding.fixes = [];
    for (const action of actions ?? []) {
      if (!action.edit?.changes) continue;
      const fix = { title: action.title, apply: () => this.#apply(action.edit.changes, mapping) };
      for (const known of action.diagnostics ?? []) {
        const key = JSON.stringify([known.code, known.range]);
        findings.find(({ code, range }) => JSON.stringify([code, range]) === key)?.fixes.push(fix);
      }
    }
    dropOlder();
    taken.isComplete = true;
    this.onFindings(name, findings);
  }

  #apply(changes, mapping) {
    for (const [uri, edits] of Object.entries(changes)) {
      this.client.workspace.updateFile(uri, {
        changes: edits.map(({ range, newText }) => ({
          from: mapping.mapPosition(uri, range.start),
          to: mapping.mapPosition(uri, range.end),
          insert: newText,
        })),
        userEvent: 'fix',
      });
    }
  }
}
