// Order of the search's results. A page with the word in a title stands before all that have it in the text. Of equals, what a user does stands
// before what is looked up, and that before evidence and history.
var Scorer = {
  score: (result) => {
    const [docname, title, anchor, descr, score, filename] = result;
    const parts = [["guide/", 4], ["reference/", 3], ["theory/", 2], ["examples/", 1], ["develop/", -12]];
    const found = parts.find(([start]) => docname.startsWith(start));
    return score + (found ? found[1] : 0);
  },
  // The rest: Sphinx's own numbers.
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
