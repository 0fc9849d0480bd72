// The style sheet and the script of all pages.
#include "harness/results/document/page_assets.hpp"

namespace scanbench::results {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --ink: #1b1f24; --faint: #5d676f; --rule: #d5dade; --paper: #fff; --tint: #f4f6f8; --accent: #0068a3; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e9ec; --faint: #a3adb5; --rule: #3a4249; --paper: #15181b; --tint: #1f2428; --accent: #56b4e9; }
  /* Figures are drawn for paper: on a dark page each is a white card. */
  figure img { background: #fff; padding: .6rem; border-radius: .6rem; filter: brightness(.93); }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 100rem; padding: 1.5rem; background: var(--paper); color: var(--ink);
       font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 .3rem; overflow-wrap: anywhere; }
h2 { margin: 2.2rem 0 .4rem; font-size: 1.3rem; border-top: 2px solid var(--ink); padding-top: .6rem; overflow-wrap: anywhere; }
h3 { margin: 1.4rem 0 .4rem; font-size: 1.05rem; } p { margin: .4rem 0; max-width: 60rem; overflow-wrap: break-word; }
a { color: var(--accent); } .faint, .caption, .stamp { color: var(--faint); font-size: .88rem; }
.lead { font-size: 1.1rem; font-weight: 600; }
/* A table is as wide as it is: the box scrolls, the first column stays. */
section.table { margin-bottom: .9rem; max-width: 100%; } .scroll { overflow-x: auto; max-width: 100%; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .86rem; }
caption { text-align: left; min-width: min(20rem, 80vw); } caption h3 { margin: 1.2rem 0 .3rem; position: sticky; left: 0; max-width: min(60rem, 88vw); }
th, td { padding: .18rem .55rem; text-align: right; white-space: nowrap; } thead { border-bottom: 1.5px solid var(--ink); }
thead th { white-space: normal; vertical-align: bottom; max-width: 10rem; } thead th.head { white-space: nowrap; }
th.head { text-align: left; font-weight: 600; } th.group { text-align: left; border-bottom: 1px solid var(--rule); max-width: none; }
thead tr, tbody tr { background: var(--paper); } tbody tr:nth-child(even) { background: var(--tint); }
.scroll .head:first-child { position: sticky; left: 0; z-index: 1; background: inherit; box-shadow: 1px 0 var(--rule); }
/* In a ranking the number of the rank is narrow, and the name beside it stays too. */
.ranks .scroll .head:first-child { width: 2.2rem; min-width: 2.2rem; max-width: 2.2rem; box-shadow: none; }
.ranks .head:nth-child(2) { position: sticky; left: 2.2rem; z-index: 1; background: inherit; box-shadow: 1px 0 var(--rule); }
.first { padding-left: 1.3rem; } td.best { font-weight: 700; } td.not-eligible { color: var(--faint); }
td small, th small { display: block; color: var(--faint); font-weight: 400; font-size: .78rem; line-height: 1.15; }
th small { white-space: normal; max-width: 18rem; } .published { color: var(--faint); font-style: italic; }
figure { margin: 1rem 0; } figure img { max-width: 100%; height: auto; cursor: zoom-in; } figcaption { color: var(--faint); font-size: .88rem; max-width: 60rem; }
.compact table { font-size: .8rem; } .compact th, .compact td { padding: .18rem .4rem; }
.prose table { width: 100%; } .prose th.head { white-space: normal; vertical-align: top; } .plain tbody th.head:not(:first-child) { font-weight: 400; }
.beside figure { display: grid; grid-template-columns: minmax(0, 43rem) minmax(12rem, 1fr); gap: 1.4rem; align-items: center; }
.figures { display: flex; flex-wrap: wrap; gap: 1.2rem; align-items: flex-start; } .figures figure { max-width: 100%; }
.status { display: inline-block; padding: 0 .5rem; border-radius: .3rem; border: 1px solid currentColor; font-size: .85rem; }
.verdict { font-size: 1.15rem; font-weight: 600; padding: .6rem .9rem; border-left: .5rem solid; max-width: none; background: var(--tint); }
.verdict.good { border-color: #0072b2; } .verdict.bad { border-color: #d55e00; }
nav { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; margin: .8rem 0; } th[aria-sort] { cursor: pointer; }
th[aria-sort=ascending]::after { content: " ▲"; } th[aria-sort=descending]::after { content: " ▼"; }
input.filter { font: inherit; padding: .05rem .5rem; border: 1px solid var(--rule); background: var(--paper); color: var(--ink); }
.chart { width: 100%; max-width: 34rem; font-size: 12px; fill: var(--ink); } .chart .axis path { stroke: var(--faint); fill: none; }
.chart .axis text { fill: var(--faint); } .chart .front { stroke: var(--accent); fill: none; stroke-width: 1.5; stroke-dasharray: 5 3; }
.chart .on { fill: var(--accent); stroke: var(--accent); } .chart .off { fill: none; stroke: var(--faint); stroke-width: 1.5; }
.ranking, .glance { display: flex; flex-wrap: wrap; gap: 0 2rem; align-items: flex-start; } .ranking .chart { flex: 1 1 20rem; }
.glance .chart { flex: 0 1 26rem; } .glance .caption { max-width: 40rem; }
.scans { display: grid; grid-template-columns: repeat(auto-fill, minmax(12rem, 1fr)); gap: .8rem; }
.scans figure { margin: 0; } .scan { width: 100%; fill: none; stroke: var(--faint); stroke-width: 3; border: 1px solid var(--rule); }
.scan .points { stroke: var(--ink); stroke-linecap: round; stroke-width: 3; } .scan .right { stroke: #009e73; stroke-width: 5; } .scan .sensor { fill: var(--ink); stroke: none; }
.scan .split { stroke: #e69f00; stroke-width: 6; stroke-dasharray: 12 7; } .scan .false { stroke: #d55e00; stroke-width: 7; stroke-dasharray: 5 6; }
.scan .small { stroke: #56b4e9; stroke-width: 5; stroke-dasharray: 16 5; }
.scan .missed { stroke: #cc79a7; stroke-width: 7; stroke-dasharray: 14 5 4 5; } .key { display: flex; flex-wrap: wrap; gap: .3rem 1.2rem; }
.key .scan { width: 3.2rem; border: 0; vertical-align: middle; }
.tools { display: flex; gap: .5rem; margin: .3rem 0; font-size: .86rem; position: sticky; left: 0; width: max-content; }
.tools:not(:hover, :focus-within) button { opacity: .7; } .tools button { font: inherit; padding: .05rem .5rem; border: 1px solid var(--rule); background: var(--paper); color: var(--ink); cursor: pointer; }
.spark { vertical-align: middle; color: var(--accent); }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 22rem), 1fr)); gap: 1.2rem; }
dialog { max-width: 96vw; max-height: 96vh; padding: .5rem; border: 0; background: #fff; } dialog img { max-width: 92vw; max-height: 88vh; }
.matrices { display: flex; flex-wrap: wrap; gap: .6rem 2rem; align-items: flex-start; } .matrices section { max-width: 100%; } .matrices td { text-align: left; }
.matrices thead th { overflow-wrap: anywhere; max-width: 9rem; text-align: left; } .matrices td a { text-decoration: none; }
td.worse, .chip.worse, td.missing, .chip.missing { background: #d55e0030; box-shadow: inset .25rem 0 #d55e00; } td.better, .chip.better { background: #0072b22b; box-shadow: inset .25rem 0 #0072b2; }
td.failed, .chip.failed { background: #cc79a740; box-shadow: inset .25rem 0 #cc79a7; } td.uncertain, .chip.uncertain { background: #e69f0030; box-shadow: inset .25rem 0 #e69f00; }
.chips { flex: 1 1 100%; } .chips h3 { margin: .2rem 0; } .chips div { display: grid; grid-template-columns: repeat(auto-fill, minmax(10.5rem, 1fr)); gap: .25rem .4rem; }
.chip { padding: .1rem .3rem .1rem .55rem; background: var(--tint); font-size: .82rem; line-height: 1.3; text-decoration: none; overflow-wrap: anywhere; } .chip b, .chip small { display: block; color: var(--ink); } .chip small { color: var(--faint); }
.nights tbody th.head:last-child { white-space: normal; min-width: 16rem; font-weight: 400; } .nights th.head { vertical-align: top; }
dl { display: grid; grid-template-columns: minmax(8rem, max-content) minmax(0, 1fr); gap: .1rem 1rem; font-size: .86rem; } dt { color: var(--faint); } dd { margin: 0; overflow-wrap: anywhere; }
/* On a narrow screen names wrap, so that numbers are in view. */
@media (max-width: 600px) {
  body { padding: .8rem; font-size: 14px; } h1 { font-size: 1.3rem; } h2 { font-size: 1.15rem; } .lead { font-size: 1rem; }
  nav { flex-wrap: nowrap; overflow-x: auto; white-space: nowrap; padding-bottom: .3rem; }
  .scroll .head:first-child { white-space: normal; overflow-wrap: anywhere; min-width: 6rem; max-width: 8rem; } thead th { max-width: 6.5rem; }
  .ranks .head:nth-child(2) { white-space: normal; overflow-wrap: anywhere; max-width: 7rem; }
  th, td { padding: .18rem .35rem; } .beside figure { display: block; } dl { grid-template-columns: 1fr; } dd { margin-bottom: .4rem; }
  /* A change has two lines: what changed, then before, now, difference and seed. */
  .changes tr { display: grid; grid-template-columns: 1fr 1fr 1.5fr .7fr; } .changes th, .changes td { white-space: normal; overflow-wrap: anywhere; }
  .changes .head:first-child { position: static; max-width: none; min-width: 0; box-shadow: none; }
  .changes tr > :nth-child(3) { grid-column: 3 / 5; } .changes tr > :nth-child(n+7):nth-child(-n+10) { display: none; } .changes table { width: 100%; }
}
/* Paper has no scroll bar: nothing is cut, small type and wrapped values make room. */
@page { size: A4 landscape; margin: 10mm; }
@media print {
  :root { --ink: #000; --faint: #444; --rule: #bbb; --paper: #fff; --tint: #f4f6f8; --accent: #0068a3; }
  html { font-size: 11px; } body { max-width: none; padding: 0; font-size: 1rem; } nav, .tools, .files, canvas, input, select, button { display: none; }
  .scroll { overflow: visible; } .scroll .head:first-child, .ranks .head:nth-child(2) { position: static; box-shadow: none; }
  table, .compact table { font-size: .75rem; } th, td, thead th.head { padding: .1rem .25rem; white-space: normal; max-width: none; } .first { padding-left: .6rem; }
  tr, figure { break-inside: avoid; } h2, h3, caption { break-after: avoid; } .figures, .glance, .ranking, .matrices { display: block; }
  figure img { max-height: 16cm; width: auto; padding: 0; filter: none; } .beside figure { display: block; } caption h3 { position: static; }
}
)css";

// Tables sort by a click or Enter on a heading, filter by text and can be saved; a figure opens large; printing unfolds
// what is folded. The page reads without it.
constexpr std::string_view kScript = R"js(
for (const table of document.querySelectorAll('table')) {
  const body = table.tBodies[0];
  if (!body || body.rows.length < 3) continue;
  const heads = [...table.tHead.rows[table.tHead.rows.length - 1].cells];
  const groups = table.tHead.rows.length < 2 ? [] :
    [...table.tHead.rows[0].cells].flatMap(cell => Array(cell.colSpan).fill(cell.textContent.trim()));
  const names = heads.map((head, c) => [groups[c], head.textContent.trim()].filter(part => part).join(' ').replace(/\u00a0/g, ' ') || 'column ' + c);
  const value = (row, c) => {
    const text = row.cells[c] ? row.cells[c].textContent.trim() : '';
    const number = parseFloat(text.replace('−', '-'));
    return isNaN(number) ? text : number;
  };
  heads.forEach((head, c) => {
    head.tabIndex = 0;
    head.setAttribute('aria-sort', 'none');
    head.title = head.title ? head.title + ': sort' : 'sort';
    const sort = () => {
      const up = head.getAttribute('aria-sort') === 'descending';
      heads.forEach(h => h.setAttribute('aria-sort', 'none'));
      head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
      const rows = [...body.rows].sort((a, b) => {
        const x = value(a, c), y = value(b, c);
        const numbers = (typeof x === 'number') + (typeof y === 'number');
        if (numbers === 1) return typeof x === 'number' ? -1 : 1;  // what has no value comes last in both orders
        const order = numbers === 2 ? x - y : x.localeCompare(y);
        return up ? order : -order;
      });
      body.append(...rows);
    };
    head.addEventListener('click', sort);
    head.addEventListener('keydown', e => { if (e.key === 'Enter') sort(); });
  });
  const tools = document.createElement('div');
  tools.className = 'tools';
  if (table.caption) table.caption.append(tools); else table.parentElement.before(tools);
  const texts = row => [...row.cells].map(cell => cell.innerText.trim().replace(/\s+/g, ' '));
  const records = () => [...body.rows].map(row => Object.fromEntries(texts(row).map((text, c) => [names[c], text])));
  const field = text => /[",\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  const csv = () => [names, ...[...body.rows].map(texts)]
    .map(row => row.map(field).join(',')).join('\n') + '\n';
  const save = (ending, type, content) => {
    const button = document.createElement('button');
    button.textContent = ending.toUpperCase();
    button.title = 'save this table as ' + ending.toUpperCase();
    button.addEventListener('click', () => {
      const link = document.createElement('a');
      const section = table.closest('section');
      link.download = ((section && section.id) || 'table') + '.' + ending;
      link.href = URL.createObjectURL(new Blob([content()], {type}));
      link.click();
    });
    tools.append(button);
  };
  save('csv', 'text/csv', csv);
  save('json', 'application/json', () => JSON.stringify(records(), null, 1));
  if (body.rows.length < 9) continue;
  const filter = document.createElement('input');
  filter.className = 'filter';
  filter.type = 'search';
  filter.placeholder = 'filter rows';
  filter.setAttribute('aria-label', 'filter rows');
  filter.addEventListener('input', () => {
    for (const row of body.rows) row.hidden = !row.textContent.toLowerCase().includes(filter.value.toLowerCase());
  });
  tools.prepend(filter);
}
for (const image of document.querySelectorAll('figure img')) {
  image.tabIndex = 0;
  const open = () => {
    const dialog = document.createElement('dialog');
    const large = image.cloneNode();
    dialog.append(large);
    document.body.append(dialog);
    dialog.addEventListener('click', () => dialog.close());
    dialog.addEventListener('close', () => dialog.remove());
    dialog.showModal();
  };
  image.addEventListener('click', open);
  image.addEventListener('keydown', e => { if (e.key === 'Enter') open(); });
}
window.addEventListener('beforeprint', () => {
  for (const details of document.querySelectorAll('details')) details.open = !details.closest('.files');
});
)js";

}  // namespace

std::string_view page_style() {
  return kStyle;
}

std::string_view page_script() {
  return kScript;
}

}  // namespace scanbench::results
