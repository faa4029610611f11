#include "compare/report/html.hpp"

namespace surge::compare {

namespace {

constexpr const char* style = R"css(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 62rem; padding: 1rem 1.25rem 4rem; background: #fff; color: #1c1c1c;
  font: 1rem/1.55 system-ui, "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .6rem 0 .4rem; }
h2 { font-size: 1.25rem; margin: 2.6rem 0 .6rem; padding-top: .5rem; border-top: 1px solid #ddd; }
h3 { font-size: 1.05rem; margin: 1.6rem 0 .4rem; }
p, ul, .answer { max-width: 46rem; }
nav ul { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; list-style: none; padding: 0; margin: .4rem 0; }
a { color: #005b8f; }
.answer { font-size: 1.08rem; border-left: .25rem solid #0072b2; padding: .1rem 0 .1rem 1rem; }
.answer p { margin: .5rem 0; }
.warning { border-left: .25rem solid #d55e00; padding: .2rem 0 .2rem 1rem; }
figure { margin: 1.2rem 0 2rem; }
figure svg { display: block; width: 100%; height: auto; }
figure.single svg { max-width: 38rem; }
figure.double .scroll > svg { min-width: 40rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); gap: 0 2rem; align-items: start; }
.figures > .double, .figures > .elsewhere { grid-column: 1 / -1; }
.figures > * { min-width: 0; }
figcaption { font-size: .9rem; color: #444; max-width: 46rem; margin-top: .5rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .875rem; margin: .8rem 0; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: .3rem 0; }
th, td { padding: .28rem .7rem .28rem 0; text-align: right; border-bottom: 1px solid #e4e4e4; vertical-align: top; }
thead th { border-bottom: 1px solid #888; font-weight: 600; }
th:first-child, .words td, .words th { text-align: left; }
tbody th { font-weight: 500; white-space: nowrap; }
.words tbody th { white-space: normal; min-width: 10rem; }
.words td { min-width: 5rem; }
#claims td:nth-child(3) { min-width: 13rem; }
.status-complete { color: #00664a; }
.status-unfinished, .status-unusable, .status-missing { color: #b04a00; font-weight: 600; }
code { font-size: .92em; overflow-wrap: anywhere; }
)css";

}  // namespace

std::string html_page(const std::string& title, const std::string& body,
                      std::string_view more_style) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
         escape(title) + "</title>\n<style>" + style + std::string(more_style) +
         "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

}  // namespace surge::compare
