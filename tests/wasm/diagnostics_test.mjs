// Every text of the corpora has the same findings in WebAssembly as natively, with the same limit on calls.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { createEngine, filesBelow, inFolder, native, read, textsOf, writeBoth } from './support.mjs';

// Findings that differ, because sizes have 32 bits, and because the stack ends before the limit on calls is reached.
const known = ['lists_that_functions_look_through_are_steps', 'expressions_and_calls_inside_each_other'];

const isText = (path) => /\.(scene|json)$/.test(path);

function nativeFindings(folder, path) {
  const { stdout, stderr } = native(['lint', '--format', 'json', '--limit', 'calls=300', path], { cwd: folder });
  assert.notEqual(stdout.length, 0, `${path}: ${stderr}`);
  return JSON.parse(stdout);
}

async function compare(files, texts) {
  await inFolder(async (folder) => {
    const engine = await createEngine();
    for (const [path, content] of [...files, ...texts]) writeBoth(folder, engine, path, content);
    const differing = [];
    let findings = 0;
    for (const [path] of texts) {
      const expected = nativeFindings(folder, path);
      findings += expected.diagnostics.length;
      try {
        assert.deepEqual(engine.lint(path), expected);
      } catch (error) {
        differing.push(`${path}: ${error.message}`);
        if (engine.isDead) break;
      }
    }
    assert.equal(differing.length, 0, `${differing.length} of ${texts.length} differ:\n${differing.slice(0, 5).join('\n')}`);
    return findings;
  });
}

for (const folder of ['mistakes', 'lint', 'lower', 'eval', 'syntax', 'convert', 'format', 'json']) {
  // Some ask for a file of the machine.
  const texts = filesBelow(`tests/files/${folder}`).flatMap(textsOf).filter(
    ([path, text]) => !text.includes('/etc/') && !known.some((name) => path.includes(`/${name}.`)));
  test(`${texts.length} cases of tests/files/${folder}`, () => compare([], texts));
}

for (const folder of ['tests/files/planted', 'tests/files/frozen', 'tests/files/whole', 'examples']) {
  const files = filesBelow(folder).map((path) => [path, read(path)]);
  const texts = files.filter(([path]) => isText(path));
  test(`${texts.length} files of ${folder}`, () => compare(files, texts));
}

const blocks = filesBelow('docs').filter((path) => path.endsWith('.md')).flatMap(textsOf);
test(`${blocks.length} blocks of the pages`, () => compare([], blocks));
