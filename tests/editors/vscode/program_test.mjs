// How the extension finds sdlc; the same in a real VS Code is in drive.mjs. usage: node --test program_test.mjs
import assert from 'node:assert/strict';
import { chmodSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

const require = createRequire(import.meta.url);
const { MINIMUM_VERSION, ProgramError, checkedVersion, findOnPath, findProgram, isAtLeast } =
  require('../../../editors/vscode/src/native/program.js');

const home = mkdtempSync(join(tmpdir(), 'sdlc-program-'));
after(() => rmSync(home, { recursive: true }));

function makeProgram(name, script, mode = 0o755) {
  const file = join(home, name);
  mkdirSync(join(file, '..'), { recursive: true });
  writeFileSync(file, `#!/bin/sh\n${script}\n`);
  chmodSync(file, mode);
  return file;
}

const version = (text) => `echo "${text}"`;
const sdlc = makeProgram('bin/sdlc', version('sdlc 9.8.7 (1234567)'));
const env = { PATH: `${home}/none::${home}/bin` };
const trusted = { env, folder: home, isTrusted: true };
const untrusted = { ...trusted, isTrusted: false };

test('a name is searched on the PATH, in folders with absolute paths only', () => {
  assert.equal(findOnPath('sdlc', env), sdlc);
  assert.equal(findOnPath('sdlc', { PATH: '.:bin:' }), undefined);
  assert.equal(findOnPath('sdlc', {}), undefined);
});

test('what is no program is not found', () => {
  makeProgram('plain/sdlc', '', 0o644);
  mkdirSync(join(home, 'folder/sdlc'), { recursive: true });
  assert.equal(findOnPath('sdlc', { PATH: `${home}/plain:${home}/folder` }), undefined);
});

test('an empty setting is the default', () => assert.equal(findProgram('  ', trusted), sdlc));

test('a missing program says what to do', () => {
  assert.throws(() => findProgram('nowhere', trusted), /`nowhere` is not on the PATH: install sdlc/);
  assert.throws(() => findProgram('/nowhere/sdlc', trusted), ProgramError);
});

test('paths in the workspace are for trusted ones', () => {
  for (const path of ['./bin/sdlc', 'bin/sdlc', '${workspaceFolder}/bin/sdlc']) {
    assert.equal(findProgram(path, trusted), sdlc);
    assert.throws(() => findProgram(path, untrusted), /not trusted/);
    assert.throws(() => findProgram(path, { ...trusted, folder: undefined }), /no folder is open/);
  }
  assert.equal(findProgram(sdlc, untrusted), sdlc);
});

test('versions are compared by number', () => {
  assert.ok(isAtLeast('0.10.0', '0.9.9'));
  assert.ok(isAtLeast('1.0.0', '1.0.0'));
  assert.ok(!isAtLeast('0.9.9', '0.10.0'));
  assert.ok(!isAtLeast('1.2.3', '2.0.0'));
});

test('the version of a program is checked', async () => {
  assert.equal(await checkedVersion(sdlc), '9.8.7');
  assert.equal(await checkedVersion(makeProgram('least', version(`sdlc ${MINIMUM_VERSION}`))), MINIMUM_VERSION);
  await assert.rejects(checkedVersion(makeProgram('old', version('sdlc 0.0.9 (1234567)'))), /is sdlc 0\.0\.9\. .* needs/);
  await assert.rejects(checkedVersion(makeProgram('other', version('ls 9.1'))), /another program/);
  await assert.rejects(checkedVersion(makeProgram('broken', 'echo sorry >&2; exit 3')), /fails: sorry/);
  await assert.rejects(checkedVersion(join(home, 'nowhere')), /fails/);
});
