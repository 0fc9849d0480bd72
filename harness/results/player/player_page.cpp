// Builds the page that plays scans: its style, its script, and its data as JSON in a script element that is not
// executed.
#include "harness/results/player/player_page.hpp"

#include <fmt/format.h>

#include <string_view>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/io/files/json.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/document/html_page.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/runs/store/manifest.hpp"

namespace scanbench::results {
namespace {

constexpr std::string_view kPlayerStyle = R"css(<style>
:root { --wall: #d55e00; --point: #1b1f24; }
@media (prefers-color-scheme: dark) { :root { --wall: #ff9a5c; --point: #e6e9ec; } }
.bar { display: flex; flex-wrap: wrap; gap: .3rem 1.1rem; align-items: center; margin: .5rem 0; }
.bar label { white-space: nowrap; } select, button { font: inherit; color: var(--ink); background: var(--paper);
  border: 1px solid var(--rule); padding: .1rem .4rem; }
#scan { width: 100%; } #view { width: 100%; height: 62vh; min-height: 20rem; border: 1px solid var(--rule);
  display: block; cursor: grab; touch-action: none; }
#what { font-variant-numeric: tabular-nums; min-height: 1.5em; } .swatch { display: inline-block; width: 1.6rem; border-top: 3px solid; vertical-align: middle; }
#facts { overflow-x: auto; } #facts table { margin: .3rem 0; } #facts .unjudged tr > :nth-child(n+3):nth-child(-n+6) { display: none; } kbd { border: 1px solid var(--rule); border-radius: .2rem; padding: 0 .3rem; }
</style>)css";

constexpr std::string_view kPlayerBody = R"html(<div class="bar">
<label>recording <select id="recording"></select></label>
<label>order <select id="order"></select></label>
<span id="methods" class="bar"></span>
<button id="play" type="button">play</button><button id="fit" type="button">fit</button></div>
<p id="note" class="faint"></p>
<p id="what" aria-live="polite"></p>
<input id="scan" type="range" min="0" value="0" aria-label="scan">
<canvas id="view" tabindex="0" aria-label="the scan and the lines found in it, sensor frame"></canvas>
<p class="faint"><kbd>←</kbd> <kbd>→</kbd> one scan, <kbd>Page Up</kbd> <kbd>Page Down</kbd> ten,
<kbd>Home</kbd> <kbd>End</kbd> first and last in this order, <kbd>Space</kbd> play; wheel zooms, dragging moves.
Solid lines are right or too short to judge, dashed ones false, dotted ones pieces of a wall that another line explains
already, those of long dashes right on a wall too small to judge; thick pale lines are walls that a method missed. The sensor is the triangle; x is upwards.</p>
<div id="facts"><table><thead><tr><th class="head">pipeline</th><th>lines</th><th>false</th><th>missed</th><th>split</th>
<th>F1</th><th>returns without a line</th><th>RMS distance of the others from their lines</th></tr></thead><tbody></tbody></table></div>)html";

constexpr std::string_view kPlayerScript = R"js(<script>
(() => {
'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const el = id => document.getElementById(id);
const int16 = text => {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return Array.from({length: bytes.length / 2}, (_, i) => (bytes[2 * i] | bytes[2 * i + 1] << 8) << 16 >> 16);
};
const starts = counts => { let at = 0; return counts.map(n => (at += n) - n); };
for (const r of data) {
  r.ranges = int16(r.ranges);
  for (const p of r.pipelines) {
    p.lines = int16(p.lines); p.first = starts(p.counts);
    p.missed = int16(p.missed); p.first_missed = starts(p.missed_counts);
    p.shown = true;
  }
}
let rec, order, at = 0, view, moved = false, timer = 0;  // moved: the reader has chosen the view
const shown_scan = () => order[at];

function far_points(i, push) {
  for (let b = 0; b < rec.beams; ++b) {
    const r = rec.ranges[i * rec.beams + b] * rec.step_m;
    if (r <= 0) continue;
    const a = rec.angle_min_rad + b * rec.angle_step_rad;
    push(r * Math.cos(a), r * Math.sin(a));
  }
}
function fit() {  // to the returns of this scan, without the farthest twentieth
  const xs = [0], ys = [0];
  far_points(shown_scan(), (x, y) => { xs.push(x); ys.push(y); });
  const range = v => { v.sort((a, b) => a - b); const k = Math.floor(v.length / 40);
    return [Math.min(0, v[k]), Math.max(0, v[v.length - 1 - k])]; };
  const [x0, x1] = range(xs), [y0, y1] = range(ys), c = el('view');
  moved = false;
  const m = Math.max(1, 0.08 * Math.max(x1 - x0, y1 - y0));
  view = {x: (x0 + x1) / 2, y: (y0 + y1) / 2,
          scale: Math.min(c.clientWidth / (y1 - y0 + 2 * m), c.clientHeight / (x1 - x0 + 2 * m))};
}
function draw() {
  const c = el('view'), dpr = window.devicePixelRatio || 1;
  if (c.width !== Math.round(c.clientWidth * dpr)) c.width = Math.round(c.clientWidth * dpr);
  if (c.height !== Math.round(c.clientHeight * dpr)) c.height = Math.round(c.clientHeight * dpr);
  const g = c.getContext('2d'), css = name => getComputedStyle(document.documentElement).getPropertyValue(name);
  g.setTransform(dpr, 0, 0, dpr, 0, 0);
  g.clearRect(0, 0, c.clientWidth, c.clientHeight);
  const X = (x, y) => c.clientWidth / 2 - (y - view.y) * view.scale;   // x forward is up, y left is left
  const Y = (x, y) => c.clientHeight / 2 - (x - view.x) * view.scale;
  const segment = (l, k) => { const [x1, y1, x2, y2] = l.slice(4 * k, 4 * k + 4).map(v => v * rec.step_m);
    g.beginPath(); g.moveTo(X(x1, y1), Y(x1, y1)); g.lineTo(X(x2, y2), Y(x2, y2)); g.stroke(); };
  grid(g, c, X, Y, css);
  const i = shown_scan();
  g.lineCap = 'round';
  for (const p of rec.pipelines) if (p.shown) {
    g.strokeStyle = css('--wall'); g.globalAlpha = .3; g.lineWidth = 7; g.setLineDash([]);
    for (let k = 0; k < p.missed_counts[i]; ++k) segment(p.missed, p.first_missed[i] + k);
  }
  g.globalAlpha = 1; g.fillStyle = css('--point');
  far_points(i, (x, y) => { g.beginPath(); g.arc(X(x, y), Y(x, y), 1.6, 0, 7); g.fill(); });
  const dashes = {f: [7, 6], s: [2, 5], r: [], u: [], w: [12, 3]};
  const shown = rec.pipelines.filter(p => p.shown);
  for (const [n, p] of shown.entries()) {  // the first lies widest below the others, so that equal lines all show
    g.strokeStyle = ink(p, css); g.lineWidth = 2 + 2.5 * Math.min(6, shown.length - 1 - n);
    for (let k = 0; k < p.counts[i]; ++k) { g.setLineDash(dashes[p.verdicts[p.first[i] + k]]); segment(p.lines, p.first[i] + k); }
  }
  g.setLineDash([]); g.fillStyle = css('--faint');
  const sx = X(0, 0), sy = Y(0, 0);
  g.beginPath(); g.moveTo(sx, sy - 9); g.lineTo(sx - 6, sy + 6); g.lineTo(sx + 6, sy + 6); g.fill();
}
const ink = (p, css) => p.color === '#000000' ? css('--point') : p.color;  // black is invisible on a dark page
function grid(g, c, X, Y, css) {
  let step = 1; while (step * view.scale < 60) step *= step.toString()[0] === '2' ? 2.5 : 2;
  g.strokeStyle = css('--rule'); g.lineWidth = 1; g.fillStyle = css('--faint'); g.font = '11px sans-serif';
  const left = view.y + c.clientWidth / 2 / view.scale, top = view.x + c.clientHeight / 2 / view.scale;
  for (let v = Math.floor(left / step) * step; X(0, v) < c.clientWidth; v -= step) {
    g.beginPath(); g.moveTo(X(0, v), 0); g.lineTo(X(0, v), c.clientHeight); g.stroke(); g.fillText(v + ' m', X(0, v) + 3, c.clientHeight - 4); }
  for (let v = Math.floor(top / step) * step; Y(v, 0) < c.clientHeight; v -= step) {
    g.beginPath(); g.moveTo(0, Y(v, 0)); g.lineTo(c.clientWidth, Y(v, 0)); g.stroke(); g.fillText(v + ' m', 3, Y(v, 0) - 3); }
}
function table(i) {
  const number = (v, unit, f) => v === null || v === undefined ? '' : (v * f).toFixed(unit === '%' ? 1 : 2) + ' ' + unit;
  const count = (p, letter) => { let n = 0; for (let k = 0; k < p.counts[i]; ++k) n += p.verdicts[p.first[i] + k] === letter; return n; };
  const whole = el('facts').querySelector('table'), body = whole.tBodies[0];
  whole.classList.toggle('unjudged', !rec.pipelines.some(p => p.f1));
  body.replaceChildren();  // the table itself stays, because the page sorts and saves it
  for (const p of rec.pipelines) {
    const row = body.insertRow(), head = document.createElement('th');
    head.className = 'head'; head.textContent = p.name; row.append(head);
    const cells = [p.counts[i], count(p, 'f'), p.missed_counts[i], count(p, 's'),
      p.f1 && p.f1[i] !== null ? p.f1[i].toFixed(3) : '', number(p.unexplained[i], '%', 100), number(p.residual_m[i], 'cm', 100)];
    for (const cell of cells) row.insertCell().textContent = cell;
  }
}
function go(k, keep_view) {
  at = Math.max(0, Math.min(order.length - 1, k));
  el('scan').value = at;
  const i = shown_scan();
  el('what').textContent = 'scan ' + rec.frames[i] + ' (0 to ' + (rec.of - 1) + '), place ' + (at + 1) + ' of ' + order.length + ' in this order';
  if (!keep_view) fit();
  table(i); draw();
  try { history.replaceState(null, '', '#' + encodeURIComponent(rec.name) + '/' + rec.frames[i]); } catch (e) { }
}
function sort() {
  const [key, name] = el('order').value.split(' of ');
  order = rec.frames.map((_, i) => i);
  const p = rec.pipelines.find(p => p.name === name);
  const value = i => { const v = p[key][i]; return v === null ? -Infinity : v; };
  if (p) order.sort((a, b) => value(b) - value(a) || a - b);
}
function choose(index) {
  rec = data[index];
  el('recording').value = index;
  const options = [['number', 'by number']];
  for (const p of rec.pipelines) {
    if (p.error) options.push(['error of ' + p.name, 'lowest F1 of ' + p.name]);
    options.push(['unexplained of ' + p.name, 'most returns without a line, ' + p.name]);
    options.push(['residual_m of ' + p.name, 'largest RMS distance from lines, ' + p.name]);
  }
  el('order').replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  el('methods').replaceChildren(...rec.pipelines.map(p => {
    const label = document.createElement('label'), box = document.createElement('input'), swatch = document.createElement('span');
    box.type = 'checkbox'; box.checked = p.shown; box.addEventListener('change', () => { p.shown = box.checked; draw(); });
    swatch.className = 'swatch'; swatch.style.borderColor = p.color === '#000000' ? 'var(--point)' : p.color;
    label.append(box, ' ', swatch, ' ' + p.name);
    return label;
  }));
  const cut = rec.frames.length < rec.of ? ' This page holds ' + rec.frames.length + ' of its ' + rec.of +
    ' scans: those with the largest errors, and an even selection of the others.' : '';
  el('note').textContent = rec.note + cut;
  el('scan').max = rec.frames.length - 1;
  sort();
}
const play = () => { if (timer) { clearInterval(timer); timer = 0; el('play').textContent = 'play'; }
  else { timer = setInterval(() => at + 1 < order.length ? go(at + 1, true) : play(), 120); el('play').textContent = 'stop'; } };
el('recording').replaceChildren(...data.map((r, i) => new Option(r.name, i)));
el('recording').addEventListener('change', e => { choose(+e.target.value); go(0); });
el('order').addEventListener('change', () => { sort(); go(0); });
el('scan').addEventListener('input', e => go(+e.target.value));
el('play').addEventListener('click', play);
el('fit').addEventListener('click', () => { fit(); draw(); });
document.addEventListener('keydown', e => {
  if (e.target.tagName === 'SELECT' || e.ctrlKey || e.metaKey || e.altKey) return;
  const steps = {ArrowRight: 1, ArrowLeft: -1, PageDown: 10, PageUp: -10, Home: -1e9, End: 1e9};
  if (e.key in steps) go(at + steps[e.key]);
  else if (e.key === ' ' && e.target.tagName !== 'BUTTON') play();
  else return;
  e.preventDefault();
});
const canvas = el('view');
canvas.addEventListener('wheel', e => { view.scale *= Math.exp(-e.deltaY / 500); moved = true; draw(); e.preventDefault(); }, {passive: false});
canvas.addEventListener('pointerdown', e => canvas.setPointerCapture(e.pointerId));
canvas.addEventListener('pointermove', e => { if (!e.buttons) return;
  view.y += e.movementX / view.scale; view.x += e.movementY / view.scale; moved = true; draw(); });
window.addEventListener('resize', () => { if (!moved) fit(); draw(); });
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
const [name, frame] = decodeURIComponent(location.hash.slice(1)).split('/');
choose(Math.max(0, data.findIndex(r => r.name === name)));
go(Math.max(0, rec.frames.indexOf(+frame)));
})();
</script>)js";

/// JSON that cannot end the script element it is in.
std::string script_data(const nlohmann::ordered_json& json) {
  const std::string text = io::json_ascii_line(json);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string player_page(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                        const PlayerLimits& limits) {
  const auto recordings = played_run(run, scenarios, limits);
  if (recordings.empty())
    throw ConfigError(run.string() +
                      ": there are no scans with lines to play: no recording with scans has a pipeline "
                      "that ended well");
  const std::string what =
      scenarios.size() == 1 ? words_of_name(scenarios.front().name) : fmt::format("{} scenarios", scenarios.size());
  Document page{
      .title = "Scans of " + what,
      .blocks = {Markup{std::string(kPlayerStyle)},
                 Paragraph{fmt::format("A page holds at most {} scans of a recording and about {} MiB in all.",
                                       limits.scans, limits.bytes >> 20),
                           "faint"},
                 Markup{std::string(kPlayerBody) + "\n<script type=\"application/json\" id=\"data\">" +
                        script_data(recordings) + "</script>\n" + std::string(kPlayerScript)}},
      .lead = "The scans of the first seed, with the lines that each pipeline found in them.",
      .stamp = stamp_of(runs::manifest_facts(run), {})};
  return to_html(page);
}

}  // namespace scanbench::results
