// usage: node run.mjs [NAME…]
//
// Drives `sdlc lsp` through its features: a line for each check that fails, and a count. With names, only the checks
// whose names contain one of them, each with a line. Environment: SDLC, the program; SDLC_NODE_MODULES, a folder with
// vscode-languageserver-protocol, vscode-jsonrpc and typescript.
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { checks as diagnostics } from './checks/diagnostics.mjs';
import { checks as layout } from './checks/layout.mjs';
import { checks as life } from './checks/life.mjs';
import { checks as names } from './checks/names.mjs';
import { checks as reading } from './checks/reading.mjs';
import { checks as writing } from './checks/writing.mjs';
import { Client, recorded } from './client.mjs';
import { mistakes } from './shapes.mjs';

const chosen = process.argv.slice(2);
const failures = [];
let count = 0;

function isChosen({ name }) {
  return chosen.length === 0 || chosen.some((part) => name.includes(part));
}

/** Each check has a server and a folder of its own. */
async function run({ name, options, test }) {
  const folder = mkdtempSync(join(tmpdir(), 'sdlc-protocol-'));
  count += 1;
  let client;
  try {
    client = await Client.start(folder, options);
    await test(client);
    if (client.process.exitCode === null) {
      const status = await client.stop();
      if (status !== 0) throw new Error(`the server ended with ${status}`);
    }
    if (chosen.length > 0) console.log(`ok    ${name}`);
  } catch (error) {
    failures.push(name);
    console.log(`FAIL  ${name}\n      ${error.stack}`);
  } finally {
    client?.process.kill('SIGKILL');
    rmSync(folder, { recursive: true, force: true });
  }
}

for (const check of [...life, ...diagnostics, ...writing, ...layout, ...reading, ...names].filter(isChosen)) await run(check);
const wrong = mistakes(recorded);
for (const mistake of wrong) console.log(`SHAPE ${mistake}`);
console.log(`${count - failures.length} of ${count} checks passed; ${recorded.length} messages, ${wrong.length} not as the protocol says`);
process.exit(failures.length + wrong.length > 0 ? 1 : 0);
