// Charts from tables of the documentation, as SVG. Bars and points are placed in per cent: a chart has the width of the
// page, and its text keeps its size.

// A chart is drawn above a table: the `table`-th of the section, by default the first. Series are columns of the table,
// counted from 0; column 0 has the labels.
const charts = [
  {
    page: 'docs/performance.md',
    section: 'Compared with other renderers',
    title: 'Million camera paths per second, two threads; longer is faster',
    series: { sdlc: 1, Embree: 2, 'limit kernel': 4 },
  },
  {
    page: 'docs/performance.md',
    section: 'How cost grows',
    title: 'Million paths per second over the number of spheres; both axes are logarithmic',
    kind: 'lines',
    series: { sdlc: 3, Embree: 7 },
  },
  {
    page: 'docs/performance.md',
    section: 'Where the time goes',
    title: 'Share of the time in per cent',
    series: { 'nine spheres': 1 },
  },
  {
    page: 'docs/performance.md',
    section: 'Precision and instruction set',
    title: 'Nanoseconds per ray; shorter is faster',
    series: { 'nine spheres': 1, step8: 2 },
  },
  {
    page: 'docs/performance.md',
    section: 'Features',
    title: 'Additional time per ray in per cent',
    series: { 'AVX2, float': 4, 'AVX-512, float': 6 },
  },
  {
    page: 'docs/performance.md',
    section: 'Features',
    table: 1,
    title: 'Nanoseconds per ray; shorter is faster',
    series: { 'AVX2, float': 4, 'AVX-512, float': 6 },
  },
];

/** The cells of the table whose first token is `start`, row by row, without the head. */
function cellsOf(tokens, start) {
  const rows = [];
  for (let i = start; tokens[i].type !== 'table_close'; ++i) {
    if (tokens[i].type === 'tr_open') rows.push([]);
    if (tokens[i].type === 'inline') rows.at(-1).push(tokens[i].content);
  }
  return rows.slice(1);
}

const escape = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');
const percent = (share) => `${(100 * share).toFixed(2)}%`;

function bars(rows) {
  const greatest = Math.max(...rows.flatMap(({ values }) => values.filter(Number.isFinite)));
  let y = 0;
  const parts = rows.map(({ label, values }) => {
    // Text of SVG does not wrap; a line of 44 letters fits a narrow screen.
    const text = label
      .match(/.{1,44}(?= |$)/g)
      .map((line) => `<text x="0" y="${(y += 16)}">${escape(line.trim())}</text>`)
      .join('');
    const shapes = values.map((value, k) => {
      if (!Number.isFinite(value)) return '';
      const length = percent((0.85 * Math.max(value, 0)) / greatest);
      const top = (y += 15) - 9;
      return (
        `<rect class="series-${k}" x="0" y="${top}" width="${length}" height="11" rx="2"/>` +
        `<text class="value" x="${length}" dx="6" y="${top + 10}">${value}</text>`
      );
    });
    y += 12;
    return text + shapes.join('');
  });
  return { height: y, body: parts.join('\n') };
}

function lines(rows, series) {
  const height = 320;
  const points = series.map((name, k) =>
    rows.map(({ label, values }) => [Math.log10(Number(label.replaceAll(',', ''))), Math.log10(values[k])]),
  );
  const [xs, ys] = [0, 1].map((axis) =>
    points
      .flat()
      .map((point) => point[axis])
      .filter(Number.isFinite),
  );
  const [left, right, low, high] = [
    Math.min(...xs),
    Math.max(...xs),
    Math.floor(Math.min(...ys)),
    Math.ceil(Math.max(...ys)),
  ];
  const x = (value) => percent(0.1 + (0.85 * (value - left)) / (right - left));
  const y = (value) => (10 + ((height - 40) * (high - value)) / (high - low)).toFixed(1);
  const decades = (from, to) => Array.from({ length: to - from + 1 }, (_, i) => from + i);
  const axes = decades(low, high).map(
    (d) =>
      `<line class="axis" x1="10%" x2="95%" y1="${y(d)}" y2="${y(d)}"/>` +
      `<text class="value" text-anchor="end" x="9%" y="${y(d)}" dy="4">${10 ** d}</text>`,
  );
  for (const d of decades(Math.ceil(left), Math.floor(right))) {
    axes.push(
      `<text class="value" text-anchor="middle" x="${x(d)}" y="${height - 6}">` +
        `10<tspan dy="-5" class="exponent">${d}</tspan></text>`,
    );
  }
  const curves = points.map((curve, k) => {
    const segments = curve
      .slice(1)
      .map(
        (to, i) =>
          `<line class="series-${k}" x1="${x(curve[i][0])}" y1="${y(curve[i][1])}" x2="${x(to[0])}" y2="${y(to[1])}"/>`,
      );
    return segments
      .concat(curve.map((p) => `<circle class="series-${k}" cx="${x(p[0])}" cy="${y(p[1])}" r="4"/>`))
      .join('');
  });
  return { height, body: [...axes, ...curves].join('\n') };
}

/** The charts of a page that `chartOf` has not drawn yet. */
export const missingCharts = new Set(charts);

/** The chart for the table that begins at `tokens[start]`, or nothing. */
export function chartOf(source, tokens, start) {
  const opening = tokens.findLastIndex((token, i) => i < start && token.type === 'heading_open');
  const section = tokens[opening + 1]?.content;
  const table = tokens.slice(opening, start).filter((token) => token.type === 'table_open').length;
  const chart = charts.find((c) => c.page === source && c.section === section && (c.table ?? 0) === table);
  if (!chart) return '';
  missingCharts.delete(chart);
  const series = Object.keys(chart.series);
  const rows = cellsOf(tokens, start).map((cells) => ({
    label: cells[0],
    values: Object.values(chart.series).map((column) => {
      const value = Number.parseFloat(cells[column]?.replaceAll(',', ''));
      if (Number.isNaN(value) && cells[column] !== '') {
        throw new Error(
          `${source}, ${section}: column ${column} has \`${cells[column]}\` and no number, see site/charts.js`,
        );
      }
      return value;
    }),
  }));
  const { height, body } = (chart.kind === 'lines' ? lines : bars)(rows, series);
  const keys = series.map((name, k) => `<span class="key series-${k}">${escape(name)}</span>`).join(' ');
  const legend = series.length > 1 ? `<span class="keys">${keys}</span>` : '';
  return (
    `<figure class="chart"><figcaption>${escape(chart.title)} ${legend}</figcaption>` +
    `<svg role="img" aria-label="Chart of the next table" width="100%" height="${height}">\n${body}\n</svg></figure>\n`
  );
}
