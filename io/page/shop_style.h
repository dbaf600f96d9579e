#pragma once
// The style of the page of a history: light and dark, for screen and paper. Used inside io only.

namespace clsurf::io {

inline constexpr const char* shop_style = R"(
:root{color-scheme:light dark;--paper:#fff;--ink:#16181d;--soft:#5a5f6a;--line:#dfe1e6;--bar:#005ab2;--share:#b34700;--mark:#c01e1e;--g0:#005ab2;--g1:#c25400;--g2:#00795a;--g3:#9a3f80;--g4:#6e5500;--g5:#50545c}
@media (prefers-color-scheme:dark){:root{--paper:#14161a;--ink:#e8e9ec;--soft:#a5aab5;--line:#33373f;--bar:#6cb0ff;--share:#ffa260;--mark:#ff7b7b;--g0:#6cb0ff;--g1:#ffa260;--g2:#4fd1a5;--g3:#e69ad0;--g4:#d9c063;--g5:#b4b9c4}}
@media print{:root{--paper:#fff;--ink:#000;--soft:#444;--line:#ccc}section{break-inside:avoid}}
body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.45 system-ui,"DejaVu Sans",sans-serif}
main{max-width:1060px;margin:0 auto;padding:20px 24px 60px}
h1{font-size:24px;margin:0 0 4px}h1 small{font-size:14px;font-weight:400;color:var(--soft)}
h2{font-size:18px;margin:34px 0 6px;border-bottom:1px solid var(--line);padding-bottom:4px}
figure{margin:14px 0}figcaption{color:var(--soft)}figcaption b{color:var(--ink)}
.legend span{margin-right:16px;white-space:nowrap}.key{width:14px;height:14px;vertical-align:-2px;margin-right:5px}
.chart{width:100%;height:auto;display:block}.tick{fill:var(--soft);font-size:12px}
.grid{stroke:var(--line)}.axis{stroke:var(--soft)}.level{stroke:var(--soft);stroke-width:1.5}
.change{stroke:var(--mark);stroke-width:1.5;stroke-dasharray:5 4}
.bar{fill:var(--bar)}path.share{fill:none;stroke:var(--share);stroke-width:2}circle.share{fill:var(--share)}
.g0{fill:var(--g0)}.g1{fill:var(--g1)}.g2{fill:var(--g2)}.g3{fill:var(--g3)}.g4{fill:var(--g4)}.g5{fill:var(--g5)}
.wide{overflow-x:auto}table{border-collapse:collapse;margin:10px 0;font-size:14px}
th,td{padding:3px 12px 3px 0;text-align:left;border-bottom:1px solid var(--line);vertical-align:top}th{color:var(--soft);font-weight:600}
td.n{text-align:right;font-variant-numeric:tabular-nums}
)";

}  // namespace clsurf::io
