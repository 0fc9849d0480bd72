// Builds the page that plays scans: its style, its script, and its data as JSON in a script element that is not
// executed.
#include "harness/results/player/player_page.hpp"

#include <fmt/format.h>

#include <string_view>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/json.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/document/html_page.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/runs/store/manifest.hpp"

namespace scanbench::results {
namespace {

// The colours of verdicts are those of figures and of the small pictures of scans.
constexpr std::string_view kPlayerStyle = R"css(<style>
:root { --point: #1b1f24; --truth: #c9ced3; --right: #009e73; --split: #e69f00; --false: #d55e00; --small: #56b4e9; --missed: #cc79a7; }
@media (prefers-color-scheme: dark) { :root { --point: #e6e9ec; --truth: #4b545c; } }
.bar { display: flex; flex-wrap: wrap; gap: .3rem 1.1rem; align-items: center; margin: .5rem 0; }
.bar label { white-space: nowrap; } .bar select { max-width: 16rem; } select, button, #number { font: inherit; color: var(--ink);
  background: var(--paper); border: 1px solid var(--rule); padding: .1rem .4rem; } #number { width: 5.5rem; }
#scan { width: 100%; } #view { width: 100%; height: 60vh; min-height: 18rem; border: 1px solid var(--rule);
  display: block; cursor: grab; touch-action: none; }
#what { font-variant-numeric: tabular-nums; min-height: 1.5em; } .swatch { display: inline-block; width: 1.6rem; border-top: 3px solid; vertical-align: middle; }
#key { display: flex; flex-wrap: wrap; gap: .1rem 1.2rem; } #key svg { width: 2.6rem; height: .7rem; vertical-align: middle; } #key path { fill: none; }
#facts { overflow-x: auto; } #facts table { margin: .3rem 0; } #facts .unjudged tr > :nth-child(n+3):nth-child(-n+8) { display: none; } kbd { border: 1px solid var(--rule); border-radius: .2rem; padding: 0 .3rem; }
@media (max-width: 600px) { body { padding: .7rem; } h1 { font-size: 1.1rem; } #view { height: 48vh; } }
</style>)css";

// The picture is above the controls, so that a phone shows it first.
constexpr std::string_view kPlayerBody = R"html(<p id="what" aria-live="polite"></p>
<canvas id="view" tabindex="0" aria-label="the scan and the lines found in it, sensor frame"></canvas>
<input id="scan" type="range" min="0" value="0" aria-label="scan">
<div class="bar">
<label>go to scan <input id="number" type="number" min="0" step="1"></label>
<button id="play" type="button">play</button><button id="fit" type="button">fit</button>
<label>recording <select id="recording"></select></label>
<label>seed <select id="seed"></select></label>
<label>order <select id="order"></select></label>
<label id="walls"><input id="truth" type="checkbox" checked> true walls</label>
<span id="methods" class="bar"></span></div>
<p id="key" class="faint"></p>
<div id="facts"><table><thead><tr><th class="head">pipeline</th><th>lines</th><th>right</th><th>false</th><th>missed</th><th>split</th>
<th>on walls too small</th><th>F1</th><th>returns without a line</th><th>RMS distance of the others from their lines</th></tr></thead><tbody></tbody></table></div>
<p id="note" class="faint"></p>
<p class="faint"><kbd>←</kbd> <kbd>→</kbd> one scan, <kbd>Page Up</kbd> <kbd>Page Down</kbd> ten,
<kbd>Home</kbd> <kbd>End</kbd> first and last in this order, <kbd>Space</kbd> play; wheel zooms, dragging moves.
The sensor is the triangle; x is upwards. With one pipeline shown, colours are verdicts; with several they are those of the
pipelines. The address of this page leads to the scan that it shows.</p>)html";

constexpr std::string_view kPlayerScript = R"js(<script>
(() => {
'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const el = id => document.getElementById(id);
const int16 = text => {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return Array.from({length: bytes.length / 2}, (_, i) => (bytes[2 * i] | bytes[2 * i + 1] << 8) << 16 >> 16);
};
// Dashes of verdicts, in pixels: right, split, false, on a wall too small to judge, too short to judge, missed.
const looks = {r: ['right', [], '--right', 2], s: ['split', [10, 5], '--split', 2.5], f: ['false', [2, 5], '--false', 3.5],
  m: ['missed', [10, 4, 3, 4], '--missed', 3], w: ['right, on a wall too small to judge', [14, 4], '--small', 2.5],
  u: ['too short to judge', [], '--faint', 1.5]};
const hidden = new Set();  // names of pipelines
const starts = counts => { let at = 0; return counts.map(n => (at += n) - n); };
for (const r of data) {
  r.ranges = int16(r.ranges);
  for (const p of r.pipelines) {
    p.lines = int16(p.lines); p.first = starts(p.counts);
    p.missed = int16(p.missed); p.first_missed = starts(p.missed_counts);
    p.judged = p.missed_counts.some(n => n > 0) || /[rsfw]/.test(p.verdicts);
  }
}
let rec, order, at = 0, view, moved = false, timer = 0, wanted = '';  // moved: the reader has chosen the view
const shown_pipelines = () => rec.pipelines.filter(p => !hidden.has(p.name));
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
  if (rec.walls && el('truth').checked) walls(g, i, X, Y, css('--truth'));
  g.lineCap = 'round'; g.fillStyle = css('--point');
  far_points(i, (x, y) => { g.beginPath(); g.arc(X(x, y), Y(x, y), 1.6, 0, 7); g.fill(); });
  g.lineCap = 'butt';
  const shown = shown_pipelines(), alone = shown.length === 1 && shown[0].judged;
  for (const [n, p] of shown.entries()) {  // the first lies widest below the others, so that equal lines all show
    const wider = 2.5 * Math.min(6, shown.length - 1 - n), own = ink(p, css);
    const line = (letter, l, k) => { const [, dash, color, width] = looks[letter];
      g.strokeStyle = alone ? css(color) : own; g.lineWidth = width + wider; g.setLineDash(dash); segment(l, k); };
    for (let k = 0; k < p.missed_counts[i]; ++k) line('m', p.missed, p.first_missed[i] + k);
    for (const letter of 'uwrsf') for (let k = p.first[i]; k < p.first[i] + p.counts[i]; ++k)
      if (p.verdicts[k] === letter) line(letter, p.lines, k);  // rare verdicts on top
  }
  g.setLineDash([]); g.fillStyle = css('--faint');
  const sx = X(0, 0), sy = Y(0, 0);
  g.beginPath(); g.moveTo(sx, sy - 9); g.lineTo(sx - 6, sy + 6); g.lineTo(sx + 6, sy + 6); g.fill();
}
function walls(g, i, X, Y, color) {  // from the world into the frame of the sensor
  const [x, y, yaw] = rec.poses.slice(3 * i, 3 * i + 3), c = Math.cos(yaw), s = Math.sin(yaw), w = rec.walls;
  const place = k => { const dx = w[k] - x, dy = w[k + 1] - y; return [c * dx + s * dy, c * dy - s * dx]; };
  g.beginPath();
  for (let k = 0; k < w.length; k += 4) { const a = place(k), b = place(k + 2); g.moveTo(X(...a), Y(...a)); g.lineTo(X(...b), Y(...b)); }
  g.strokeStyle = color; g.lineWidth = 6; g.lineCap = 'butt'; g.setLineDash([]); g.stroke();
}
function key() {
  const shown = shown_pipelines(), judged = shown.some(p => p.judged), alone = shown.length === 1 && judged;
  const entry = (text, style, width, dash) => '<span><svg viewBox="0 0 42 10"><path d="M1 5H41" style="stroke: ' + style + '; stroke-width: ' +
    width + '" stroke-dasharray="' + dash + '"/></svg> ' + text + '</span>';
  el('key').innerHTML = (rec.walls && el('truth').checked ? entry('true wall', 'var(--truth)', 6, '') : '') +
    (judged ? Object.values(looks).map(([text, dash, color, width]) => entry(text, 'var(' + (alone ? color : '--point') + ')', width, dash.join(' '))).join('') : '');
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
    const cells = [p.counts[i], count(p, 'r'), count(p, 'f'), p.missed_counts[i], count(p, 's'), count(p, 'w'),
      p.f1 && p.f1[i] !== null ? p.f1[i].toFixed(3) : '', number(p.unexplained[i], '%', 100), number(p.residual_m[i], 'cm', 100)];
    for (const cell of cells) row.insertCell().textContent = cell;
  }
}
// SCENARIO/SCAN is of the first seed, with all pipelines; else SCENARIO/PIPELINES/SEED/SCAN.
function address() {
  const shown = shown_pipelines(), frame = rec.frames[shown_scan()];
  const plain = rec === data.find(r => r.name === rec.name) && shown.length === rec.pipelines.length;
  return '#' + (plain ? [rec.name, frame] : [rec.name, shown.map(p => p.name).join(','), rec.seed, frame]).map(encodeURIComponent).join('/');
}
function remember() { try { history.replaceState(null, '', address()); } catch (e) { } }
function go(k, keep_view) {
  at = Math.max(0, Math.min(order.length - 1, k));
  el('scan').value = at;
  const i = shown_scan();
  el('number').value = rec.frames[i];
  el('what').textContent = 'scan ' + rec.frames[i] + ' (0 to ' + (rec.of - 1) + '), place ' + (at + 1) + ' of ' + order.length + ' in this order' + wanted;
  wanted = '';
  if (!keep_view) fit();
  table(i); draw(); remember();
}
function go_to(frame) {  // the nearest of the scans that the page holds
  let best = 0;
  rec.frames.forEach((f, i) => { if (Math.abs(f - frame) < Math.abs(rec.frames[best] - frame)) best = i; });
  if (rec.frames[best] !== frame) wanted += '. There is no scan ' + frame + ' on this page; this one is the nearest';
  go(order.indexOf(best));
}
function sort() {
  const [key, name] = el('order').value.split(' of ');
  order = rec.frames.map((_, i) => i);
  const p = rec.pipelines.find(p => p.name === name);
  const value = i => { const v = p[key][i]; return v === null ? -Infinity : v; };
  if (p) order.sort((a, b) => value(b) - value(a) || a - b);
}
function choose(chosen) {
  rec = chosen;
  const seeds = data.filter(r => r.name === rec.name);
  el('recording').value = rec.name;
  el('seed').replaceChildren(...seeds.map(r => new Option(r.seed, r.seed)));
  el('seed').value = rec.seed;
  el('seed').parentElement.hidden = seeds.length < 2;
  el('walls').hidden = !rec.walls;
  const options = [['number', 'by number']];
  for (const p of rec.pipelines) {
    if (p.error) options.push(['error of ' + p.name, 'lowest F1 of ' + p.name]);
    options.push(['unexplained of ' + p.name, 'most returns without a line, ' + p.name]);
    options.push(['residual_m of ' + p.name, 'largest RMS distance from lines, ' + p.name]);
  }
  const by = el('order').value;
  el('order').replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  if (options.some(([value]) => value === by)) el('order').value = by;
  el('methods').replaceChildren(...rec.pipelines.map(p => {
    const label = document.createElement('label'), box = document.createElement('input'), swatch = document.createElement('span');
    box.type = 'checkbox'; box.checked = !hidden.has(p.name);
    box.addEventListener('change', () => { if (box.checked) hidden.delete(p.name); else hidden.add(p.name); key(); draw(); remember(); });
    swatch.className = 'swatch'; swatch.style.borderColor = p.color === '#000000' ? 'var(--point)' : p.color;
    label.append(box, ' ', swatch, ' ' + p.name);
    return label;
  }));
  key();
  const cut = rec.frames.length < rec.of ? ' This page holds ' + rec.frames.length + ' of its ' + rec.of +
    ' scans: those with the largest errors, and an even selection of the others.' : '';
  el('note').textContent = rec.note + cut;
  el('scan').max = rec.frames.length - 1;
  sort();
}
const play = () => { if (timer) { clearInterval(timer); timer = 0; el('play').textContent = 'play'; }
  else { timer = setInterval(() => at + 1 < order.length ? go(at + 1, true) : play(), 120); el('play').textContent = 'stop'; } };
const names = [...new Set(data.map(r => r.name))];
el('recording').replaceChildren(...names.map(name => new Option(name, name)));
el('recording').addEventListener('change', e => { choose(data.find(r => r.name === e.target.value)); go(0); });
el('seed').addEventListener('change', e => {
  const frame = rec.frames[shown_scan()];
  choose(data.find(r => r.name === rec.name && r.seed === e.target.value)); go_to(frame);
});
el('number').addEventListener('change', e => go_to(Math.round(+e.target.value)));
el('truth').addEventListener('change', () => { key(); draw(); });
el('order').addEventListener('change', () => { sort(); go(0); });
el('scan').addEventListener('input', e => go(+e.target.value));
el('play').addEventListener('click', play);
el('fit').addEventListener('click', () => { fit(); draw(); });
document.addEventListener('keydown', e => {
  if (e.target.tagName === 'SELECT' || e.target === el('number') || e.target.type === 'checkbox' || e.ctrlKey || e.metaKey || e.altKey) return;
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
function open_address() {
  const parts = location.hash.slice(1).split('/').map(decodeURIComponent);
  const [name, pipelines, seed] = parts.length === 4 ? parts : [parts[0]];
  const seeds = data.filter(r => r.name === name);
  const found = seeds.find(r => r.seed === seed) || seeds[0] || data[0];
  hidden.clear();
  if (pipelines) for (const p of found.pipelines) if (!pipelines.split(',').includes(p.name)) hidden.add(p.name);
  if (hidden.size === found.pipelines.length) hidden.clear();
  choose(found);
  if (seed !== undefined && found.seed !== seed) wanted = '. This page does not hold seed ' + seed + '; this is seed ' + found.seed;
  if (seeds.length === 0 || parts.length < 2) go(0); else go_to(+parts[parts.length - 1] || 0);
}
window.addEventListener('hashchange', open_address);
open_address();
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

/// The page of what played_run() packed.
std::string page_of(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                    const nlohmann::ordered_json& recordings, const PlayerLimits& limits) {
  const std::string what =
      scenarios.size() == 1 ? words_of_name(scenarios.front().name) : fmt::format("{} scenarios", scenarios.size());
  return to_html(Document{
      .title = "Scans of " + what,
      .blocks = {Markup{std::string(kPlayerStyle) + std::string(kPlayerBody)},
                 Paragraph{fmt::format("The page holds the first seed of each scenario and others that fit: at most {} "
                                       "scans of a recording, and about {} MiB in all.",
                                       limits.scans, limits.bytes >> 20),
                           "faint"},
                 Markup{"<script type=\"application/json\" id=\"data\">" + script_data(recordings) + "</script>\n" +
                        std::string(kPlayerScript)}},
      .lead = "The scans, with the lines that each pipeline found in them.",
      .stamp = stamp_of(runs::manifest_facts(run), {})});
}

}  // namespace

std::string player_page(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                        const PlayerLimits& limits) {
  const auto recordings = played_run(run, scenarios, limits);
  if (recordings.empty())
    throw ConfigError(run.string() +
                      ": there are no scans with lines to play: no recording with scans has a pipeline "
                      "that ended well");
  return page_of(run, scenarios, recordings, limits);
}

bool write_player(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                  const PlayedRecordings& chosen) {
  const auto recordings = played_run(run, scenarios, {}, chosen);
  if (recordings.empty()) {
    io::remove_file(run / kPlayerPage);  // of an earlier run in this folder
    return false;
  }
  io::write_file_atomically(run / kPlayerPage, page_of(run, scenarios, recordings, {}));
  return true;
}

std::string player_address(const runs::CellKey& key, std::size_t frame) {
  return fmt::format("{}#{}/{}/{}/{}", kPlayerPage.name(), key.scenario, key.pipeline, key.seed, frame);
}

}  // namespace scanbench::results
