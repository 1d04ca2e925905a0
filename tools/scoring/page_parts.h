#pragma once

namespace zskel::scoring {

/// The page's style sheet. `bad` marks what fails a model, `worst1` to `worst3` a column's worst.
inline constexpr const char* kPageStyle = R"css(
:root { --ink: #22262c; --soft: #69707a; --line: #e3e5e8; --bad: #f6c9bd; --accent: #0072b2; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1600px; padding: 34px 32px 60px; color: var(--ink);
  background: #fff; font: 14px/1.45 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
h1 { margin: 0; font-size: 28px; font-weight: 650; letter-spacing: -0.01em; }
h2 { margin: 44px 0 14px; font-size: 19px; font-weight: 650; }
code { font: 13px ui-monospace, "DejaVu Sans Mono", Menlo, monospace; }
.sub { margin: 6px 0 22px; color: var(--soft); }
.tiles { display: flex; gap: 12px; margin-bottom: 26px; }
.tile { flex: 1; padding: 12px 16px; border: 1px solid var(--line); border-radius: 8px; }
.tile b { display: block; font-size: 25px; font-weight: 650; line-height: 1.2; }
.tile span { color: var(--soft); font-size: 13px; }
.tile.bad { border-color: transparent; }
table { width: 100%; border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 5px 6px; text-align: right; white-space: nowrap; }
th { font-weight: 550; color: var(--soft); font-size: 12.5px; }
thead tr:first-child th { text-align: center; color: var(--ink); font-weight: 650; padding-bottom: 1px; }
thead tr:first-child th.group { border-bottom: 1px solid var(--line); }
thead tr:last-child { border-bottom: 2px solid var(--ink); }
thead tr:last-child th { cursor: pointer; user-select: none; vertical-align: bottom; }
thead tr:last-child th:hover { color: var(--accent); }
th[data-order="1"]::after { content: " \25b4"; } th[data-order="-1"]::after { content: " \25be"; }
th:first-child, td:first-child { text-align: left; }
td:first-child { font-weight: 550; }
th.first, td.first { padding-left: 18px; }
tbody tr { border-bottom: 1px solid var(--line); }
tbody tr:hover { background: #f5f8fb; }
tfoot td { border-top: 2px solid var(--ink); color: var(--soft); font-weight: 550; }
.bad { background: var(--bad); }
.worst1 { background: #fbe2b4; } .worst2 { background: #fdeed2; } .worst3 { background: #fef7e9; }
.failure { text-align: left; background: var(--bad); white-space: normal; }
a { color: inherit; text-decoration: none; } a:hover { color: var(--accent); }
.note { color: var(--soft); margin: 10px 0 0; }
.swatch { padding: 1px 7px; border-radius: 3px; color: var(--ink); }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); gap: 18px; }
.card { border: 1px solid var(--line); border-radius: 8px; overflow: hidden; }
.card img { display: block; width: 100%; }
.card div { padding: 10px 14px 12px; border-top: 1px solid var(--line); }
.card b { font-weight: 650; } .card p { margin: 3px 0 0; color: var(--soft); font-size: 13px; }
.card p.wrong { color: #a8351a; }
dl { columns: 3; column-gap: 40px; margin: 0; }
dl section { break-inside: avoid; margin-bottom: 14px; }
dt { font-weight: 600; } dd { margin: 0 0 8px; color: #3e444c; }
@media (max-width: 1100px) { dl { columns: 1; } .tiles { flex-wrap: wrap; } }
)css";

/// Sorts the table's rows by the column whose heading is clicked; what has no value stays last.
inline constexpr const char* kPageScript = R"js(
document.querySelectorAll("thead tr:last-child th").forEach((head, column) => {
  head.addEventListener("click", () => {
    const order = head.dataset.order === "-1" ? 1 : -1;
    document.querySelectorAll("th[data-order]").forEach(th => th.removeAttribute("data-order"));
    head.dataset.order = order;
    const body = document.querySelector("tbody");
    const key = row => row.cells[column]?.dataset.v ?? "";
    const compare = (a, b) => column === 0 ? a.localeCompare(b) : a - b;
    [...body.rows].sort((a, b) => {
      const [x, y] = [key(a), key(b)];
      return x === "" || y === "" ? (x === "") - (y === "") : order * compare(x, y);
    }).forEach(row => body.append(row));
  });
});
)js";

}  // namespace zskel::scoring
