// Writes documents as HTML: the frame of the page, its styles, the script of tables and figures, and every block.
#include "harness/results/document/html_page.hpp"

#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "harness/results/document/plain_text.hpp"
#include "harness/results/document/table.hpp"

namespace scanbench::results {
namespace {

constexpr std::string_view kStyle = R"css(
:root { --ink: #1b1f24; --faint: #667079; --rule: #d5dade; --paper: #fff; --tint: #f4f6f8; --accent: #0072b2; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e9ec; --faint: #98a3ac; --rule: #3a4249; --paper: #15181b; --tint: #1f2428; --accent: #56b4e9; }
  figure img { background: #fff; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 78rem; padding: 1.5rem; background: var(--paper); color: var(--ink);
       font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .2rem; } h2 { margin: 2.2rem 0 .4rem; font-size: 1.3rem; border-top: 2px solid var(--ink); padding-top: .6rem; }
h3 { margin: 1.4rem 0 .4rem; font-size: 1.05rem; } p { margin: .4rem 0; max-width: 60rem; }
a { color: var(--accent); } .faint, .caption { color: var(--faint); font-size: .88rem; }
section.table { margin-bottom: .9rem; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .86rem; }
th, td { padding: .18rem .55rem; text-align: right; white-space: nowrap; } thead { border-bottom: 1.5px solid var(--ink); }
th.head { text-align: left; font-weight: 600; } th.group { text-align: left; border-bottom: 1px solid var(--rule); }
.first { padding-left: 1.3rem; } tbody tr:nth-child(even) { background: var(--tint); }
td.best { font-weight: 700; } td.not-eligible { color: var(--faint); } td small { display: block; color: var(--faint); font-weight: 400; font-size: .78rem; line-height: 1.1; } .published { color: var(--faint); font-style: italic; }
figure { margin: 1rem 0; } figure img { max-width: 100%; height: auto; } figcaption { color: var(--faint); font-size: .88rem; }
.compact table { font-size: .8rem; } .compact th { white-space: normal; } .compact th, .compact td { padding: .18rem .4rem; }
.prose table { width: 100%; } .prose th.head { white-space: normal; vertical-align: top; } .plain tbody th.head:not(:first-child) { font-weight: 400; }
.beside figure { display: grid; grid-template-columns: minmax(0, 43rem) minmax(12rem, 1fr); gap: 1.4rem; align-items: center; }
.figures { display: flex; flex-wrap: wrap; gap: 1.2rem; align-items: flex-start; }
.status { display: inline-block; padding: 0 .5rem; border-radius: .3rem; border: 1px solid currentColor; font-size: .85rem; }
.verdict { font-size: 1.15rem; font-weight: 600; padding: .6rem .9rem; border-left: .5rem solid; max-width: none; background: var(--tint); }
.verdict.good { border-color: #0072b2; } .verdict.bad { border-color: #d55e00; }
nav { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; margin: .8rem 0; } th[aria-sort] { cursor: pointer; }
th[aria-sort=ascending]::after { content: " ▲"; } th[aria-sort=descending]::after { content: " ▼"; }
input.filter { font: inherit; padding: .05rem .5rem; border: 1px solid var(--rule); background: var(--paper); color: var(--ink); }
.chart { width: 100%; max-width: 34rem; font-size: 12px; fill: var(--ink); } .chart .axis path { stroke: var(--faint); fill: none; }
.chart .axis text { fill: var(--faint); } .chart .front { stroke: var(--accent); fill: none; stroke-width: 1.5; stroke-dasharray: 5 3; }
.chart .on { fill: var(--accent); stroke: var(--accent); } .chart .off { fill: none; stroke: var(--faint); stroke-width: 1.5; }
.ranking { display: flex; flex-wrap: wrap; gap: 1.2rem; align-items: flex-start; } .ranking section { max-width: 100%; } .ranking .chart { flex: 1 1 20rem; }
.glance { display: flex; flex-wrap: wrap; gap: 0 2rem; align-items: flex-start; } .glance .chart { flex: 0 0 26rem; max-width: 100%; } .glance section { max-width: 100%; } .glance .caption { max-width: 30rem; }
.scans { display: grid; grid-template-columns: repeat(auto-fill, minmax(12rem, 1fr)); gap: .8rem; }
.scans figure { margin: 0; } .scan { width: 100%; fill: none; stroke: var(--faint); stroke-width: 3; border: 1px solid var(--rule); }
.scan .points { stroke: var(--ink); stroke-linecap: round; stroke-width: 3; } .scan .right { stroke: #009e73; stroke-width: 5; } .scan .sensor { fill: var(--ink); stroke: none; }
.scan .split { stroke: #e69f00; stroke-width: 6; stroke-dasharray: 12 7; } .scan .false { stroke: #d55e00; stroke-width: 7; stroke-dasharray: 5 6; }
.scan .small { stroke: #56b4e9; stroke-width: 5; stroke-dasharray: 16 5; }
.scan .missed { stroke: #cc79a7; stroke-width: 7; stroke-dasharray: 14 5 4 5; } .key { display: flex; flex-wrap: wrap; gap: .3rem 1.2rem; }
.key .scan { width: 3.2rem; border: 0; vertical-align: middle; } .tools { display: flex; gap: .5rem; margin: .3rem 0; font-size: .86rem; }
.tools:not(:hover, :focus-within) button { opacity: .55; } .tools button { font: inherit; padding: .05rem .5rem; border: 1px solid var(--rule); background: var(--paper); color: var(--ink); cursor: pointer; }
.spark { vertical-align: middle; color: var(--accent); } figure img { cursor: zoom-in; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 22rem), 1fr)); gap: 1.2rem; }
dialog { max-width: 96vw; max-height: 96vh; padding: .5rem; border: 0; background: #fff; } dialog img { max-width: 92vw; max-height: 88vh; }
.matrices { display: flex; flex-wrap: wrap; gap: .6rem 2rem; align-items: flex-start; } .matrices section { max-width: 100%; } .matrices td { text-align: left; }
.matrices thead th { white-space: normal; overflow-wrap: anywhere; max-width: 9rem; text-align: left; vertical-align: bottom; } .matrices td a { text-decoration: none; }
td.worse, .chip.worse, td.missing, .chip.missing { background: #d55e0030; box-shadow: inset .25rem 0 #d55e00; } td.better, .chip.better { background: #0072b22b; box-shadow: inset .25rem 0 #0072b2; }
td.failed, .chip.failed { background: #cc79a740; box-shadow: inset .25rem 0 #cc79a7; } td.uncertain, .chip.uncertain { background: #e69f0030; box-shadow: inset .25rem 0 #e69f00; }
.chips { flex: 1 1 100%; } .chips h3 { margin: .2rem 0; } .chips div { display: grid; grid-template-columns: repeat(auto-fill, minmax(10.5rem, 1fr)); gap: .25rem .4rem; }
.chip { padding: .1rem .3rem .1rem .55rem; background: var(--tint); font-size: .82rem; line-height: 1.3; text-decoration: none; overflow-wrap: anywhere; } .chip b, .chip small { display: block; color: var(--ink); } .chip small { color: var(--faint); }
.nights tbody th.head:last-child { white-space: normal; min-width: 16rem; font-weight: 400; } .nights th.head { vertical-align: top; }
/* On a narrow screen a change has two lines: what changed, then before, now, difference and seed. */
@media (max-width: 600px) {
  .changes tr { display: grid; grid-template-columns: 1fr 1fr 1.5fr .7fr; } .changes th, .changes td { white-space: normal; overflow-wrap: anywhere; }
  .changes tr > :nth-child(3) { grid-column: 3 / 5; } .changes tr > :nth-child(n+7):nth-child(-n+10) { display: none; } .changes table { width: 100%; }
}
@media print { nav, .tools { display: none; } body { max-width: none; } .scroll { overflow: visible; } }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .1rem 1rem; font-size: .86rem; } dt { color: var(--faint); } dd { margin: 0; overflow-wrap: anywhere; }
)css";

// Tables sort by a click or Enter on a heading, filter by text and can be saved; a figure opens large. The page reads
// without it.
constexpr std::string_view kScript = R"js(
for (const table of document.querySelectorAll('table')) {
  const body = table.tBodies[0];
  if (!body || body.rows.length < 3) continue;
  const heads = [...table.tHead.rows[table.tHead.rows.length - 1].cells];
  const value = (row, c) => {
    const text = row.cells[c] ? row.cells[c].textContent.trim() : '';
    const number = parseFloat(text.replace('−', '-'));
    return isNaN(number) ? text : number;
  };
  heads.forEach((head, c) => {
    head.tabIndex = 0;
    head.setAttribute('aria-sort', 'none');
    head.title = 'sort';
    const sort = () => {
      const up = head.getAttribute('aria-sort') === 'descending';
      heads.forEach(h => h.setAttribute('aria-sort', 'none'));
      head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
      const rows = [...body.rows].sort((a, b) => {
        const x = value(a, c), y = value(b, c);
        const order = typeof x === 'number' && typeof y === 'number' ? x - y : String(x).localeCompare(String(y));
        return up ? order : -order;
      });
      body.append(...rows);
    };
    head.addEventListener('click', sort);
    head.addEventListener('keydown', e => { if (e.key === 'Enter') sort(); });
  });
  const tools = document.createElement('div');
  tools.className = 'tools';
  table.parentElement.before(tools);
  const texts = row => [...row.cells].map(cell => cell.innerText.trim().replace(/\s+/g, ' '));
  const records = () => {
    const names = heads.map(head => head.textContent.trim());
    return [...body.rows].map(row => Object.fromEntries(texts(row).map((text, c) => [names[c] || 'column ' + c, text])));
  };
  const field = text => /[",\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  const csv = () => [heads.map(head => head.textContent.trim()), ...[...body.rows].map(texts)]
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
)js";

std::string html_text(const std::string& text) {
  return html_escaped(plain_text(text));
}

/// ' name="value"', or nothing without a value.
std::string attribute(const char* name, const std::string& value) {
  return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, html_text(value));
}

std::string html_line(const Prose& prose) {
  std::string out;
  for (const TextSpan& span : prose.spans) {
    std::string text = html_text(span.text);
    if (span.look != TextSpan::Look::plain)
      text = fmt::format("<{0}>{1}</{0}>", span.look == TextSpan::Look::bold ? "b" : "code", text);
    if (!span.address.empty())
      text = fmt::format("<a{}{}>{}</a>", attribute("href", span.address), attribute("title", span.hint), text);
    out += text;
  }
  return out;
}

struct HtmlWriter {
  std::string operator()(const Heading& heading) const {
    return fmt::format("<h{0}{1}>{2}</h{0}>\n", heading.level, attribute("id", heading.id), html_line(heading.text));
  }
  std::string operator()(const Paragraph& paragraph) const {
    return fmt::format("<p{}>{}</p>\n", attribute("class", paragraph.style), html_line(paragraph.text));
  }
  std::string operator()(const BulletList& list) const {
    std::string out = "<ul>\n";
    for (const Prose& item : list.items) out += "<li>" + html_line(item) + "</li>\n";
    return out + "</ul>\n";
  }
  std::string operator()(const Definitions& definitions) const {
    std::string out = "<dl>\n";
    for (const auto& [name, meaning] : definitions.items)
      out += "<dt>" + html_text(name) + "</dt><dd>" + html_text(meaning) + "</dd>\n";
    return out + "</dl>\n";
  }
  std::string operator()(const Table& table) const { return to_html(table); }
  std::string operator()(const Picture& picture) const {
    const std::string& source = picture.data.empty() ? picture.address : picture.data;
    std::string shown = picture.drawing;
    if (shown.empty() && !source.empty())
      shown = fmt::format("<img{} alt=\"{}\" src=\"{}\">", picture.data.empty() ? " loading=\"lazy\"" : "",
                          html_text(picture.alt), html_escaped(source));
    if (shown.empty()) return (*this)(Paragraph{picture.caption, "faint"});
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", shown, html_line(picture.caption));
  }
  std::string operator()(const ContentLinks& contents) const {
    std::string out = "<nav>";
    for (const auto& [id, title] : contents.places) out += html_line({link(title, "#" + id)});
    return out + "</nav>\n";
  }
  std::string operator()(const Markup& markup) const { return markup.html; }
  std::string operator()(const Fold& fold) const {
    return fmt::format("<details><summary>{}</summary>\n{}</details>\n", html_text(fold.summary), to_html(fold.blocks));
  }
  std::string operator()(const BlockGroup& group) const {
    return fmt::format("<div{}{}>\n{}</div>\n", attribute("class", group.style), attribute("id", group.id),
                       to_html(group.blocks));
  }
};

}  // namespace

std::string to_html(const Blocks& blocks) {
  std::string out;
  for (const Block& block : blocks) out += std::visit(HtmlWriter{}, static_cast<const AnyBlock&>(block));
  return out;
}

std::string to_html(const Document& document) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n"
      "<title>{0}</title><style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n{2}<script>{3}</script></body></html>\n",
      html_text(document.title), kStyle, to_html(document.blocks), kScript);
}

}  // namespace scanbench::results
