// The site's own search (searchtools.js, searchindex.js) without a browser: node search.js SITE < queries, one a line.
// Prints for each query its results, best first: [page, anchor, title].
"use strict";
const fs = require("fs"), vm = require("vm");
const read = (name) => fs.readFileSync(`${process.argv[2]}/${name}`, "utf8");

// Search.query ends with showing its results, worst first; they are kept instead.
const show = "_displayNextItem(results, results.length, searchTerms, highlightTerms);";
const tools = read("_static/searchtools.js");
if (!tools.includes(show)) throw new Error("searchtools.js does not show its results as Sphinx 5.3 does");
const page = vm.createContext({ document: { getElementById: () => null }, SPHINX_HIGHLIGHT_ENABLED: false, _ready: () => {} });
vm.runInContext(read("_static/language_data.js") + tools.replace(show, "Search.found = results.reverse();"), page);
vm.runInContext(read("searchindex.js"), page);
for (const query of fs.readFileSync(0, "utf8").trim().split("\n")) {
  page.query = query;
  const found = vm.runInContext("Search.query(query), Search.found", page);
  console.log(JSON.stringify(found.map(([name, title, anchor]) => [name, anchor.slice(1), title])));
}
