// Workers with the engine. They are made from texts: a worker cannot be loaded from the origin of an extension.
'use strict';

const vscode = require('vscode');
const { Engine } = require('../../../../site/playground/engine-worker');
const { FOLDER } = require('./uris');

class Engines {
  #loading;

  constructor(extensionUri, files) {
    this.extensionUri = extensionUri;
    this.files = files;
  }

  /** Starts one that has all files; `report` takes its messages, as README.md of the playground lists them. */
  async start(report) {
    this.#loading ??= this.#load().catch((error) => {
      this.#loading = undefined;
      throw error;
    });
    const { url, module } = await this.#loading;
    const files = await this.files.all(); // as late as possible
    const engine = new Engine(report, () => new Worker(url, { name: 'sdlc' }));
    engine.start({ module, folder: FOLDER });
    engine.post({ to: 'changes', files });
    return engine;
  }

  /** The module is compiled once. */
  async #load() {
    const read = (name) => vscode.workspace.fs.readFile(vscode.Uri.joinPath(this.extensionUri, 'dist/web', name));
    const [script, binary] = await Promise.all(['engine.js', 'sdlc.wasm'].map(read));
    return {
      url: URL.createObjectURL(new Blob([script], { type: 'text/javascript' })),
      module: await WebAssembly.compile(binary),
    };
  }
}

module.exports = { Engines };
