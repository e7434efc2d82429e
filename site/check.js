// Checks the site: `node check.js SITE [PART]`. Links and HTML of all files, then all pages, or those with PART in their
// names, in Chromium: accessibility in light and dark, narrow screens, requests to other servers, and the search. Prints
// findings; the exit status is 1 if there are any.
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { cpus } from 'node:os';
import { extname, join, posix } from 'node:path';
import { pathToFileURL } from 'node:url';
import { HtmlValidate } from 'html-validate';
import pa11y from 'pa11y';
import puppeteer from 'puppeteer-core';

const [site, part = ''] = process.argv.slice(2);
const prefix = '/docs/sdlc/';
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

const findings = [];
const find = (page, text) => {
  findings.push(text);
  console.error(`${page}: ${text}`);
};

const files = readdirSync(site, { recursive: true })
  .filter((name) => statSync(join(site, name)).isFile())
  .sort();
const texts = new Map(
  files.filter((name) => /\.(html|css)$/.test(name)).map((name) => [name, readFileSync(join(site, name), 'utf8')]),
);
// Reports of `sdlc measure` are samples of its output, which its own tests check.
const pages = [...texts.keys()].filter((name) => name.endsWith('.html') && !name.startsWith('reports/'));

function checkLinks(page) {
  const ids = (name) => new Set([...texts.get(name).matchAll(/\sid="([^"]*)"/g)].map((match) => match[1]));
  for (const [, tag, attribute, href] of texts.get(page).matchAll(/<(\w+)[^>]*?\s(href|src)="([^"]*)"/g)) {
    if (/^\w+:/.test(href)) {
      if (tag !== 'a') find(page, `${tag} has the foreign ${attribute} ${href}`);
      continue;
    }
    const [path, fragment] = href.split('#');
    const target = path ? posix.join(posix.dirname(page), path.replace(/\?.*/, '')) : page;
    if (href.startsWith('/') || !existsSync(join(site, target)) || !statSync(join(site, target)).isFile()) {
      find(page, `${href} is not there`);
    } else if (fragment && !ids(target).has(fragment)) {
      find(page, `${href} has no such fragment`);
    }
  }
}

async function checkHtml() {
  // Anchors are those of GitHub, which may begin with a digit; titles of pages are those of the Markdown.
  const rules = { 'valid-id': ['error', { relaxed: true }], 'long-title': 'off' };
  const validator = new HtmlValidate({ extends: ['html-validate:recommended'], rules });
  for (const page of pages) {
    const { results } = await validator.validateString(texts.get(page), page);
    for (const { messages } of results)
      for (const { line, ruleId, message } of messages) find(page, `line ${line}: ${message} (${ruleId})`);
  }
}

/** The site below a path, as on a server of other pages. */
function serve() {
  const types = {
    '.html': 'text/html; charset=utf-8',
    '.css': 'text/css',
    '.js': 'text/javascript',
    '.svg': 'image/svg+xml',
    '.png': 'image/png',
  };
  const server = createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, 'http://localhost').pathname).slice(prefix.length);
    const path = join(site, name);
    if (!request.url.startsWith(prefix) || !files.includes(name)) return response.writeHead(404).end();
    // With the headers for threads the playground need not be loaded again.
    const headers = {
      'content-type': types[extname(name)] ?? 'text/plain',
      'cross-origin-opener-policy': 'same-origin',
      'cross-origin-embedder-policy': 'require-corp',
    };
    return response.writeHead(200, headers).end(readFileSync(path));
  });
  return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

async function checkPage(browser, tab, base, page) {
  await tab.setViewport({ width: 1280, height: 900 });
  await tab.goto(base + page);
  await tab.evaluate(axe);
  for (const scheme of ['light', 'dark']) {
    await tab.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
    const { violations } = await tab.evaluate(() => globalThis.axe.run());
    for (const { id, help, nodes } of violations) find(page, `${scheme}, axe: ${help} (${id}): ${nodes[0].html}`);
    const { issues } = await pa11y(tab.url(), { browser, page: tab, ignoreUrl: true });
    for (const { message, context } of issues) find(page, `${scheme}, pa11y: ${message} ${context}`);
  }
  await tab.setViewport({ width: 360, height: 740 });
  const width = await tab.evaluate(() => document.documentElement.scrollWidth);
  if (width > 360) find(page, `is ${width} pixels wide on a screen of 360`);
}

/** Searches by keyboard, as a reader does, from a page in a folder. */
async function checkSearch(browser, base) {
  const tab = await browser.newPage();
  await tab.goto(`${base}explain/E104.html`);
  await tab.keyboard.press('/');
  await tab.keyboard.type('unknown proprety');
  try {
    await tab.waitForSelector('.search li a', { timeout: 10_000 });
    await tab.keyboard.press('ArrowDown');
    const focused = await tab.evaluate(() => document.activeElement.href ?? '');
    if (!focused.startsWith(base)) find(base, `the first result of the search is ${focused}`);
    await Promise.all([tab.waitForNavigation(), tab.keyboard.press('Enter')]);
    const text = await tab.evaluate(() => document.querySelector('main')?.textContent ?? '');
    if (!text.includes('unknown property')) find(base, `the search led to ${tab.url()}`);
  } catch (error) {
    find(base, `the search fails: ${error.message}`);
  }
  await tab.close();
}

for (const page of pages) checkLinks(page);
for (const [name, text] of texts)
  if (/(url\(|@import|src=)["']?(https?:)?\/\//.test(text)) find(name, 'loads a foreign resource');
await checkHtml();

const server = await serve();
const base = `http://127.0.0.1:${server.address().port}${prefix}`;
const executablePath = process.env.CHROMIUM ?? '/usr/bin/chromium';
const browser = await puppeteer.launch({ executablePath, args: ['--no-sandbox'] });
const todo = pages.filter((name) => name.includes(part));
await Promise.all(
  cpus()
    .slice(0, 4)
    .map(async () => {
      const tab = await browser.newPage();
      let current;
      tab.on('request', (request) => request.url().startsWith(base) || find(current, `requests ${request.url()}`));
      tab.on('pageerror', (error) => find(current, error.message));
      tab.on(
        'response',
        (response) => response.status() >= 400 && find(current, `${response.url()} is ${response.status()}`),
      );
      while ((current = todo.shift())) await checkPage(browser, tab, base, current);
    }),
);
await checkSearch(browser, base);
await checkSearch(browser, pathToFileURL(`${site}/`).href);
await browser.close();
server.close();

console.error(`site: ${pages.length} pages, ${findings.length} findings`);
process.exitCode = findings.length > 0 ? 1 : 0;
