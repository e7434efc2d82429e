// Bundles the extension into dist/extension.js, and lists the licences of what is bundled with it.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const folder = dirname(fileURLToPath(import.meta.url));

const { metafile } = await build({
  absWorkingDir: folder,
  entryPoints: ['src/extension.js'],
  outfile: 'dist/extension.js',
  bundle: true,
  platform: 'node',
  format: 'cjs',
  target: 'node18',
  external: ['vscode'],
  minify: true,
  legalComments: 'none',
  metafile: true,
});

/** The folder of the package that contains a bundled file, or undefined for files of ours. */
function packageOf(file) {
  return /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1];
}

function licenseText(path) {
  const name = readdirSync(path).find((file) => /^(licen[cs]e|copying)(\.|$)/i.test(file));
  if (!name) throw new Error(`${path} has no licence`);
  // Indented, as a block of code: licences have headings and lists of their own.
  return readFileSync(join(path, name), 'utf8').trim().replace(/^(?=.)/gm, '    ');
}

const folders = [...new Set(Object.keys(metafile.inputs).map(packageOf).filter(Boolean))].sort();
const notices = folders.map((path) => {
  const { name, version, license } = JSON.parse(readFileSync(join(folder, path, 'package.json'), 'utf8'));
  return `## ${name} ${version}: ${license}\n\n${licenseText(join(folder, path))}\n`;
});
const title = '# Packages that are part of dist/extension.js\n';
writeFileSync(join(folder, 'dist/THIRD_PARTY.md'), [title, ...notices].join('\n'));
