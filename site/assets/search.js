// The search of the header. The index is a script, because pages of file:// cannot fetch.
import MiniSearch from 'minisearch';
import { options } from '../search-options.js';

const root = new URL('..', document.currentScript.src);
const form = document.querySelector('.search');
const input = form.querySelector('input');
const results = form.querySelector('ol');
const status = form.querySelector('[role=status]');
let loading;

function load() {
  loading ??= new Promise((resolve, reject) => {
    const script = document.createElement('script');
    script.src = new URL('assets/search-index.js', root);
    script.onload = () => resolve(MiniSearch.loadJS(globalThis.searchIndex, options));
    script.onerror = reject;
    document.head.append(script);
  });
  return loading;
}

function show(hits) {
  results.replaceChildren(
    ...hits.slice(0, 10).map(({ title, heading, href }) => {
      const link = document.createElement('a');
      link.href = new URL(href, root);
      link.append(heading || title);
      const page = document.createElement('small');
      page.textContent = heading ? title : '';
      link.append(page);
      const item = document.createElement('li');
      item.append(link);
      return item;
    }),
  );
  results.hidden = hits.length === 0;
}

async function search() {
  const query = input.value.trim();
  const index = await load();
  if (query !== input.value.trim()) return;
  const hits = query ? index.search(query) : [];
  show(hits);
  status.textContent = query ? `${hits.length || 'No'} ${hits.length === 1 ? 'result' : 'results'}` : '';
}

function close() {
  show([]);
  status.textContent = '';
}

form.hidden = false;
input.addEventListener('focus', load, { once: true });
input.addEventListener('input', search);
form.addEventListener('submit', async (event) => {
  event.preventDefault();
  await search();
  results.querySelector('a')?.click();
});
form.addEventListener('keydown', (event) => {
  const links = [input, ...results.querySelectorAll('a')];
  const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (step) {
    event.preventDefault();
    links[(links.indexOf(document.activeElement) + step + links.length) % links.length].focus();
  } else if (event.key === 'Escape') {
    input.focus();
    close();
  }
});
form.addEventListener('focusout', (event) => {
  if (event.relatedTarget && !form.contains(event.relatedTarget)) close();
});
document.addEventListener('click', (event) => {
  if (!form.contains(event.target)) close();
});
document.addEventListener('keydown', (event) => {
  if (event.key !== '/' || event.ctrlKey || event.metaKey || event.target === input) return;
  event.preventDefault();
  input.focus();
});
