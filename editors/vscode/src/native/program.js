// Finds the program sdlc and asks it for its version. Independent of VS Code.
'use strict';

const { execFile } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const { sdlc: requirements } = require('../../package.json');

const MINIMUM_VERSION = requirements.minimumVersion;
const VERSION_TIMEOUT_MS = 20_000;

/** sdlc cannot be used. `message` says why, in a sentence for the user. */
class ProgramError extends Error {}

function isProgram(file) {
  try {
    fs.accessSync(file, fs.constants.X_OK);
    return fs.statSync(file).isFile();
  } catch {
    return false;
  }
}

/** The absolute path of `name` on the PATH, or undefined. The working folder is never searched. */
function findOnPath(name, env, platform = process.platform) {
  const extensions = platform === 'win32' ? ['', ...(env.PATHEXT ?? '.EXE').split(';')] : [''];
  const searched = env.PATH ?? env.Path ?? '';
  for (const folder of searched.split(platform === 'win32' ? ';' : ':')) {
    if (!path.isAbsolute(folder)) continue;
    const found = extensions.map((ending) => path.join(folder, name + ending)).find(isProgram);
    if (found) return found;
  }
  return undefined;
}

/**
 * The absolute path of the program that the setting `sdlc.path` names. In an untrusted workspace a
 * path inside the workspace is refused: opening a folder must never run a program of that folder.
 *
 * @param {string} setting a name, an absolute path, or one with `~` or `${workspaceFolder}`
 * @param {{env: object, folder?: string, isTrusted: boolean}} world
 * @throws {ProgramError}
 */
function findProgram(setting, { env, folder, isTrusted }) {
  const name = setting.trim() || 'sdlc';
  if (!/[/\\]/.test(name)) {
    const found = findOnPath(name, env);
    if (found) return found;
    throw new ProgramError(`\`${name}\` is not on the PATH: install sdlc, or set its path.`);
  }
  let file = name.replace(/^~(?=[/\\])/, os.homedir());
  const isOfWorkspace = file.includes('${workspaceFolder}') || !path.isAbsolute(file);
  if (isOfWorkspace && !isTrusted) {
    throw new ProgramError('`sdlc.path` names a program of a workspace that is not trusted.');
  }
  if (isOfWorkspace) {
    if (!folder) throw new ProgramError(`\`sdlc.path\` is \`${name}\`, but no folder is open.`);
    file = path.resolve(folder, file.replace('${workspaceFolder}', () => folder));
  }
  if (isProgram(file)) return file;
  throw new ProgramError(`\`sdlc.path\` is \`${file}\`, where no program is: install sdlc, or correct the path.`);
}

/** Runs the program to its end and resolves to its standard output. */
function run(program, args, options = {}) {
  return new Promise((resolve, reject) => {
    const maxBuffer = 64 * 1024 * 1024;
    execFile(program, args, { maxBuffer, ...options }, (error, stdout, stderr) => {
      if (error) reject(new ProgramError(stderr.trim().split('\n')[0] || error.message));
      else resolve(stdout);
    }).stdin?.end();
  });
}

/** Whether version `a` is `b` or later; both are `major.minor.patch`. */
function isAtLeast(a, b) {
  const [left, right] = [a, b].map((text) => text.split('.').map(Number));
  const differs = left.findIndex((number, i) => number !== right[i]);
  return differs < 0 || left[differs] > right[differs];
}

/**
 * The version of the program, `major.minor.patch`.
 *
 * @throws {ProgramError} if it does not run, is another program, or is older than MINIMUM_VERSION
 */
async function checkedVersion(program) {
  let output;
  try {
    output = await run(program, ['--version'], { timeout: VERSION_TIMEOUT_MS, cwd: os.homedir() });
  } catch (error) {
    throw new ProgramError(`\`${program} --version\` fails: ${error.message}`);
  }
  const version = /^sdlc (\d+\.\d+\.\d+)/.exec(output)?.[1];
  if (!version) throw new ProgramError(`\`${program}\` is another program, not the renderer sdlc.`);
  if (isAtLeast(version, MINIMUM_VERSION)) return version;
  throw new ProgramError(
    `\`${program}\` is sdlc ${version}. This extension needs ${MINIMUM_VERSION} or later: update sdlc.`,
  );
}

module.exports = { MINIMUM_VERSION, ProgramError, checkedVersion, findOnPath, findProgram, isAtLeast, run };
