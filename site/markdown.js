// Markdown of the repository as pages of the site.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import MarkdownIt from 'markdown-it';
import { chartOf } from './charts.js';
import { outputOf, relative, resolve, siteLink } from './sources.js';

/** The anchor that GitHub generates for a heading. */
const anchorOf = (title) =>
  title
    .toLowerCase()
    .replace(/[^\p{L}\p{N}\p{M} _-]/gu, '')
    .replaceAll(' ', '-');

const textOf = (inline) =>
  inline.children.map((token) => (token.type.endsWith('break') ? ' ' : token.content)).join('');

/** Width and height of a PNG file, from its header. */
function sizeOf(path) {
  const bytes = readFileSync(path);
  return bytes.toString('latin1', 12, 16) === 'IHDR' ? [bytes.readUInt32BE(16), bytes.readUInt32BE(20)] : undefined;
}

/** Sets ids of headings and classes of cells, and removes the heads of tables that are empty. */
function prepare(state) {
  const used = new Map();
  state.tokens.forEach((token, i) => {
    if (token.type === 'heading_open') {
      const anchor = anchorOf(textOf(state.tokens[i + 1]));
      const count = used.get(anchor) ?? 0;
      used.set(anchor, count + 1);
      token.attrSet('id', count === 0 ? anchor : `${anchor}-${count}`);
    }
    // The alignment of a column.
    const style = token.attrGet('style');
    if (style) token.attrs = [['class', style.replace('text-align:', '')]];
  });
  for (let i; (i = state.tokens.findIndex((token) => token.type === 'thead_open')) >= 0; ) {
    const end = state.tokens.findIndex((token) => token.type === 'thead_close');
    const head = state.tokens.slice(i, end + 1);
    const isEmpty = head.every((token) => token.content === '');
    head.forEach((token, k) => {
      // An empty cell is the header of nothing.
      if (!token.type.startsWith('th_')) return;
      if (head[k + (token.nesting > 0 ? 1 : -1)].content === '') token.tag = 'td';
      else if (token.nesting > 0) token.attrSet('scope', 'col');
    });
    head[0].type = 'head_open';
    head.at(-1).type = 'head_close';
    if (isEmpty) state.tokens.splice(i, head.length);
  }
}

/** The contents of a page, for its head, its navigation, the search and the collection of files. */
export function examine(md, source, text) {
  const tokens = md.parse(text, { source });
  const sections = [{ title: '', anchor: '', level: 1, text: '' }];
  const links = [];
  tokens.forEach((token, i) => {
    if (token.type === 'heading_open') {
      const level = Number(token.tag.slice(1));
      const title = textOf(tokens[i + 1]);
      if (level === 1) sections[0].title ||= title;
      else sections.push({ title, anchor: token.attrGet('id'), level, text: '' });
    } else if (['inline', 'fence', 'code_block'].includes(token.type) && tokens[i - 1]?.type !== 'heading_open') {
      sections.at(-1).text += ` ${token.type === 'inline' ? textOf(token) : token.content}`;
    }
    for (const child of token.children ?? []) links.push(child.attrGet('href') ?? child.attrGet('src') ?? []);
  });
  const blocks = tokens
    .filter((token) => token.type === 'fence')
    .map(({ info, content }) => ({ words: info.split(' '), content }));
  return { title: sections[0].title, sections, blocks, links: links.flat() };
}

/** A markdown-it that needs `{ source }` as environment. `pages` may be filled later. */
export function makeMarkdown(root, highlight, pages) {
  const md = new MarkdownIt({ html: true, linkify: false });
  const rules = md.renderer.rules;
  const messageLink = (env) => (code) => {
    const page = pages.get(`docs/explain/${code}.md`);
    return page && page.source !== env.source ? relative(outputOf(env.source), page.output) : undefined;
  };
  md.core.ruler.push('prepare', prepare);

  rules.fence = (tokens, i, options, env) => {
    const words = tokens[i].info.split(/\s+/).filter(Boolean);
    const isWrong = words[1]?.endsWith('-wrong');
    const name = /\.\w+$/.test(words[2] ?? '') ? words[2] : '';
    const label = [name, isWrong && 'with a mistake'].filter(Boolean).join(', ');
    const caption = label && `<figcaption>${md.utils.escapeHtml(label)}</figcaption>`;
    const code = highlight(tokens[i].content, words, messageLink(env));
    return `<figure class="code${isWrong ? ' wrong' : ''}">${caption}${code}</figure>\n`;
  };
  rules.code_block = (tokens, i, options, env) =>
    `<figure class="code">${highlight(tokens[i].content, [], messageLink(env))}</figure>\n`;

  rules.link_open = (tokens, i, options, env, self) => {
    const href = tokens[i].attrGet('href');
    // A link with the name of a page as text gets the title of the page.
    if (/^[\w./-]+\.md$/.test(tokens[i + 1].content) && !/^[a-z]+:/.test(href)) {
      tokens[i + 1].content = pages.get(resolve(root, env.source, href).target).title;
    }
    tokens[i].attrSet('href', siteLink(root, env.source, href));
    return self.renderToken(tokens, i, options);
  };
  const image = rules.image;
  rules.image = (tokens, i, options, env, self) => {
    const { target } = resolve(root, env.source, tokens[i].attrGet('src'));
    const [width, height] = sizeOf(join(root, target)) ?? [];
    tokens[i].attrSet('src', relative(outputOf(env.source), outputOf(target)));
    if (width) tokens[i].attrs.push(['width', width], ['height', height]);
    return image(tokens, i, options, env, self);
  };
  rules.heading_close = (tokens, i) => {
    const id = tokens[i - 2].attrGet('id');
    const anchor =
      tokens[i].tag === 'h1' ? '' : `<a class="anchor" href="#${id}" aria-hidden="true" tabindex="-1">#</a>`;
    return `${anchor}</${tokens[i].tag}>\n`;
  };
  rules.table_open = (tokens, i, options, env) =>
    `${chartOf(env.source, tokens, i)}<div class="table" tabindex="0"><table>\n`;
  rules.table_close = () => '</table></div>\n';
  return md;
}
