// Code blocks, coloured when the site is made: shiki finds the tokens, the style sheet has the colours.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { bundledLanguages, createHighlighter } from 'shiki';

// Classes of the style sheet, each with scopes of TextMate grammars. The theme uses the colour #00000N for class N - 1.
const classes = {
  comment: ['comment'],
  string: ['string', 'constant.character'],
  number: ['constant', 'support.constant', 'keyword.other.unit'],
  keyword: ['keyword', 'storage'],
  operator: ['keyword.operator', 'punctuation'],
  type: ['support.class', 'support.type', 'entity.name.type'],
  property: [
    'support.type.property',
    'support.type.property-name',
    'variable.other.member',
    'entity.name.tag',
    'entity.name.label',
  ],
  function: ['entity.name.function', 'support.function'],
  changed: ['markup.changed'],
  invalid: ['invalid'],
};
const names = Object.keys(classes);
const theme = {
  name: 'classes',
  type: 'light',
  fg: '#000000',
  bg: '#ffffff',
  settings: Object.values(classes).map((scope, i) => ({
    scope,
    settings: { foreground: `#00000${(i + 1).toString(16)}` },
  })),
};

const escape = (text) => text.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);

/** The language of a block without info string, by its first word. */
function guess(text) {
  if (/^(error|warning)\[/.test(text)) return 'message';
  if (/^(sphere|camera|render|group|let|material|radius|center|color)\b/.test(text)) return 'scene';
  return /^(sdlc|apt|cat|cd|cmake|cp|for|mkdir|oiiotool|\.\/dev) /.test(text) ? 'sh' : 'text';
}

/** `(text, words) => HTML`, where `words` are those after the fence; `linkOf(code)` is the page of a message. */
export async function makeHighlighter(root, languages) {
  const grammar = (path, name) => ({ ...JSON.parse(readFileSync(join(root, path), 'utf8')), name });
  const scene = grammar('editors/vscode/syntaxes/scene.tmLanguage.json', 'scene');
  const known = new Set(['sh', ...languages].filter((name) => name in bundledLanguages));
  const langs = [scene, grammar('site/message.tmLanguage.json', 'message'), ...known];
  const highlighter = await createHighlighter({ themes: [theme], langs });
  const languageOf = (text, [first, kind = '']) => {
    if (first === undefined) return guess(text);
    // GitHub does not know the language of scenes, so the pages name that of Rust.
    if (first === 'rust') return 'scene';
    if (kind === 'message' || kind === 'session') return 'message';
    return ['scene', 'message'].includes(first) || known.has(first) ? first : 'text';
  };
  return (text, words, linkOf = () => undefined) => {
    const lang = languageOf(text, words);
    const html = highlighter
      .codeToTokensBase(text.trimEnd(), { lang, theme: 'classes' })
      .map((line) =>
        line
          .map(({ content, color }) => {
            const name = names[Number(`0x${(color ?? '#0').slice(1)}`) - 1];
            const code = escape(content);
            return name ? `<span class="${name}">${code}</span>` : code;
          })
          .join(''),
      )
      .join('\n');
    const linked =
      lang !== 'message'
        ? html
        : html.replace(/\[([EWS]\d{3})\]/g, (all, code) =>
            linkOf(code) ? `[<a href="${linkOf(code)}">${code}</a>]` : all,
          );
    return `<pre tabindex="0"><code>${linked}</code></pre>`;
  };
}
