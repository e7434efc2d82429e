// Prints what a query captures in files, by the parser in WebAssembly: for each file its name, then a line
// `BEGIN END CAPTURE` (in bytes) per capture, then `error` if the tree has one.
//
//   captures.mjs QUERY FILE...
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = fileURLToPath(new URL('../../../editors/tree-sitter-sdlc', import.meta.url));
const require = createRequire(join(process.env.SDLC_NODE_MODULES, 'package.json'));
const { Language, Parser, Query } = require('web-tree-sitter');

const [queryFile, ...files] = process.argv.slice(2);
await Parser.init();
const language = await Language.load(readFileSync(join(folder, 'tree-sitter-sdlc.wasm')));
const query = new Query(language, readFileSync(join(folder, 'queries', queryFile), 'utf8'));
const parser = new Parser();
parser.setLanguage(language);

for (const file of files) {
  const text = readFileSync(file, 'utf8');
  const bytes = (index) => Buffer.byteLength(text.slice(0, index));
  const tree = parser.parse(text);
  const lines = query
    .captures(tree.rootNode)
    .map(({ name, node }) => [bytes(node.startIndex), bytes(node.endIndex), name])
    .sort((a, b) => a[0] - b[0] || a[1] - b[1] || (a[2] < b[2] ? -1 : 1))
    .map((line) => line.join(' '));
  console.log([file, ...lines, ...(tree.rootNode.hasError ? ['error'] : [])].join('\n'));
}
