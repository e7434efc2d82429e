// The checks of the extension in a real VS Code: a line for each, and a count. See README.md.
import { appendFileSync, chmodSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { checks as commands } from './checks/commands.mjs';
import { checks as names } from './checks/names.mjs';
import { checks as reading } from './checks/reading.mjs';
import { checks as trouble, untrusted } from './checks/trouble.mjs';
import { checks as web, shared } from './checks/web.mjs';
import { checks as writing } from './checks/writing.mjs';
import { Workbench } from './workbench.mjs';

const [home, ...chosen] = process.argv.slice(2);
const vsix = join(home, 'sdlc-scene.vsix');
const webVsix = join(home, 'sdlc-scene-web.vsix');
const isChosen = ({ name }) => chosen.length === 0 || chosen.some((part) => name.includes(part));
const counts = { passed: 0, failed: 0 };

/** A program in the home that appends its arguments to a file; returns its path. */
function makeProgram(folder, name, script) {
  mkdirSync(folder, { recursive: true });
  const program = join(folder, name);
  writeFileSync(program, `#!/bin/sh\nprintf '%s\\n' "$*" >>'${program}.calls'\n${script}\n`);
  chmodSync(program, 0o755);
  return program;
}

function linesOf(file) {
  return existsSync(file) ? readFileSync(file, 'utf8').trim().split('\n') : [];
}

async function start(name, options = {}) {
  const folder = join(home, name);
  const bin = join(folder, 'bin');
  makeProgram(bin, 'sdlc', `exec '${process.env.SDLC}' "$@"`);
  options.prepare?.(folder, bin);
  const bench = await Workbench.start(folder, { vsix, path: `${bin}:${process.env.PATH}`, ...options });
  bench.program = (program, script) => makeProgram(bin, program, script);
  bench.calls = (program = 'sdlc') => linesOf(join(bin, `${program}.calls`));
  return bench;
}

async function runChecks(bench, checks) {
  for (const { name, run } of checks.filter(isChosen)) {
    const screen = name.replace(/[^A-Za-z0-9]+/g, '-').slice(0, 60);
    try {
      await run(bench);
      await bench.screenshot(screen);
      counts.passed += 1;
      console.log(`ok    ${name}`);
    } catch (error) {
      counts.failed += 1;
      console.log(`FAIL  ${name}\n      ${error.message}; see ${screen}.png`);
      await bench.screenshot(screen).catch(() => {});
      appendFileSync(join(process.env.SDLC_SCREENS, 'failures.txt'), `${name}\n${error.stack}\n\n`);
      await bench.reset();
    }
  }
}

async function session(name, checks, options) {
  if (!checks.some(isChosen)) return;
  const bench = await start(name, options);
  try {
    await runChecks(bench, checks);
  } finally {
    bench.saveLogs(name);
    await bench.stop();
  }
}

/** The workspace names a program of its own as the server. */
function prepareUntrusted(folder, bin) {
  const evil = makeProgram(bin, 'evil', 'echo "sdlc 9.9.9"');
  mkdirSync(join(folder, 'scenes/.vscode'), { recursive: true });
  writeFileSync(join(folder, 'scenes/.vscode/settings.json'), JSON.stringify({ 'sdlc.path': evil, 'sdlc.sandbox': false }));
}

await session('trusted', [...writing, ...reading, ...names, ...commands, ...trouble]);
await session('untrusted', untrusted, { isTrusting: false, prepare: prepareUntrusted });
if (existsSync(webVsix)) {
  const inBrowser = [...writing, ...reading, ...names, ...commands.filter(shared), ...web];
  const settings = { 'files.autoSave': 'off' };
  await session('web', inBrowser.map((check) => ({ ...check, name: `web: ${check.name}` })), { vsix: webVsix, settings });
}
console.log(`${counts.passed} passed, ${counts.failed} failed`);
process.exitCode = counts.failed > 0 ? 1 : 0;
