/**
 * sdlc in a page, in a worker or in Node: the checker, the formatter, the language server and the renderer.
 *
 * An engine computes on the thread that calls it, so a page makes it in a worker. All functions but `createEngine` are
 * synchronous. Files are in memory: scenes, and what they import, include or read. Relative paths start at `/`, or at
 * the folder of `enterFolder()`.
 */

const isNode = typeof process === 'object' && process.versions?.node !== undefined;

/** Why a call failed. `kind`:
 * - `parameter`: a parameter is missing or wrong, such as a file that is not there;
 * - `memory`: there is no memory left; other calls may still work;
 * - `defect`: sdlc is at fault;
 * - `dead`: the stack was exhausted or the module was at fault; make another engine. */
export class EngineError extends Error {
  constructor(kind, message) {
    super(message);
    this.name = 'EngineError';
    this.kind = kind;
  }
}

/** The bytes of a file beside this one. */
async function bytesOf(name) {
  const url = new URL(name, import.meta.url);
  if (isNode) return (await import('node:fs')).readFileSync(url);
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

/** Whether this page may use several threads: its server has to send the headers
 * `Cross-Origin-Opener-Policy: same-origin` and `Cross-Origin-Embedder-Policy: require-corp`. */
export function hasThreads() {
  return typeof SharedArrayBuffer === 'function' && (isNode || globalThis.crossOriginIsolated === true);
}

/** What `sdlc-threads.mjs` uses in Node, and modules do not have. */
async function makeNodeGlobals() {
  const { createRequire } = await import('node:module');
  globalThis.require ??= createRequire(import.meta.url);
  globalThis.__dirname ??= new URL('.', import.meta.url).pathname;
}

/** Makes an engine.
 * @param {object} [options]
 * @param {number} [options.threads] of renders, 1 to 64; more than 1 only where `hasThreads()`. Default: 1.
 * @param {number} [options.megabytes] of memory at most, 64 to 2048. Default: 2048.
 * @param {WebAssembly.Module} [options.module] the compiled `sdlc.wasm`, or `sdlc-threads.wasm` for several threads, so
 *   that many engines take one compilation. Default: it is loaded.
 * @returns {Promise<Engine>} */
export async function createEngine({ threads = 1, megabytes = 2048, module: compiled } = {}) {
  const isShared = threads > 1;
  if (isShared && !hasThreads()) throw new EngineError('parameter', 'this page may not use several threads');
  if (isShared && isNode) await makeNodeGlobals();
  const name = isShared ? 'sdlc-threads' : 'sdlc';
  const pages = (count) => count * 16;
  const memory = new WebAssembly.Memory({ initial: pages(64), maximum: pages(megabytes), shared: isShared });
  const [{ default: createModule }, wasmModule] =
    await Promise.all([import(`./${name}.mjs`), compiled ?? bytesOf(`${name}.wasm`).then(WebAssembly.compile)]);
  const module = await new Promise((resolve, reject) => createModule({
    instantiateWasm(imports, receive) {
      WebAssembly.instantiate(wasmModule, imports).then((instance) => receive(instance, wasmModule)).catch(reject);
      return {};
    },
    wasmMemory: memory,
    threads: threads - 1,  // beside the one that calls
    print() {},
    printErr() {},
  }).then(resolve, reject));
  return new Engine(module, memory, threads);
}

/** See createEngine(). Parameters that several functions have:
 * - `limits`: numbers by the names of `sdlc lint --limit`: `{steps: 1e8, calls: 10000}`;
 * - `sets`: values of params by their names, as text: `{count: "12"}`;
 * - `sandbox`: true: no file outside the folder of the scene is read. */
export class Engine {
  #module;
  #memory;
  #threads;
  #isDead = false;

  constructor(module, memory, threads) {
    this.#module = module;
    this.#memory = memory;
    this.#threads = threads;
  }

  /** Whether every call fails now. */
  get isDead() { return this.#isDead; }

  /** The threads of renders. */
  get threads() { return this.#threads; }

  /** Of sdlc: "0.2.0". */
  get version() { return this.#call('version', {}).version; }

  // Files

  /** Relative paths start at this folder, which is made. @param {string} path */
  enterFolder(path) {
    this.#module.FS.mkdirTree(path);
    this.#module.FS.chdir(path);
  }

  /** @param {string} path @param {string | Uint8Array} content UTF-8 or bytes; replaces a file */
  writeFile(path, content) {
    const folder = path.slice(0, path.lastIndexOf('/') + 1);
    if (folder) this.#module.FS.mkdirTree(folder);
    this.#module.FS.writeFile(path, content);
  }

  /** @param {string} path */
  removeFile(path) {
    const { FS } = this.#module;
    FS.unlink(path);
    const parents = path.split('/').slice(0, -1);
    try {
      for (; parents.length > 0; parents.pop()) FS.rmdir(parents.join('/'));
    } catch {}  // it has other files
  }

  // Texts

  /** The findings of a scene, a config or a data file, as `sdlc lint --format json` prints them, by the `.sdlc.toml`
   * of its folder. @returns {{diagnostics: object[], failures: object[]}} */
  lint(file, options = {}) { return this.#call('lint', { ...options, file }); }

  /** The text of a file after its safe fixes; with `unsafe`, also after those that are guesses.
   * @returns {{text: string, applied: number, refused: number, findings: object}} */
  fix(file, options = {}) { return this.#call('fix', { ...options, file }); }

  /** A scene in the canonical layout. `lines`: [first, last], from 1: only statements that touch these lines.
   * @returns {{text: string | null, findings: object}} null: it has syntax errors */
  format(text, options = {}) { return this.#call('format', { ...options, text }); }

  /** A JSON config as a scene, or a scene as a config. `frame`, `camera`, `tone`: what a config holds only one of.
   * @returns {{text: string | null, findings: object}} null: there are errors */
  convert(file, options = {}) { return this.#call('convert', { ...options, file }); }

  /** The page that explains a code such as `E104`, in Markdown; null if there is none. */
  explain(code) { return this.#call('explain', { code }).page; }

  /** Passes a message of the Language Server Protocol (its JSON text) to the language server, and returns those that it
   * sends: answers and findings. Checks are made before it returns. @returns {string[]} */
  receive(message) { return this.#call('receive', { message }).messages; }

  // Pictures

  /** Begins to render a scene; ends the render before. Further options, as those of `sdlc render`:
   * - `render`: settings by their names in scenes: `{width: 320, height: 180, samples: 64, error: 0.01, seed: 1}`;
   * - `camera` is one of them; `frame`: of an animation; `pose`: `{from: [x, y, z], at: [x, y, z]}`;
   * - `seconds`: a time limit; `adaptive`, `denoise`: true or false; `kernel`: auto, scalar, wide or bvh.
   * @returns {object} `findings`, `cameras`, `animation` ({first, last}), and if the scene has no errors `width`,
   * `height`, `spheres`, `kernel`, `backend`. */
  startRender(file, options = {}) {
    return this.#call('start', { ...options, file, render: { threads: this.#threads, ...options.render } });
  }

  /** Renders for about so many milliseconds.
   * @returns {object} `finished`; `width`, `height`; `samples` and `rays` so far; `share`, from 0 to 1, of the work;
   * `seconds` since the start; once they are known, `error` (relative, of the whole picture) and `interval` ([min,
   * max], 95 %); `pixels`, a Uint8ClampedArray of red, green, blue and 255, row by row from the top. */
  stepRender(milliseconds = 100) {
    const step = this.#call('step', { milliseconds });
    const begin = this.#module._sdlc_pixels();
    step.pixels = new Uint8ClampedArray(4 * step.width * step.height);
    step.pixels.set(new Uint8Array(this.#memory.buffer, begin, step.pixels.length));
    return step;
  }

  /** What is seen in a pixel, counted from the top left: null, or `distance`, `name`, `place` and `material`, the latter
   * two as `{file, line, column}` from 1, or null. */
  pick(x, y) { return this.#call('pick', { x, y }).sphere; }

  /** Ends the render and frees its memory. */
  endRender() { this.#call('end', {}); }

  /** Ends the engine and its threads. */
  close() {
    this.#isDead = true;
    this.#module.PThread?.terminateAllThreads();
  }

  // A picture page: the messages are those of docs/serve.md

  /** Begins to show a scene, as `sdlc serve` does; of the options of startRender() it takes `render` and
   * `sandbox`, and `arguments`, those of the command `sdlc render` that the page shows. */
  startPreview(file, options = {}) {
    this.#call('start_preview', { ...options, file, render: { threads: this.#threads, ...options.render } });
  }

  /** `files`: true: they have changed; `cursor`: `{path, line, column}`, where it is; `stop`: true: ends the render, and
   * keeps its picture. */
  changePreview(change) { this.#call('change_preview', change); }

  /** @param {object} message from the page; `open` is for the caller */
  sendToPreview(message) { this.#call('send_to_preview', { message: JSON.stringify(message) }); }

  /** Compiles what has changed, renders for about so many milliseconds, and answers.
   * @returns {object} `messages` to the page, JSON texts; `picture`: the binary message, an ArrayBuffer or null; `hasWork`:
   * whether the picture is not finished. */
  stepPreview(milliseconds = 30) {
    const { messages, picture_bytes: size, has_work: hasWork } = this.#call('step_preview', { milliseconds });
    let picture = null;
    if (size > 0) {
      const begin = this.#module._sdlc_preview_picture();
      picture = new Uint8Array(new Uint8Array(this.#memory.buffer, begin, size)).buffer;
    }
    return { messages, picture, hasWork };
  }

  #call(name, parameters) {
    if (this.#isDead) throw new EngineError('dead', 'this engine has failed; make another one');
    const { failure, result } = JSON.parse(this.#callText(name, JSON.stringify(parameters)));
    if (failure) throw new EngineError(failure.kind, failure.message);
    return result;
  }

  #callText(name, parameters) {
    const pointers = [name, parameters].map((text) => this.#copied(text));
    try {
      return this.#module.UTF8ToString(this.#module._sdlc_call(...pointers));
    } catch (error) {
      this.#isDead = true;
      const isStack = error instanceof RangeError || error.name === 'InternalError';  // the latter in Firefox
      throw new EngineError('dead', isStack ? 'the stack is exhausted' : `the module failed: ${error.message}`);
    } finally {
      if (!this.#isDead) pointers.forEach((pointer) => this.#module._free(pointer));
    }
  }

  #copied(text) {
    const size = this.#module.lengthBytesUTF8(text) + 1;
    const pointer = this.#module._malloc(size);
    if (pointer === 0) throw new EngineError('memory', 'out of memory');
    this.#module.stringToUTF8(text, pointer, size);
    return pointer;
  }
}
