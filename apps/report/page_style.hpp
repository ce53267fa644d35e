#pragma once

namespace app {

/// How a page looks: one column for reading, wider for pictures and tables.
inline constexpr const char* page_style = R"css(
:root{--ground:#fff;--ink:#22262b;--quiet:#5b646d;--line:#dde1e5;--card:#f6f7f9;--accent:#0b5c94;
--good:#0b6b4f;--good-ground:#dff3ea;--bad:#a13b00;--bad-ground:#fde9dc;--open:#555f69;--open-ground:#e9ecef}
@media screen and (prefers-color-scheme:dark){:root{--ground:#14171a;--ink:#e4e6e8;--quiet:#9da6ae;--line:#31373d;
--card:#1b1f23;--accent:#6fb7ea;--good:#6fd3ae;--good-ground:#12352a;--bad:#ffab7a;--bad-ground:#40210f;
--open:#b6bec5;--open-ground:#2a2f35}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--ground);color:var(--ink);font:1rem/1.6 system-ui,-apple-system,"Segoe UI",sans-serif;
overflow-wrap:break-word}
header,main{max-width:74rem;margin:0 auto;padding:0 1.25rem}
header{padding-top:3rem}
main{padding-bottom:4rem}
h1{font-size:clamp(1.7rem,4.5vw,2.6rem);line-height:1.15;letter-spacing:-.02em;margin:0 0 .8rem;max-width:24em;
text-wrap:balance}
h2{font-size:1.45rem;letter-spacing:-.01em;line-height:1.25;margin:3.5rem 0 1rem;padding-top:1rem;
border-top:1px solid var(--line)}
p{max-width:44rem;margin:0 0 1rem}
.lead{font-size:1.15rem;color:var(--quiet)}
a{color:var(--accent);text-underline-offset:.15em}
nav{display:flex;flex-wrap:wrap;gap:.3rem 1.4rem;font-size:.95rem;margin:1.2rem 0 2rem}
figure{margin:1.5rem 0 2.5rem}
.panels{display:grid;gap:1rem;grid-template-columns:minmax(0,1fr)}
.panels>div{background:var(--card);border-radius:.6rem;padding:.6rem .5rem .4rem}
.panels p{margin:.2rem .5rem .3rem;font-size:.9rem;font-weight:600}
.panels svg{display:block;width:100%;height:auto}
@media (min-width:46rem){.of-1{max-width:38rem}.of-2,.of-3{grid-template-columns:repeat(2,minmax(0,1fr))}}
@media (min-width:64rem){.of-3{grid-template-columns:repeat(3,minmax(0,1fr))}}
figcaption{max-width:50rem;margin-top:.7rem;font-size:.95rem;color:var(--quiet)}
figcaption b{color:var(--ink)}
.table{overflow-x:auto;margin:1.2rem 0 2rem}
table{border-collapse:collapse;font-size:.95rem;line-height:1.45;min-width:min(100%,40rem)}
caption{text-align:left;font-weight:600;padding-bottom:.5rem}
th,td{text-align:left;vertical-align:top;padding:.5rem .9rem .5rem 0;border-bottom:1px solid var(--line)}
th{color:var(--quiet);font-weight:600;font-size:.88rem}
.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
th.number{white-space:normal}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,10.5rem),1fr));gap:.8rem;margin:1.5rem 0}
.tiles div{background:var(--card);border-radius:.6rem;padding:.8rem 1rem}
.tiles dt{font-size:.88rem;color:var(--quiet);line-height:1.35}
.tiles dd{margin:.2rem 0 0;font-size:1.7rem;font-weight:650;letter-spacing:-.02em;line-height:1.2;
font-variant-numeric:tabular-nums}
.badge{display:inline-block;border-radius:1rem;padding:.1em .75em;font-size:.9em;font-weight:600;white-space:nowrap}
.reproduced{color:var(--good);background:var(--good-ground)}
.contradicted{color:var(--bad);background:var(--bad-ground)}
.undecidable{color:var(--open);background:var(--open-ground)}
.rule{display:block;color:var(--quiet);font-size:.9em;margin-top:.2rem}
pre{background:var(--card);border-radius:.6rem;padding:.9rem 1.1rem;overflow-x:auto;font-size:.9rem}
code{font-family:ui-monospace,"SF Mono",Menlo,Consolas,monospace}
@media screen and (max-width:46rem){
.stacks table,.stacks tbody,.stacks tr,.stacks td{display:block;border:0;padding:0;min-width:0}
.stacks thead{display:none}
.stacks tr{background:var(--card);border-radius:.6rem;padding:.8rem 1rem;margin-bottom:.8rem}
.stacks td{padding:.15rem 0}
.stacks td::before{content:attr(data-label);display:block;color:var(--quiet);font-size:.8rem}
}
@media print{header,main{max-width:none;padding:0}nav{display:none}figure,tr{break-inside:avoid}h2{break-after:avoid}
.panels>div,.tiles div,pre{border:1px solid var(--line)}a{color:inherit;text-decoration:none}body{font-size:10pt}
.table{overflow:visible}table{font-size:8.5pt;min-width:0}th{font-size:8pt}th,td{padding-right:.6rem}
.of-2,.of-3{grid-template-columns:repeat(2,minmax(0,1fr))}}
)css";

} // namespace app
