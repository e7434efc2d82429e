#include "cli/report/style.hpp"

namespace sdlc::cli {

// The colours of the series are those of Okabe and Ito, "Color Universal Design", 2008, made darker
// or lighter until each has a contrast of 3:1 with the page; that of the text is 4.5:1.
std::string_view style_sheet() noexcept {
  return R"(:root {
  color-scheme: light dark;
  --page: light-dark(#ffffff, #14171b); --panel: light-dark(#f4f6f8, #1d2126);
  --ink: light-dark(#1c2127, #e6e9ed); --soft: light-dark(#59636e, #9aa4b0);
  --rule: light-dark(#d5dae0, #353c45); --accent: light-dark(#0b5cad, #6cb2f5);
  --note: light-dark(#fff6dd, #2c2511); --note-edge: light-dark(#b07a00, #d9a520);
  --front: light-dark(#858d97, #6c7580);
  --better: light-dark(#0a6b4a, #4cc79b); --worse: light-dark(#a8320a, #ff8f66);
  --s0: light-dark(#0072b2, #3f9fe0); --s1: light-dark(#d55e00, #f07a28);
  --s2: light-dark(#008a66, #19b88b); --s3: light-dark(#b5528b, #d98bb8);
  --s4: light-dark(#a87400, #e69f00); --s5: light-dark(#2a86bd, #78c6f0);
  --s6: light-dark(#4a4f57, #b4bcc6); --s7: light-dark(#8a7a00, #e0d24a);
}
* { box-sizing: border-box; }
body {
  margin: 0 auto; padding: 2.5rem clamp(1rem, 4vw, 2.5rem) 5rem; max-width: 74rem;
  background: var(--page); color: var(--ink); font: 1rem/1.55 system-ui, sans-serif;
  overflow-wrap: anywhere;
}
h1 { margin: 0; font-size: 2rem; line-height: 1.2; }
h2 { margin: 0 0 1rem; font-size: 1.35rem; line-height: 1.3; }
h3 { margin: 1.5rem 0 .5rem; font-size: 1rem; line-height: 1.4; }
p { margin: 0 0 1rem; max-width: 46rem; }
a { color: var(--accent); }
code {
  font: .92em/1.4 ui-monospace, monospace; padding: .1em .35em; background: var(--panel);
  border: 1px solid var(--rule); border-radius: .3em;
}
small, .fine, figcaption, .kind { font-size: .85rem; color: var(--soft); }
section { margin-top: 3rem; padding-top: 1.5rem; border-top: 1px solid var(--rule); }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; }
nav ul { display: flex; flex-wrap: wrap; gap: .25rem 1.25rem; margin: 0; padding: 0; list-style: none; }
.callout {
  max-width: none; padding: .6rem 1rem; background: var(--note);
  border-left: 4px solid var(--note-edge);
}
.lead { font-size: 1.2rem; line-height: 1.6; }
.beside { display: flex; flex-wrap: wrap; gap: 2rem; }
.beside > div { flex: 1 1 28rem; min-width: 0; }
.reference { flex: 0 1 17rem; }
figure { margin: 0; min-width: 0; break-inside: avoid; }
figcaption { margin-top: .4rem; }
img { display: block; width: 100%; height: auto; background: var(--panel); }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; min-width: 100%; font-size: .82rem; line-height: 1.4; }
caption { text-align: left; font-weight: 600; padding-bottom: .5rem; }
th, td { padding: .4rem .5rem; text-align: left; vertical-align: top; font-weight: normal; overflow-wrap: normal; }
thead th { vertical-align: bottom; font-weight: 600; border-bottom: 2px solid var(--rule); }
tbody tr { border-bottom: 1px solid var(--rule); break-inside: avoid; }
.group { padding-top: 1.1rem; font-weight: 600; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
tbody .number { white-space: nowrap; }
td small, tbody th.number small { display: block; }
.verdict.better { color: var(--better); font-weight: 600; }
.verdict.worse { color: var(--worse); font-weight: 600; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(27rem, 100%), 1fr)); gap: 1.5rem 2.5rem; }
.chart { display: block; width: 100%; min-width: 27rem; font-size: 14px; }
.chart text { fill: var(--ink); font-variant-numeric: tabular-nums; }
.chart .tick, .chart .note { fill: var(--soft); }
.chart .key, .chart .note { paint-order: stroke; stroke: var(--page); stroke-width: 3px; }
.grid { stroke: var(--rule); }
.level { stroke: var(--soft); stroke-dasharray: 1 3; }
.front { fill: none; stroke: var(--front); stroke-width: 3; }
.s0 { --of: var(--s0); } .s1 { --of: var(--s1); } .s2 { --of: var(--s2); } .s3 { --of: var(--s3); }
.s4 { --of: var(--s4); } .s5 { --of: var(--s5); } .s6 { --of: var(--s6); } .s7 { --of: var(--s7); }
.line, .bar { fill: none; stroke: var(--of); stroke-width: 1.4; }
.bar { opacity: .5; }
.mark { fill: var(--of); stroke: var(--of); stroke-width: 1.6; }
.hollow .mark { fill: var(--page); }
.faded { opacity: .5; }
.key { border-bottom: .2rem solid var(--of); font-weight: 700; }
.legend { columns: 22rem; margin: 0 0 1.5rem; padding: 0; list-style: none; }
.row { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(15rem, 45%), 1fr)); gap: 1rem; }
.crops img { image-rendering: pixelated; }
dl div { display: grid; grid-template-columns: 13rem minmax(0, 1fr); gap: 0 1rem; padding: .4rem 0; border-bottom: 1px solid var(--rule); }
dt { color: var(--soft); }
dd { margin: 0; }
@media print {
  :root { color-scheme: light; }
  html { font-size: 9.5pt; }
  body { padding: 0; max-width: none; }
  nav { display: none; }
  .scroll { overflow: visible; }
  .charts { grid-template-columns: 1fr 1fr; }
  .chart { min-width: 0; }
  h2, h3, caption { break-after: avoid; }
}
)";
}

}  // namespace sdlc::cli
