// Formatting.
import assert from 'node:assert/strict';
import { CAMERA, edited } from '../client.mjs';

const OPTIONS = { tabSize: 2, insertSpaces: true };
const UGLY = `scene 1\n${CAMERA}sphere{center:(0,0,0),radius:1,material:diffuse(color:tan)}\nlet  a=1\n`;
const BALL = 'sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }\n';

export const checks = [
  {
    name: 'formatting gives the canonical layout, and nothing the second time',
    async test(client) {
      const { textDocument, text } = client.open('a.scene', UGLY);
      const edits = await client.request('textDocument/formatting', { textDocument, options: OPTIONS });
      const formatted = edited(text, edits);
      assert.equal(formatted, `scene 1\n${CAMERA}${BALL}let a = 1\n`);
      client.change('a.scene', { text: formatted });
      const more = await client.request('textDocument/formatting', { textDocument, options: OPTIONS });
      assert.equal(edited(formatted, more ?? []), formatted);
    },
  },
  {
    name: 'formatting of a range leaves the rest',
    async test(client) {
      const { textDocument, text } = client.open('a.scene', UGLY);
      const range = { start: { line: 3, character: 0 }, end: { line: 4, character: 0 } };
      const edits = await client.request('textDocument/rangeFormatting', { textDocument, range, options: OPTIONS });
      assert.equal(edited(text, edits), UGLY.replace('let  a=1', 'let a = 1'));
    },
  },
  {
    name: 'formatting after a brace formats the statement that ends there',
    async test(client) {
      const { textDocument, text, position } = client.open('a.scene', UGLY.replace('tan)}', 'tan)}|'));
      const edits = await client.request('textDocument/onTypeFormatting', { textDocument, position, ch: '}', options: OPTIONS });
      assert.ok(edited(text, edits).includes(BALL), edited(text, edits));
    },
  },
  {
    name: 'formatting of a broken scene is refused with the reason',
    async test(client) {
      const { textDocument } = client.open('a.scene', 'scene 1\nsphere {\n');
      const outcome = await client.connection.sendRequest('textDocument/formatting', { textDocument, options: OPTIONS }).then(
        (edits) => ({ edits }),
        ({ message }) => ({ message }),
      );
      const reasons = [outcome.message, ...client.messages.map(({ message }) => message)].join('\n');
      assert.match(reasons, /\w+ \w+/);
      assert.ok(!outcome.edits?.length);
    },
  },
];
