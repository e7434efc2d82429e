// usage: node build.mjs native|web FOLDER
//
// Makes the folder of a package: the extension with the program, or the one for browsers with the engine in SDLC_WASM,
// the folder of sdlc-wasm. Lists the licences of what is in it.
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { licensesOf } from '../../site/licenses.js';
import { picturePage } from '../../site/playground/picture-page.js';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '../..');
const [target, folder] = [process.argv[2], resolve(process.argv[3])];
const packed = (path) => join(folder, path);

/** Removes from the manifest what needs the program. */
function manifestForBrowsers({ main, sdlc, ...manifest }) {
  const { commands, menus, configuration } = manifest.contributes;
  const isNative = ({ command }) => ['sdlc.renderScene', 'sdlc.measureScene'].includes(command);
  const kept = (entries) => entries.filter((entry) => !isNative(entry));
  manifest.contributes.commands = kept(commands);
  for (const [name, entries] of Object.entries(menus)) menus[name] = kept(entries);
  delete menus['editor/title/run'];
  for (const name of ['sdlc.path', 'sdlc.threads']) delete configuration.properties[name];
  manifest.capabilities = {
    untrustedWorkspaces: {
      supported: 'limited',
      description: 'Scenes may only read files of their own folder.',
      restrictedConfigurations: ['sdlc.sandbox'],
    },
    virtualWorkspaces: true,
  };
  return manifest;
}

function manifestForPrograms({ browser, ...manifest }) {
  return manifest;
}

async function bundle(options) {
  const { metafile } = await build({
    absWorkingDir: here,
    bundle: true,
    external: ['vscode'],
    minify: true,
    legalComments: 'none',
    metafile: true,
    ...options,
  });
  return Object.keys(metafile.inputs);
}

/** The worker: that of the playground, with the engine's own script. */
async function bundleEngine(engine) {
  const parts = mkdtempSync(packed('dist/parts-'));
  cpSync(join(root, 'site/playground/engine.js'), join(parts, 'engine.js'));
  cpSync(join(root, 'wasm/index.mjs'), join(parts, 'index.mjs'));
  cpSync(join(engine, 'sdlc.mjs'), join(parts, 'sdlc.mjs'));
  await bundle({
    entryPoints: [join(parts, 'engine.js')],
    outfile: packed('dist/web/engine.js'),
    format: 'iife',
    target: 'es2022',
    external: ['node:*'],
    define: { 'import.meta.url': '"file:///"' }, // of a blob there is none, and nothing is loaded
  });
  rmSync(parts, { recursive: true });
}

function writeLicenses(bundled, more) {
  const notices = licensesOf(bundled.map((path) => join(here, path))).map(({ name, version, license, text }) => {
    // Indented, as a block of code: licences have headings and lists of their own.
    return `## ${name} ${version}: ${license}\n\n${text.replace(/^(?=.)/gm, '    ')}\n`;
  });
  const title = '# Packages of npm that are part of the extension\n';
  writeFileSync(packed('dist/THIRD_PARTY.md'), [title, ...notices, ...more].join('\n'));
}

rmSync(folder, { recursive: true, force: true });
mkdirSync(packed('dist'), { recursive: true });
for (const name of ['README.md', 'icons', 'language-configuration.json', 'syntaxes']) {
  cpSync(join(here, name), packed(name), { recursive: true });
}
cpSync(join(root, 'LICENSE'), packed('LICENSE.txt'));
const manifest = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8'));
delete manifest.scripts;
delete manifest.devDependencies;
const writeManifest = (json) => writeFileSync(packed('package.json'), `${JSON.stringify(json, null, 2)}\n`);

if (target === 'native') {
  writeManifest(manifestForPrograms(manifest));
  const bundled = await bundle({
    entryPoints: ['src/native/extension.js'],
    outfile: packed('dist/extension.js'),
    platform: 'node',
    format: 'cjs',
    target: 'node18',
  });
  writeLicenses(bundled, []);
} else {
  const engine = process.env.SDLC_WASM;
  writeManifest(manifestForBrowsers(manifest));
  const bundled = await bundle({
    entryPoints: ['src/web/extension.js'],
    outfile: packed('dist/web/extension.js'),
    platform: 'browser',
    format: 'cjs',
    target: 'es2022',
  });
  await bundleEngine(engine);
  cpSync(join(engine, 'sdlc.wasm'), packed('dist/web/sdlc.wasm'));
  writeFileSync(packed('dist/web/picture.html'), picturePage(root));
  writeLicenses(bundled, [readFileSync(join(root, 'wasm/THIRD_PARTY.md'), 'utf8')]);
}
