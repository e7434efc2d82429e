#include "cli/report/style.hpp"

namespace sdlc::cli {

// The colours of the series are those of Okabe and Ito, "Color Universal Design", 2008, made darker
// or lighter until each has a contrast of 3:1 with the page; that of the text is 4.5:1.
std::string_view style_sheet() noexcept {
  return R"(:root {
  color-scheme: light dark;
  --page: #ffffff; --panel: #f4f6f8; --ink: #1c2127; --soft: #59636e; --rule: #d5dae0;
  --grid: #dfe3e8; --grid-minor: #eff1f4; --accent: #0b5cad; --note: #fff6dd; --note-edge: #b07a00;
  --front: #858d97; --better: #0a6b4a; --worse: #a8320a;
  --s0: #0072b2; --s1: #d55e00; --s2: #008a66; --s3: #b5528b;
  --s4: #a87400; --s5: #2a86bd; --s6: #4a4f57; --s7: #8a7a00;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #14171b; --panel: #1d2126; --ink: #e6e9ed; --soft: #9aa4b0; --rule: #353c45;
    --grid: #2c323a; --grid-minor: #20252b; --accent: #6cb2f5; --note: #2c2511; --note-edge: #d9a520;
    --front: #6c7580; --better: #4cc79b; --worse: #ff8f66;
    --s0: #3f9fe0; --s1: #f07a28; --s2: #19b88b; --s3: #d98bb8;
    --s4: #e69f00; --s5: #78c6f0; --s6: #b4bcc6; --s7: #e0d24a;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; }
body {
  margin: 0 auto; padding: 2.5rem clamp(1rem, 4vw, 2.5rem) 5rem; max-width: 74rem;
  background: var(--page); color: var(--ink);
  font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
  overflow-wrap: anywhere;
}
h1 { margin: 0; font-size: clamp(1.6rem, 4vw, 2.2rem); line-height: 1.2; letter-spacing: -.01em; }
h2 { margin: 0 0 1rem; font-size: 1.35rem; line-height: 1.3; }
h3 { margin: 1.5rem 0 .5rem; font-size: 1rem; line-height: 1.4; }
p { margin: 0 0 1rem; max-width: 46rem; }
a { color: var(--accent); text-underline-offset: .15em; }
code {
  font: .92em/1.4 ui-monospace, SFMono-Regular, Menlo, Consolas, "DejaVu Sans Mono", monospace;
  background: var(--panel); border: 1px solid var(--rule); border-radius: .3em; padding: .1em .35em;
}
small, .fine, figcaption { font-size: .85rem; color: var(--soft); }
section { margin-top: 3rem; padding-top: 1.5rem; border-top: 1px solid var(--rule); }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; }
.skip { position: absolute; left: -100rem; }
.skip:focus {
  left: auto; z-index: 1; padding: .4rem .8rem; background: var(--page); border: 1px solid var(--rule);
}
.kind { margin: 0 0 .25rem; color: var(--soft); font-size: .85rem; letter-spacing: .04em; }
header .fine { margin: .5rem 0 1rem; }
nav ul { display: flex; flex-wrap: wrap; gap: .25rem 1.25rem; margin: 0; padding: 0; list-style: none; }
.callout {
  max-width: none; margin: 1rem 0; padding: .6rem 1rem;
  background: var(--note); border-left: 4px solid var(--note-edge); border-radius: 0 .3rem .3rem 0;
}
main > section:first-of-type { border-top: 0; padding-top: 0; margin-top: 2rem; }
.lead { font-size: 1.2rem; line-height: 1.6; }
.lead code { font-weight: 600; }
.beside { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 17rem); gap: 2rem; align-items: start; }
figure { margin: 0; min-width: 0; break-inside: avoid; }
figcaption { margin-top: .4rem; }
img { display: block; max-width: 100%; height: auto; border-radius: .2rem; background: var(--panel); }
.reference img { width: 100%; }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; min-width: 100%; font-size: .9rem; line-height: 1.4; }
caption { text-align: left; font-weight: 600; padding-bottom: .5rem; }
th, td { padding: .45rem .75rem; text-align: left; vertical-align: top; font-weight: normal; overflow-wrap: normal; }
thead th { vertical-align: bottom; font-weight: 600; font-size: .8rem; color: var(--soft); border-bottom: 2px solid var(--rule); }
tbody tr { border-bottom: 1px solid var(--rule); break-inside: avoid; }
.group { padding-top: 1.1rem; font-weight: 600; }
.group small { font-size: inherit; font-weight: normal; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
tbody .number, .flag { white-space: nowrap; }
td small, tbody th.number small { display: block; font-size: .78rem; }
#renders table { font-size: .82rem; }
#renders th, #renders td { padding: .4rem .45rem; }
#renders thead th { font-size: .75rem; }
.verdict.better { color: var(--better); font-weight: 600; }
.verdict.worse { color: var(--worse); font-weight: 600; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(27rem, 100%), 1fr)); gap: 1.5rem 2.5rem; }
.plot { max-width: 44rem; }
.plot h3 { margin: 0 0 .25rem; }
.plot .scroll { margin: 0; }
.chart { display: block; width: 100%; min-width: 27rem; height: auto; font-size: 14px; }
.chart text { fill: var(--ink); font-variant-numeric: tabular-nums; }
.chart .tick, .chart .hint { fill: var(--soft); }
.chart .axis, .chart .note { fill: var(--soft); font-size: 13px; }
.chart .axis { fill: var(--ink); }
.major { stroke: var(--grid); }
.minor { stroke: var(--grid-minor); }
.frame { fill: none; stroke: var(--rule); }
.break { stroke: var(--soft); stroke-dasharray: 2 4; }
.band { fill: var(--soft); opacity: .16; }
.level { stroke: var(--soft); stroke-width: 1.2; stroke-dasharray: 1 3; }
.front { fill: none; stroke: var(--front); stroke-width: 3; }
.s0 { --of: var(--s0); } .s1 { --of: var(--s1); } .s2 { --of: var(--s2); } .s3 { --of: var(--s3); }
.s4 { --of: var(--s4); } .s5 { --of: var(--s5); } .s6 { --of: var(--s6); } .s7 { --of: var(--s7); }
.line { fill: none; stroke: var(--of); stroke-width: 1.5; }
.bar { fill: none; stroke: var(--of); stroke-width: 1.2; }
.mark { fill: var(--of); stroke: var(--of); stroke-width: 1.6; stroke-linejoin: round; }
.hollow .mark { fill: var(--page); }
.faded .mark, .faded .bar { stroke-width: 1; }
.faded .mark { fill-opacity: .35; }
.faded .bar { opacity: .6; }
.chart .key, .chart .note { paint-order: stroke; stroke: var(--page); stroke-width: 3px; stroke-linejoin: round; }
.chart .key { font-weight: 700; font-size: 13px; }
.target { fill: transparent; stroke: none; }
.point { outline: none; }
.point:hover .target { stroke: var(--soft); }
.point:focus-visible .target { stroke: var(--accent); stroke-width: 3; }
.reading { visibility: hidden; pointer-events: none; }
.reading rect { fill: var(--page); }
.reading .name { font-weight: 600; }
.point:hover .reading, .point:focus .reading { visibility: visible; }
.legend { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(22rem, 100%), 1fr)); gap: .5rem 2rem; margin: 0 0 1.5rem; padding: 0; list-style: none; line-height: 1.35; }
.legend li { display: flex; gap: .6rem; align-items: baseline; }
.sample { width: 2.75rem; height: 1rem; vertical-align: -.15em; flex: none; }
.look { width: 1rem; }
.row { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(10.5rem, 45%), 1fr)); gap: 1rem; }
.row.maps { grid-template-columns: repeat(auto-fill, minmax(min(15rem, 100%), 1fr)); }
.row img { width: 100%; }
.crops img { image-rendering: pixelated; }
.color-bar { max-width: 34rem; margin: 1rem 0; }
.color-bar svg { display: block; width: 100%; height: .8rem; }
.color-bar figcaption { display: flex; justify-content: space-between; gap: 1rem; }
dl { margin: 0 0 1.5rem; }
dl div { display: grid; grid-template-columns: 13rem minmax(0, 1fr); gap: 0 1rem; padding: .4rem 0; border-bottom: 1px solid var(--rule); }
dt { color: var(--soft); }
dd { margin: 0; }
@media (max-width: 48rem) {
  .beside { grid-template-columns: minmax(0, 1fr); }
  .reference { max-width: 24rem; }
  dl div { grid-template-columns: minmax(0, 1fr); }
}
@media print {
  :root {
    color-scheme: light;
    --page: #ffffff; --panel: #ffffff; --ink: #000000; --soft: #000000; --rule: #999999;
    --grid: #d0d0d0; --grid-minor: #e8e8e8; --accent: #000000; --note: #ffffff; --note-edge: #000000;
    --front: #858d97; --better: #000000; --worse: #000000;
    --s0: #0072b2; --s1: #d55e00; --s2: #008a66; --s3: #b5528b;
    --s4: #a87400; --s5: #2a86bd; --s6: #4a4f57; --s7: #8a7a00;
  }
  html { font-size: 9.5pt; }
  body { padding: 0; max-width: none; }
  section { margin-top: 1.5rem; padding-top: 1rem; }
  nav, .skip, .hint { display: none; }
  .scroll { overflow: visible; }
  .charts { grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); gap: 1rem; }
  .chart { min-width: 0; }
  table, #renders table { font-size: .72rem; }
  th, td, #renders th, #renders td { padding: .25rem .3rem; }
  th small, td small, thead th { font-size: inherit; }
  dl div { grid-template-columns: 13rem minmax(0, 1fr); }
  tbody .number { white-space: normal; }
  .beside { grid-template-columns: minmax(0, 1fr) 14rem; }
  h2, h3, caption { break-after: avoid; }
  .callout { break-inside: avoid; }
}
)";
}

}  // namespace sdlc::cli
