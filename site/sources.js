// What the site is made of: pages from Markdown, and all files that they link to.
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { join, posix } from 'node:path';
import { groups, lastGroup } from './navigation.js';

const isPage = (source) => source.endsWith('.md');
/** Files that browsers show as they are. Others get a page with their text. */
const isCopied = (source) => /\.(png|jpe?g|gif|webp|apng|svg|mp4|webm|html|json)$/.test(source);
export const isExample = (source) => /^examples\/[^/]+\.scene$/.test(source);

/** The file of the site for a source file. The pages of docs/ are at the top, under the same names. */
export function outputOf(source) {
  const path = source.replace(/^docs\//, '');
  if (isExample(source)) return path.replace(/\.scene$/, '.html');
  if (isCopied(source)) return path;
  if (!isPage(source)) return `${path}.html`;
  if (!source.includes('/')) return path.toLowerCase().replace(/\.md$/, '.html').replace('readme.', 'index.');
  return path.replace(/\.md$/, '.html').replace(/README\.html$/, 'index.html');
}

/** The relative link from one file of the site to another. */
export const relative = (from, to) => posix.relative(posix.dirname(from), to);

const isExternal = (href) => /^[a-z]+:/.test(href);

/** The source file and the fragment that a link of a page names. A folder is named by its README.md, if it has one. */
export function resolve(root, source, href) {
  const [path, fragment] = href.split('#');
  let target = path ? posix.join(posix.dirname(source), path).replace(/\/$/, '') : source;
  if (!existsSync(join(root, target))) throw new Error(`${source} links to ${href}, which is not there`);
  if (statSync(join(root, target)).isDirectory() && existsSync(join(root, target, 'README.md'))) target += '/README.md';
  return { target, fragment };
}

/** Where a link of a page leads on the site. */
export function siteLink(root, source, href) {
  if (isExternal(href)) return href;
  const { target, fragment } = resolve(root, source, href);
  return (target === source ? '' : relative(outputOf(source), outputOf(target))) + (fragment ? `#${fragment}` : '');
}

/**
 * All pages, with their headings, and all other files that they link to: those of a linked folder, too.
 * `examine(source, text)` returns the title, the sections and the links of a page.
 */
export function collect(root, examine) {
  const pages = new Map();
  const files = new Set();
  const todo = ['README.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'THIRD_PARTY.md'];
  todo.push(
    ...readdirSync(join(root, 'docs'), { recursive: true })
      .map((name) => `docs/${name}`)
      .filter(isPage)
      .sort(),
  );
  while (todo.length > 0) {
    const source = todo.shift();
    if (pages.has(source) || files.has(source)) continue;
    if (!isPage(source)) {
      files.add(source);
      if (statSync(join(root, source)).isDirectory()) {
        todo.push(...readdirSync(join(root, source)).map((name) => `${source}/${name}`));
      }
      continue;
    }
    const text = readFileSync(join(root, source), 'utf8');
    const page = { source, text, output: outputOf(source), ...examine(source, text) };
    pages.set(source, page);
    todo.push(...page.links.filter((href) => !isExternal(href)).map((href) => resolve(root, source, href).target));
  }
  return { pages, files: [...files] };
}

/** The groups of the navigation with their pages. */
export function navigation(pages) {
  const rest = new Set(pages.keys());
  rest.delete('README.md');
  for (const source of rest) {
    const index = `${posix.dirname(source)}/README.md`;
    if (source !== index && pages.has(index)) rest.delete(source);
  }
  const take = (pattern) => {
    const expression = new RegExp(`^${pattern.replaceAll('.', '\\.').replaceAll('*', '[^/]*')}$`);
    const found = [...rest].filter((source) => expression.test(source));
    if (found.length === 0 && !pattern.includes('*'))
      throw new Error(`site/navigation.js: there is no page ${pattern}`);
    found.forEach((source) => rest.delete(source));
    return found.map((source) => pages.get(source));
  };
  const all = groups.map(({ title, pages: patterns }) => ({ title, pages: patterns.flatMap(take) }));
  all.push({ title: lastGroup, pages: [...rest].map((source) => pages.get(source)) });
  return all.filter((group) => group.pages.length > 0);
}
