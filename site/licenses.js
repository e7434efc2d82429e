// The licences of npm packages that are in a bundle.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

/** The folder of the package that contains a file, or undefined for files of ours. */
const packageOf = (file) => /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1];

/** `{name, version, license, text}` of the packages of bundled files, by their absolute paths. */
export function licensesOf(files) {
  const folders = new Set(files.map(packageOf).filter(Boolean));
  return [...folders].sort().map((folder) => {
    const { name, version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
    const file = readdirSync(folder).find((each) => /^(licen[cs]e|copying)(\.|$)/i.test(each));
    if (!file) throw new Error(`${folder} has no licence`);
    return { name, version, license, text: readFileSync(join(folder, file), 'utf8').trim() };
  });
}
