// The life of a server: start, settings, cancellation, the log, the end.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { CAPABILITIES, protocol } from '../client.mjs';

const UTF8 = structuredClone(CAPABILITIES);
UTF8.general.positionEncodings = ['utf-8', 'utf-16'];

export const checks = [
  {
    name: 'the server introduces itself',
    async test(client) {
      assert.equal(client.initialized.serverInfo.name, 'sdlc');
      assert.match(client.initialized.serverInfo.version, /^\d+\.\d+\.\d+$/);
      assert.equal(client.capabilities.textDocumentSync.change, protocol.TextDocumentSyncKind.Incremental);
    },
  },
  {
    name: 'positions are UTF-16 unless the client offers UTF-8',
    async test(client) {
      assert.equal(client.capabilities.positionEncoding ?? 'utf-16', 'utf-16');
      client.open('a.scene', 'scene 1\nlet a = "\u{1F30D}" + lenght\n');
      const [finding] = await client.findings('a.scene', (all) => all.length > 0);
      assert.deepEqual(finding.range.start, { line: 1, character: 15 });
    },
  },
  {
    name: 'positions are UTF-8 if the client offers it',
    options: { capabilities: UTF8 },
    async test(client) {
      assert.equal(client.capabilities.positionEncoding, 'utf-8');
      client.open('a.scene', 'scene 1\nlet a = "\u{1F30D}" + lenght\n');
      const [finding] = await client.findings('a.scene', (all) => all.length > 0);
      assert.deepEqual(finding.range.start, { line: 1, character: 17 });
    },
  },
  {
    name: 'an unknown request is refused, and an unknown notification ignored',
    async test(client) {
      await assert.rejects(client.connection.sendRequest('sdlc/nothing', {}), { code: protocol.ErrorCodes?.MethodNotFound ?? -32601 });
      client.notify('sdlc/nothing', {});
      client.open('a.scene', 'scene 2\n');
      await client.findings('a.scene');
    },
  },
  {
    name: 'a cancelled request is answered',
    async test(client) {
      const { textDocument } = client.open('a.scene', `scene 1\n${'let a = 1 + 2\n'.repeat(2000)}`);
      const source = new protocol.CancellationTokenSource();
      const answer = client.connection.sendRequest('textDocument/documentSymbol', { textDocument }, source.token);
      source.cancel();
      const outcome = await answer.then(() => 'answered', ({ code }) => code);
      assert.ok(['answered', protocol.LSPErrorCodes.RequestCancelled].includes(outcome), `${outcome}`);
    },
  },
  {
    name: 'the sandbox refuses files outside the folder of the scene',
    options: { flags: ['--sandbox'] },
    async test(client) {
      client.write('outside.scene', 'scene 1\nlet a = 1\n');
      client.open('scenes/a.scene', 'scene 1\nimport "../outside.scene" as o\n');
      const [finding] = await client.findings('scenes/a.scene', (all) => all.length > 0);
      assert.match(finding.message, /sandbox|outside/);
    },
  },
  {
    name: 'the log has the messages, if the trace is on',
    options: { flags: ['--log', 'server.log'], options: { trace: { server: 'messages' } } },
    async test(client) {
      client.open('a.scene', 'scene 2\n');
      await client.findings('a.scene');
      assert.match(readFileSync(join(client.folder, 'server.log'), 'utf8'), /textDocument\/didOpen/);
    },
  },
  {
    name: 'an exit without shutdown is status 1',
    async test(client) {
      client.notify('exit');
      assert.deepEqual(await client.ended, [1, null]);
    },
  },
  {
    name: 'the end of the input ends the server',
    async test(client) {
      await client.until('the requests of the server', () => client.requests.length === 2);
      client.process.stdin.end();
      assert.deepEqual(await client.ended, [1, null]);
    },
  },
];
