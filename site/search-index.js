// The index of the search: sections of pages, and examples.
import MiniSearch from 'minisearch';
import { options } from './search-options.js';

export function searchIndex(pages, examples) {
  const documents = [];
  for (const page of pages.values()) {
    if (page.source === 'README.md') continue;
    // Pages of messages and decisions are short: one entry each.
    const isShort = /^docs\/(explain|decisions)\/.*\d.*\.md$/.test(page.source);
    const whole = {
      title: page.title,
      heading: '',
      href: page.output,
      text: page.sections.map(({ title, text }) => `${title} ${text}`).join(' '),
    };
    const sections = page.sections.map(({ title, anchor, text }) => ({
      title: page.title,
      heading: title,
      href: page.output + (anchor && `#${anchor}`),
      text,
    }));
    documents.push(...(isShort ? [whole] : sections));
  }
  for (const { name, description, output } of examples) {
    documents.push({ title: `${name}.scene`, heading: 'Example', href: output, text: description });
  }
  const index = new MiniSearch(options);
  index.addAll(documents.map((document, id) => ({ id, ...document })));
  return index.toJSON();
}
