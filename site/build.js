// Makes the site: `node build.js ROOT PROGRAM CACHE OUTPUT`. CONTRIBUTING.md says what is where.
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, extname, join, posix, relative as pathBetween } from 'node:path';
import { fileURLToPath } from 'node:url';
import Eleventy from '@11ty/eleventy';
import { build as bundle } from 'esbuild';
import { missingCharts } from './charts.js';
import { Renderer, descriptionOf } from './examples.js';
import { makeHighlighter } from './highlight.js';
import { examine, makeMarkdown } from './markdown.js';
import { buildPlayground } from './playground/build.js';
import { collect, isExample, navigation, outputOf, relative } from './sources.js';
import { searchIndex } from './search-index.js';

const [root, program, cache, output] = process.argv.slice(2);
process.chdir(dirname(fileURLToPath(import.meta.url)));

const read = (source) => readFileSync(join(root, source), 'utf8');
const copy = (from, to) => {
  mkdirSync(dirname(join(output, to)), { recursive: true });
  copyFileSync(from, join(output, to));
};

// The languages of the blocks must be known before the first page is read.
const languages = new Set(
  readdirSync(join(root, 'docs'), { recursive: true })
    .filter((name) => name.endsWith('.md'))
    .flatMap((name) => [...read(`docs/${name}`).matchAll(/^ *```(\w+)/gm)].map((match) => match[1])),
);
const highlight = await makeHighlighter(root, [...languages, 'toml', 'csv', 'json', 'cpp', 'lisp']);
const known = new Map();
const md = makeMarkdown(root, highlight, known);
const { pages, files } = collect(root, (source, text) => examine(md, source, text));
pages.forEach((page, source) => known.set(source, page));

const renderer = new Renderer(program, root, cache);
const examples = [];
for (const name of readdirSync(join(root, 'examples'))
  .filter((file) => file.endsWith('.scene'))
  .sort()) {
  const source = `examples/${name}`;
  const text = read(source);
  const picture = await renderer.render(source);
  const description = descriptionOf(text);
  examples.push({ source, name: name.replace('.scene', ''), text, description, output: outputOf(source), ...picture });
  files.push(...picture.dependencies);
}

/** The block of a page that contains `words` in its info string, the `index`-th of them. */
function blockOf(source, words, index = 0) {
  const found = pages.get(source).blocks.filter((block) => words.every((word) => block.words.includes(word)))[index];
  if (!found) throw new Error(`the front page needs a block of \`${words.join(' ')}\` in ${source}`);
  return found;
}

/** A section of a page without its heading. */
function sectionOf(source, title) {
  const section = pages
    .get(source)
    .text.split(/^## /m)
    .find((part) => part.startsWith(`${title}\n`));
  if (!section) throw new Error(`the front page needs the section "${title}" of ${source}`);
  return section.slice(title.length);
}

// The scene of the front page is the README's.
writeFileSync(join(cache, 'ball.scene'), blockOf('README.md', ['scene']).content);
const ball = await new Renderer(program, cache, cache).render('ball.scene');

const eleventy = new Eleventy('pages', pathBetween('.', output), {
  quietMode: true,
  config(config) {
    config.setUseGitIgnore(false);
    config.setLibrary('md', md);
    // Eleventy disables indented blocks of code.
    config.amendLibrary('md', (library) => library.enable('code'));
    config.setIncludesDirectory('../layouts');
    config.addGlobalData('examples', examples);
    config.addGlobalData('ball', ball);
    config.addGlobalData('groups', navigation(pages));
    config.addFilter('rel', (to, from) => relative(from, to));
    config.addFilter('outputOf', outputOf);
    config.addFilter('markdown', (text, source) => md.render(text, { source }));
    config.addFilter('inline', (text, source) => md.renderInline(text ?? '', { source }));
    config.addFilter('code', (text, ...words) => highlight(text, words));
    config.addFilter('percent', (share) => `${Number((100 * share).toPrecision(3))} %`);
    config.addFilter('round', (value) => Number(value.toPrecision(3)));
    config.addFilter('block', blockOf);
    config.addFilter('section', sectionOf);
    config.addFilter('introduction', (source) => pages.get(source).text.split('\n\n')[1]);
    config.addFilter('example', (name) => examples.find((example) => example.name === name));
    const add = (path, content, data) =>
      config.addTemplate(`pages/${path}`, content, { permalink: data.output, ...data });

    for (const page of pages.values()) {
      if (page.source === 'README.md') continue;
      const index = pages.get(posix.join(posix.dirname(page.source), 'README.md'));
      add(page.source, page.text, { layout: 'doc.njk', up: index === page ? undefined : index, ...page });
    }
    for (const [i, example] of examples.entries()) {
      const title = `${example.name}.scene`;
      const neighbours = { previous: examples[i - 1], next: examples[i + 1] };
      add(`${example.source}.njk`, '', {
        layout: 'example.njk',
        title,
        example,
        ...neighbours,
        output: example.output,
      });
    }
    for (const source of new Set(files)) {
      const isFolder = statSync(join(root, source)).isDirectory();
      if (isExample(source) || outputOf(source) === source.replace(/^docs\//, '')) continue;
      const words = [{ '.scene': 'scene', '.el': 'lisp', '.hpp': 'cpp' }[extname(source)] ?? extname(source).slice(1)];
      const names = isFolder ? readdirSync(join(root, source)).map((name) => `${source}/${name}`) : [];
      const data = {
        title: source,
        source,
        names,
        words,
        text: isFolder ? '' : read(source),
        output: outputOf(source),
      };
      add(`${source}.njk`, '', { layout: 'source.njk', ...data });
    }
  },
});

rmSync(output, { recursive: true, force: true });
await eleventy.write();
if (missingCharts.size > 0) {
  throw new Error(
    `no table for the charts ${[...missingCharts].map((chart) => `"${chart.section}"`).join(', ')}, see site/charts.js`,
  );
}

for (const source of new Set(files)) {
  if (!statSync(join(root, source)).isDirectory()) copy(join(root, source), source.replace(/^docs\//, ''));
}
for (const example of examples) copy(example.picture, `examples/${example.name}.png`);
copy(ball.picture, 'assets/ball.png');
for (const name of ['site.css', 'icon.svg']) copy(join('assets', name), `assets/${name}`);
copy('../node_modules/minisearch/LICENSE.txt', 'assets/minisearch-license.txt');
await bundle({
  absWorkingDir: process.cwd(),
  entryPoints: ['assets/search.js'],
  outfile: join(output, 'assets/search.js'),
  bundle: true,
  minify: true,
  format: 'iife',
});
writeFileSync(
  join(output, 'assets/search-index.js'),
  `globalThis.searchIndex = ${JSON.stringify(searchIndex(pages, examples))};\n`,
);
await buildPlayground({
  root,
  output,
  examples,
  first: blockOf('README.md', ['scene']).content,
  engine: process.env.SDLC_WASM,
});
