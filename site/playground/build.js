// Writes the playground into the site.
import { createHash } from 'node:crypto';
import { cpSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build as bundle, transform } from 'esbuild';
import { licensesOf } from '../licenses.js';
import { fill, picturePage } from './picture-page.js';

const here = import.meta.dirname;
const escape = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

/** The classes of words with expressions for them, from the TextMate grammar; the first that matches counts. */
function wordsOf({ repository }) {
  const classes = {
    invalid: 'invalid',
    'constant.numeric': 'number',
    'constant.other.color': 'number',
    'constant.language': 'number',
    'keyword.operator': 'operator',
    keyword: 'keyword',
    storage: 'keyword',
    'support.class': 'type',
    'support.type.property-name': 'property',
    'support.type': 'type',
  };
  const keys = ['color', 'number', 'property', 'header', 'import', 'if', 'keyword', 'kind', 'type', 'operator'];
  const rules = keys.flatMap((key) => repository[key].patterns ?? [repository[key]]);
  return rules.flatMap(({ name, match, begin, captures, beginCaptures }) => {
    const scope = name ?? (captures ?? beginCaptures)?.['1']?.name ?? '';
    const found = Object.keys(classes).find((prefix) => scope.startsWith(prefix));
    // The first group is what gets the class of a rule without a name of its own.
    const expression = (match ?? begin)?.replace('(?<list>', '(?:');
    if (!found || !expression) return [];
    return [[classes[found], name ? expression.replace(/\((?!\?)/g, '(?:') : expression]];
  });
}

/**
 * `examples`: those of the site; `first`: the text that is shown at first; `engine`: the folder with the engine's
 * files, which are copied; none: the page says that there is none.
 */
export async function buildPlayground({ root, output, examples, first, engine }) {
  const folder = join(output, 'playground');
  mkdirSync(folder, { recursive: true });
  const read = (path) => readFileSync(join(root, path), 'utf8');
  const write = (name, text) => writeFileSync(join(folder, name), text);
  const local = (name) => readFileSync(join(here, name), 'utf8');

  const grammar = JSON.parse(read('editors/vscode/syntaxes/scene.tmLanguage.json'));
  const { metafile } = await bundle({
    absWorkingDir: here,
    entryPoints: ['playground.js'],
    outfile: join(folder, 'playground.js'),
    bundle: true,
    minify: true,
    format: 'iife',
    metafile: true,
    define: { WORDS: JSON.stringify(wordsOf(grammar)) },
  });
  const inputs = Object.keys(metafile.inputs).map((path) => join(here, path));
  const packages = licensesOf(inputs).map(({ name, version, text }) => `${name} ${version}\n\n${text}\n`);
  const notices = [...packages, ...(engine ? [read('wasm/THIRD_PARTY.md')] : [])];
  write('licenses.txt', notices.join('\n\n---\n\n'));

  write(
    'picture.html',
    picturePage(root).replaceAll(' nonce="@nonce@"', '').replace('href="data:,"', 'href="../assets/icon.svg"'),
  );

  const relative = (path) => path.replace(/^examples\//, '');
  const options = examples.map(({ source, name, dependencies }) => {
    const paths = [source, ...dependencies.filter((each) => each !== source)].map(relative);
    return `<option value="${escape(paths.join(' '))}">${escape(name)}</option>`;
  });
  const engineFiles = engine ? readdirSync(engine).filter((name) => /\.(wasm|m?js)$/.test(name)) : [];
  const modules = ['sdlc.wasm', 'sdlc-threads.wasm'].filter((name) => engineFiles.includes(name));
  const values = { examples: options.join('\n'), first: escape(first), engine: modules.join(' ') };
  write('index.html', fill(local('index.html'), values));
  write('playground.css', local('playground.css'));
  write('engine.js', local('engine.js'));
  for (const name of engineFiles) cpSync(join(engine, name), join(folder, name));

  // What is kept for use without a network. Of the modules only the used one is, when it is loaded.
  const scenes = new Set(examples.flatMap(({ source, dependencies }) => [source, ...dependencies]).map(relative));
  const files = [
    ...readdirSync(folder).filter((name) => !/\.wasm$|^service-worker\.js$/.test(name)),
    '../assets/site.css',
    '../assets/icon.svg',
    ...[...scenes].map((path) => `../examples/${path}`),
  ];
  const hash = createHash('sha256');
  for (const name of [...files, ...modules]) hash.update(name).update(readFileSync(join(folder, name)));
  const define = { FILES: JSON.stringify(files), VERSION: JSON.stringify(hash.digest('hex').slice(0, 12)) };
  const { code } = await transform(local('service-worker.js'), { define, minify: true });
  write('service-worker.js', code);
}
