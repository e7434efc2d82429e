// What the tests of the WebAssembly module have in common: engines, the native program, and the texts of the corpora.
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';

export const root = new URL('../../', import.meta.url).pathname;
export const { createEngine, EngineError, hasThreads } =
  await import(pathToFileURL(join(process.env.SDLC_WASM, 'index.mjs')));

/** Calls `use` with a folder that is removed afterwards. */
export async function inFolder(use) {
  const folder = mkdtempSync(join(tmpdir(), 'sdlc-wasm-'));
  try {
    return await use(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Runs the native program. */
export function native(args, options = {}) {
  const result = spawnSync(process.env.SDLC, args, { maxBuffer: 1 << 28, ...options });
  if (result.error) throw result.error;
  return result;
}

/** The files below a folder of the repository, by their paths in it. */
export function filesBelow(folder) {
  return readdirSync(join(root, folder), { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? filesBelow(path) : [path];
  }).sort();
}

export const read = (path) => readFileSync(join(root, path));

/** The texts of a file by their paths: its cases (`--- name ---`), or the blocks of a page; else none. */
export function textsOf(path) {
  const text = read(path).toString();
  const extension = path.endsWith('.txt') ? 'json' : 'scene';
  if (path.endsWith('.md')) {
    return [...text.matchAll(/^```\w+ scene[^\n]*\n(.*?)^```$/gms)].map(([, block], index) => [`${path}/${index}.scene`, block]);
  }
  const [, ...parts] = text.split(/^--- (.*?) ---$\n?/m);
  const texts = [];
  for (let i = 0; i < parts.length; i += 2) texts.push([`${path}/${parts[i]}.${extension}`, parts[i + 1]]);
  return texts;
}

/** Writes a file into a folder and into an engine. */
export function writeBoth(folder, engine, path, content) {
  mkdirSync(join(folder, dirname(path)), { recursive: true });
  writeFileSync(join(folder, path), content);
  engine.writeFile(path, content);
}
