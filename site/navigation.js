// The groups of the navigation, by source files. `*` in a name stands for any characters but `/`, and may match none.
// A page that is in no group is in the last one; pages of a folder with a README.md are found by way of that.
export const groups = [
  {
    title: 'Start',
    pages: [
      'docs/playground.md',
      'docs/install.md',
      'docs/tutorial*.md',
      'docs/tutorial/*.md',
      'docs/coming-from-*.md',
      'docs/mistakes.md',
      'docs/gallery.md',
    ],
  },
  {
    title: 'The language',
    pages: [
      'docs/language.md',
      'docs/explain/README.md',
      'docs/lint.md',
      'docs/format.md',
      'docs/json-config.md',
      'docs/convert.md',
      'docs/pack.md',
    ],
  },
  {
    title: 'Pictures',
    pages: [
      'docs/accuracy.md',
      'docs/preview.md',
      'docs/serve.md',
      'docs/aov.md',
      'docs/films.md',
      'docs/farm.md',
      'docs/measure.md',
      'docs/compare.md',
      'docs/inspect.md',
    ],
  },
  { title: 'Editors and CI', pages: ['docs/editors.md', 'editors/*/README.md', 'docs/ci.md'] },
  {
    title: 'How it works',
    pages: [
      'docs/numerics.md',
      'docs/scale.md',
      'docs/performance.md',
      'docs/architecture.md',
      'docs/decisions/README.md',
      'grammar/README*.md',
    ],
  },
  { title: 'The project', pages: ['CHANGELOG.md', 'CONTRIBUTING.md', 'SECURITY.md', 'THIRD_PARTY.md'] },
];
export const lastGroup = 'More';
