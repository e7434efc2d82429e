// Pictures in WebAssembly have the bytes of those of the native kernel for SSE4, which has no fused multiply-add either.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { createEngine, filesBelow, inFolder, native, read, root } from './support.mjs';

const settings = { width: 96, height: 54, samples: 16 };

/** The codes of a PPM file of bytes (P6). */
function codesOf(path) {
  const file = readFileSync(path);
  return file.subarray(file.length - 3 * settings.width * settings.height);
}

function nativePicture(folder, scene, flags) {
  const file = join(folder, 'picture.ppm');
  const sizes = Object.entries(settings).flatMap(([name, value]) => [`--${name}`, `${value}`]);
  const { status, stderr } = native(['render', scene, '-o', file, ...sizes, ...flags], { cwd: root });
  assert.equal(status, 0, `${scene}: ${stderr}`);
  return codesOf(file);
}

function render(engine, scene, options = {}) {
  engine.startRender(scene, { ...options, render: { ...settings, ...options.render } });
  let step;
  do step = engine.stepRender(1000); while (!step.finished);
  return step.pixels.filter((_, i) => i % 4 !== 3);
}

/** How many codes differ, and by how much. */
function difference(codes, expected) {
  let count = 0, largest = 0;
  codes.forEach((code, i) => {
    count += code !== expected[i];
    largest = Math.max(largest, Math.abs(code - expected[i]));
  });
  return count === 0 ? '' : `${count} of ${codes.length} codes differ, by ${largest} at most`;
}

async function engineWithExamples(options) {
  const engine = await createEngine(options);
  for (const path of filesBelow('examples')) engine.writeFile(path, read(path));
  return engine;
}

// One of them nests calls more deeply than the stack of a page allows.
const scenes = filesBelow('examples').filter(
  (path) => /^examples\/[^/]*\.scene$/.test(path) && !path.endsWith('/lorenz.scene'));

test(`${scenes.length} examples`, () => inFolder(async (folder) => {
  const engine = await engineWithExamples();
  const differing = [];
  for (const scene of scenes) {
    const isFilm = /^animation/m.test(read(scene));
    const expected = nativePicture(folder, scene, ['--isa', 'sse4', ...(isFilm ? ['--frames', '1'] : [])]);
    const found = difference(render(engine, scene), expected);
    if (found) differing.push(`${scene}: ${found}`);
  }
  assert.deepEqual(differing, []);
}));

test('the scalar kernel, and double precision', () => inFolder(async (folder) => {
  const engine = await engineWithExamples();
  const scene = 'examples/one-weekend.scene';
  assert.equal(difference(render(engine, scene, { kernel: 'scalar' }),
    nativePicture(folder, scene, ['--kernel', 'scalar'])), '');
  assert.equal(difference(render(engine, scene, { render: { precision: 'double' } }),
    nativePicture(folder, scene, ['--isa', 'sse4', '--precision', 'double'])), '');
}));

test('short steps, and several threads, do not change a picture', async () => {
  const scene = 'examples/demo.scene';
  const [one, two] = [await engineWithExamples(), await engineWithExamples({ threads: 2 })];
  const whole = render(one, scene);
  one.startRender(scene, { render: settings });
  let step, steps = 0;
  do {
    step = one.stepRender(1);
    ++steps;
  } while (!step.finished);
  assert.ok(steps > 1);
  assert.equal(difference(step.pixels.filter((_, i) => i % 4 !== 3), whole), '');
  assert.equal(difference(render(two, scene), whole), '');
  two.close();
});
