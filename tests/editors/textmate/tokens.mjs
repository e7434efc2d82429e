// Prints the tokens of files by the TextMate grammar: for each file its name, then a line `BEGIN END SCOPE...`
// (in bytes) per token; space between tokens is left out.
//
//   tokens.mjs FILE...
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const require = createRequire(join(process.env.SDLC_NODE_MODULES, 'package.json'));
const { INITIAL, Registry, parseRawGrammar } = require('vscode-textmate');
const oniguruma = require('vscode-oniguruma');

const grammarFile = fileURLToPath(new URL('../../../editors/vscode/syntaxes/scene.tmLanguage.json', import.meta.url));
await oniguruma.loadWASM(readFileSync(require.resolve('vscode-oniguruma/release/onig.wasm')));
const registry = new Registry({
  onigLib: {
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  },
  loadGrammar: () => parseRawGrammar(readFileSync(grammarFile, 'utf8'), grammarFile),
});
const grammar = await registry.loadGrammar('source.scene');

for (const file of process.argv.slice(2)) {
  const lines = [file];
  let stack = INITIAL;
  let begin = 0;
  for (const line of readFileSync(file, 'utf8').split('\n')) {
    // Editors pass lines without their ends.
    const text = line.replace(/\r$/, '');
    const bytes = (index) => begin + Buffer.byteLength(text.slice(0, index));
    const { tokens, ruleStack } = grammar.tokenizeLine(text, stack);
    for (const { startIndex, endIndex, scopes } of tokens) {
      if (scopes.length === 1 && text.slice(startIndex, endIndex).trim() === '') continue;
      lines.push([bytes(startIndex), bytes(endIndex), ...scopes].join(' '));
    }
    stack = ruleStack;
    begin += Buffer.byteLength(line) + 1;
  }
  console.log(lines.join('\n'));
}
