// What takes too long or too much ends with a message, and a page stays in control.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { createEngine, inFolder, native, read, writeBoth } from './support.mjs';

const hostile = {
  'endless.scene': 'scene 1\nfor i in range(1000000000) { if i < 0 { sphere { center: (i, 0, 0), radius: 1 } } }\n',
  'forever.scene': 'scene 1\nfn f(x) = f(x + 1)\nlet n = f(0)\nsphere a { center: (n, 0, 0), radius: 1 }\n',
  'memory.scene': 'scene 1\nlet a = [[i, i, i] for i in range(1e8)]\nsphere b { center: (len(a), 0, 0), radius: 1 }\n',
  'nested.scene': `scene 1\nlet n = ${'('.repeat(200)}1${')'.repeat(200)}\n`,
  'deep.scene': `scene 1\nlet n = ${'('.repeat(127)}1${')'.repeat(127)}\nsphere a { center: (n, 0, 0), radius: 1 }\n`,
  'deep.json': `${'['.repeat(100000)}`,
};

for (const [name, text] of Object.entries(hostile)) {
  test(`${name} ends with the message that it has natively`, () => inFolder(async (folder) => {
    const engine = await createEngine();
    writeBoth(folder, engine, name, text);
    const { stdout } = native(['lint', '--format', 'json', '--limit', 'calls=300', '--limit', `memory=${2 ** 28}`, name], { cwd: folder });
    assert.deepEqual(engine.lint(name), JSON.parse(stdout));
  }));
}

test('a step leaves work, and another text can follow', async () => {
  const engine = await createEngine();
  engine.writeFile('demo.scene', read('examples/demo.scene'));
  engine.startRender('demo.scene', { render: { width: 640, height: 360, samples: 1000000 } });
  assert.equal(engine.stepRender(50).finished, false);
  engine.writeFile('demo.scene', 'scene 1\nsphere ball { radus: 1 }\n');
  const { findings, width } = engine.startRender('demo.scene');
  assert.ok(findings.errors > 0);
  assert.equal(width, undefined);
  assert.throws(() => engine.stepRender(50), { kind: 'parameter' });
});

test('failures with several threads are reported, and the engine goes on', async () => {
  const engine = await createEngine({ threads: 2 });
  assert.throws(() => engine.lint('none.scene'), { kind: 'parameter' });
  engine.writeFile('a.scene', read('examples/demo.scene'));
  engine.startRender('a.scene', { render: { width: 8000, height: 8000, samples: 64 } });
  assert.throws(() => engine.stepRender(10), { kind: 'memory' });
  assert.equal(engine.lint('a.scene').errors, 0);
  engine.close();
});

test('without memory a call fails, and another engine works', async () => {
  const engine = await createEngine({ megabytes: 64 });
  engine.writeFile('demo.scene', read('examples/demo.scene'));
  const large = { render: { width: 8000, height: 8000, samples: 64 } };
  assert.throws(() => { engine.startRender('demo.scene', large); engine.stepRender(10); }, { kind: 'memory' });
  const other = await createEngine();
  other.writeFile('a.scene', 'scene 1\n');
  assert.equal(other.lint('a.scene').errors, 0);
});
