// The files that scenes may read, for engines, which have no access to those of the workspace.
'use strict';

const vscode = require('vscode');
const { selector } = require('../selector');
const { nameOf } = require('./uris');

const MAX_FOLDERS = 2000;
const MAX_FILES = 2000;
const MAX_BYTES = 64 * 1024 * 1024;
const AT_ONCE = 16; // files read

const isScene = (name) => name.endsWith('.scene');
const isOurs = (name) => /\.(scene|sdlc\.json|csv|tsv|xyz)$|^\.sdlc\.toml$/.test(name);
const isJson = (name) => name.endsWith('.json');
const isSkipped = (name) => name.startsWith('.') || name === 'node_modules';

/** Entries of a folder; none where there is no access. */
async function entriesOf(uri) {
  try {
    return await vscode.workspace.fs.readDirectory(uri);
  } catch {
    return [];
  }
}

/** The contents of files by their names in the engine. */
class Files {
  #contents = new Map();
  #reading;
  #changed = new vscode.EventEmitter();
  onDidChange = this.#changed.event; // { name: content or null }

  constructor(log) {
    this.log = log;
  }

  /** All of them, as an object. They are read at the first call, and after `forget()`. */
  async all() {
    this.#reading ??= this.#readAll();
    await this.#reading;
    return Object.fromEntries(this.#contents);
  }

  /** Also those beside a scene that is outside the folders of the workspace. */
  async add(document) {
    if (!this.#reading || !this.isOurs(document) || this.get(nameOf(document.uri)) !== null) return;
    if (vscode.workspace.getWorkspaceFolder(document.uri)) return;
    const known = new Set(this.#contents.keys());
    this.forget();
    const files = Object.entries(await this.all()).filter(([name]) => !known.has(name));
    this.#changed.fire(Object.fromEntries(files));
  }

  /** They are read again when they are needed. */
  forget() {
    this.#reading = undefined;
  }

  get(name) {
    return this.#contents.get(name) ?? null;
  }

  /** Whether scenes may read what a document is a text of. */
  isOurs(document) {
    if (document.isUntitled) return false;
    return this.get(nameOf(document.uri)) !== null || vscode.languages.match(selector(), document) > 0;
  }

  /** A file was written, or is gone. */
  async reload(uri) {
    const name = nameOf(uri);
    await this.#reading?.catch(() => {}); // it may have read the content before, and replaces #contents
    const content = await vscode.workspace.fs.readFile(uri).then((bytes) => bytes, () => null);
    if (content) this.#contents.set(name, content);
    else this.#contents.delete(name);
    this.#changed.fire({ [name]: content });
  }

  /** The folders of the workspace, and those of scenes elsewhere with what is one level below. */
  #roots() {
    const folders = (vscode.workspace.workspaceFolders ?? []).map(({ uri }) => ({ uri, depth: Infinity }));
    const others = vscode.workspace.textDocuments
      .filter((document) => vscode.languages.match(selector(), document) > 0 && !document.isUntitled)
      .filter(({ uri }) => !vscode.workspace.getWorkspaceFolder(uri))
      .map(({ uri }) => ({ uri: vscode.Uri.joinPath(uri, '..'), depth: 1 }));
    return [...folders, ...others];
  }

  /** Breadth first, so that a limit cuts off what is deep. Other JSON files than configs: at or below scenes. */
  async #find() {
    const found = [];
    let folders = this.#roots();
    let count = 0;
    while (folders.length > 0 && count < MAX_FOLDERS) {
      count += folders.length;
      const inner = await Promise.all(folders.map(async ({ uri, depth, isNear }) => {
        const entries = await entriesOf(uri);
        const near = isNear || entries.some(([name]) => isScene(name));
        const of = (type) => entries.filter(([, each]) => (each & type) !== 0).map(([name]) => name);
        const files = of(vscode.FileType.File).filter((name) => isOurs(name) || (near && isJson(name)));
        found.push(...files.map((name) => vscode.Uri.joinPath(uri, name)));
        if (depth === 0) return [];
        return of(vscode.FileType.Directory)
          .filter((name) => !isSkipped(name))
          .map((name) => ({ uri: vscode.Uri.joinPath(uri, name), depth: depth - 1, isNear: near }));
      }));
      folders = inner.flat();
    }
    const scenesFirst = (a, b) => isScene(b.path) - isScene(a.path);
    return { found: found.sort(scenesFirst), isWhole: folders.length === 0 };
  }

  async #readAll() {
    const { found, isWhole } = await this.#find();
    const chosen = found.slice(0, MAX_FILES);
    const contents = new Map();
    let bytes = 0;
    let skipped = found.length - chosen.length;
    const readNext = async () => {
      for (let uri = chosen.shift(); uri; uri = chosen.shift()) {
        try {
          bytes += (await vscode.workspace.fs.stat(uri)).size;
          if (bytes > MAX_BYTES) ++skipped;
          else contents.set(nameOf(uri), await vscode.workspace.fs.readFile(uri));
        } catch (error) {
          this.log.warn(`${uri}: ${error.message}`);
        }
      }
    };
    await Promise.all(Array.from({ length: AT_ONCE }, readNext));
    this.#contents = contents;
    this.log.info(`${contents.size} files read, ${bytes} bytes`);
    if (skipped === 0 && isWhole) return;
    const limits = `${MAX_FILES} files, ${MAX_BYTES / 1024 ** 2} MiB, ${MAX_FOLDERS} folders`;
    vscode.window.showWarningMessage(
      `Not all files of this workspace are known to sdlc in a browser (limits: ${limits}). Imports of others fail.`);
  }
}

module.exports = { Files };
