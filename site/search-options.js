// How the index is made and read; both sides need the same.
export const options = {
  fields: ['title', 'heading', 'text'],
  storeFields: ['title', 'heading', 'href'],
  searchOptions: {
    boost: { title: 3, heading: 4 },
    // What a reader is after is rarely history.
    boostDocument: (id, term, { href }) => (/^(decisions\/|changelog)/.test(href) ? 0.3 : 1),
    prefix: true,
    fuzzy: (term) => (term.length > 4 ? 0.2 : 0),
    combineWith: 'AND',
  },
};
