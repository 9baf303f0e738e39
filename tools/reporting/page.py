"""A page that is written twice: as one HTML file that loads nothing, and as Markdown with PNG files beside it.

Texts are plain; `code` between back-quotes and **bold** are the only marks, a line break in a cell begins a second line."""
import html
import io
import math
import os
import pathlib
import re
import tempfile
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib import ticker  # noqa: E402
from spread import decimals  # noqa: E402

plt.rcParams.update({
    "font.size": 9, "axes.titlesize": 9.5, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.spines.top": False,
    "axes.spines.right": False, "axes.edgecolor": "0.4", "axes.labelcolor": "0.2", "xtick.color": "0.3", "ytick.color": "0.3",
    "axes.grid": True, "grid.color": "0.9", "grid.linewidth": 0.6, "axes.axisbelow": True, "legend.frameon": False,
    "legend.fontsize": 8, "lines.markersize": 4.5, "lines.linewidth": 1.2, "figure.constrained_layout.use": True,
    "svg.fonttype": "path"})

STYLE = """
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; color: #222; background: #fff; margin: 0 auto;
       max-width: 1120px; padding: 1.5rem 1.2rem 4rem; }
h1 { font-size: 1.7rem; margin: 0 0 .2rem; } h2 { font-size: 1.3rem; margin: 2.6rem 0 .6rem; border-top: 2px solid #333; padding-top: .7rem; }
h3 { font-size: 1.05rem; margin: 1.7rem 0 .4rem; }
p { margin: .5rem 0; max-width: 52rem; } .origin, figcaption { color: #555; font-size: .87rem; }
nav { margin: .8rem 0; font-size: .93rem; } nav a { margin-right: 1.1rem; white-space: nowrap; }
a { color: #14588f; }
code { font: .86em ui-monospace, "DejaVu Sans Mono", monospace; background: #f2f2f0; padding: 0 .25em; border-radius: 3px; overflow-wrap: anywhere; }
pre { background: #f2f2f0; padding: .6rem .8rem; overflow-x: auto; border-radius: 4px; font-size: .85rem; line-height: 1.45; }
pre code { background: none; padding: 0; overflow-wrap: normal; }
figure { margin: 1rem 0; } figure svg { width: 100%; height: auto; display: block; } figcaption { max-width: 52rem; margin-top: .2rem; }
.scroll { overflow-x: auto; margin: .6rem 0; }
table { border-collapse: collapse; font-size: .86rem; font-variant-numeric: tabular-nums; }
th, td { padding: .22rem .6rem; text-align: right; border-bottom: 1px solid #e4e4e0; vertical-align: top; }
th { border-bottom: 1.5px solid #555; font-weight: 600; vertical-align: bottom; }
td { white-space: nowrap; } td:first-child, th:first-child, td.text, th.text { text-align: left; }
td.long { white-space: normal; min-width: 13rem; max-width: 24rem; }
td .second { color: #555; }
tr:hover td { background: #f7f7f4; }
.missing { border-left: 4px solid #c77700; background: #fff7ea; padding: .5rem .9rem; margin: .7rem 0; max-width: 52rem; }
.missing.broken { border-color: #b3261e; background: #fdeeed; }
.missing pre { background: #fff; margin: .4rem 0 .2rem; }
details { margin: .6rem 0; } summary { cursor: pointer; color: #14588f; font-size: .93rem; }
@media print { details > * { display: block; } nav { display: none; } body { max-width: none; } }
"""


def _inline(text):
    text = html.escape(str(text), quote=False)
    first, *rest = text.split("\n")
    text = first + "".join(f'<br><span class="second">{line}</span>' for line in rest)
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
    return re.sub(r"\*\*([^*]+)\*\*", r"<strong>\1</strong>", text)


def _number(cell):
    """Cells that are aligned to the right: numbers, and n/a and the like."""
    return bool(re.match(r"^[-+−±<≤>≥]?\s*[\d.]", cell)) or len(cell) < 5


class Page:
    """Blocks in order; `write` makes both files."""

    def __init__(self, title, lead):
        self.title, self.lead = title, lead
        self._html, self._markdown, self._figures, self._sections, self._glance = [], [], {}, [], []

    def glance(self, rows):
        """Rows of the table at the top: what, its speed, its error."""
        self._glance += rows

    def _add(self, as_html, as_markdown):
        self._html.append(as_html)
        self._markdown.append(as_markdown)

    def section(self, title, name):
        self._sections.append((title, name))
        self._add(f'<h2 id="{name}">{_inline(title)}</h2>', f"## {title}")

    def heading(self, title):
        self._add(f"<h3>{_inline(title)}</h3>", f"### {title}")

    def text(self, text):
        self._add(f"<p>{_inline(text)}</p>", text)

    def origin(self, text):
        """Origin of the numbers: small print."""
        self._add(f'<p class="origin">{_inline(text)}</p>', text)

    def commands(self, lines):
        text = "\n".join(lines)
        self._add(f"<pre><code>{html.escape(text)}</code></pre>", "```sh\n" + text + "\n```")

    def missing(self, what, commands, broken=False):
        """Nothing to show: says why, and which commands make it."""
        text = html.escape("\n".join(commands))
        kind = "missing broken" if broken else "missing"
        self._add(f'<div class="{kind}">{_inline(what)}<pre><code>{text}</code></pre></div>',
                  f"> **Missing.** {what}\n\n```sh\n" + "\n".join(commands) + "\n```")

    def table(self, head, rows, fold=None):
        """`fold`: a line under which the table is hidden until it is asked for."""
        self._add(*self._table(head, rows, fold))

    def _table(self, head, rows, fold=None, words=False):
        """`words`: no column of numbers."""
        rows = [[str(c) for c in row] for row in rows]
        text = [words or k > 0 and bool(rows) and sum(not _number(r[k]) for r in rows) > len(rows) / 2 for k in range(len(head))]
        long = [any(len(line) > 45 for r in rows for line in r[k].split("\n")) for k in range(len(head))]
        mark = lambda k: f' class="{"text" if text[k] else ""}{" long" if long[k] else ""}"' if text[k] or long[k] else ""
        out = ['<div class="scroll"><table><thead><tr>', *[f"<th{mark(k)}>{_inline(h)}</th>" for k, h in enumerate(head)],
               "</tr></thead><tbody>"]
        for row in rows:
            out.append("<tr>" + "".join(f"<td{mark(k)}>{_inline(c)}</td>" for k, c in enumerate(row)) + "</tr>")
        body = "".join(out) + "</tbody></table></div>"
        if fold:
            body = f"<details><summary>{_inline(fold)}</summary>{body}</details>"
        cell = lambda c: c.replace("|", "\\|").replace("\n", "<br>")
        plain = ["| " + " | ".join(map(cell, head)) + " |", "|---|" + "".join("---|" if t else "---:|" for t in text[1:])]
        plain += ["| " + " | ".join(map(cell, row)) + " |" for row in rows]
        return body, (f"{fold}:\n\n" if fold else "") + "\n".join(plain)

    def _glance_table(self):
        return self._table(["at a glance", "speed", "error"], self._glance, words=True) if self._glance else ("", "")

    def figure(self, figure, name, caption):
        """A matplotlib figure, `name`.png beside the Markdown, SVG in the HTML."""
        plt.rcParams["svg.hashsalt"] = name  # ids differ from figure to figure, and not from call to call
        tidy(figure)
        drawing, picture = io.StringIO(), io.BytesIO()
        figure.savefig(drawing, format="svg", metadata={"Date": None, "Creator": None})
        figure.savefig(picture, format="png", dpi=130)
        plt.close(figure)
        svg = drawing.getvalue()
        svg = svg[svg.index("<svg"):]
        svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
        # one page, many figures: an id (a letter shape, a clip) must not be another figure's
        svg = re.sub(r'\bid="([^"]+)"', rf'id="{name}-\1"', svg)
        svg = re.sub(r'(href="#|url\(#)', rf"\1{name}-", svg)
        svg = svg.replace("<svg ", f'<svg role="img" aria-label="{html.escape(caption)}" ', 1)
        self._figures[f"{name}.png"] = picture.getvalue()
        self._add(f"<figure>{svg}<figcaption>{_inline(caption)}</figcaption></figure>", f"![{name}]({name}.png)\n\n*{caption}*")

    def to_html(self):
        links = " ".join(f'<a href="#{name}">{_inline(title)}</a>' for title, name in self._sections)
        return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
                f"<title>{_inline(self.title)}</title><style>{STYLE}</style></head><body>\n<h1>{_inline(self.title)}</h1>"
                f"<p>{_inline(self.lead)}</p><nav>{links}</nav>\n{self._glance_table()[0]}\n" + "\n".join(self._html) + "\n</body></html>\n")

    def to_markdown(self):
        return f"# {self.title}\n\n{self.lead}\n\n{self._glance_table()[1]}\n\n" + "\n\n".join(self._markdown) + "\n"

    def write(self, folder):
        """report.html, report.md and the pictures, each under a temporary name first: a reader sees the old file or the new."""
        folder = pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        files = {**self._figures, "report.md": self.to_markdown().encode(), "report.html": self.to_html().encode()}
        for name, content in files.items():
            handle, temporary = tempfile.mkstemp(prefix=f".{name}.", dir=folder)
            try:
                with os.fdopen(handle, "wb") as file:
                    file.write(content)
                os.chmod(temporary, 0o644)
                os.replace(temporary, folder / name)
            except BaseException:
                os.unlink(temporary)
                raise
        return folder / "report.html"


def tidy(figure):
    """Titles within their panels; ticks that do not run into each other, plain numbers where a logarithmic axis shows less than two decades."""
    for axes in figure.get_axes():
        width = axes.get_position().width * figure.get_size_inches()[0] if axes.figure is figure else figure.get_size_inches()[0] / 2
        title = axes.get_title(loc="left")
        axes.set_title("\n".join(textwrap.wrap(title, max(16, int(12 * width)))))  # a bold letter is about 1/12 inch wide
        for axis, scale, (low, high), length in ((axes.xaxis, axes.get_xscale(), axes.get_xlim(), width),
                                                 (axes.yaxis, axes.get_yscale(), axes.get_ylim(), figure.get_size_inches()[1])):
            if scale == "linear" and isinstance(axis.get_major_locator(), ticker.AutoLocator):
                axis.set_major_locator(ticker.MaxNLocator(max(3, int(1.6 * length)), steps=(1, 2, 5, 10)))
            if scale == "log":
                axis.set_minor_formatter(ticker.NullFormatter())
                if 0 < low < high < 100 * low:
                    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
                    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))


def legend_below(figure, handles, labels, columns):
    """One legend for all panels, under them, in a strip of its own."""
    rows = -(-len(labels) // columns)
    strip = (0.19 * rows + 0.12) / figure.get_size_inches()[1]
    figure.get_layout_engine().set(rect=(0, strip, 1, 1 - strip))
    figure.legend(handles, labels, loc="lower center", ncols=columns)


def with_error(value, error, plus=False):
    """`value ± error` to the decimals of examples/common/spread.py; `plus`: the sign of a change.

    `error` None: no spread is known, and the value stands alone."""
    sign = "+" if plus and value > 0 else ""
    if error is None:
        return sign + number(value, 3 if plus else 4).replace("-", "−")
    if error < 1e-9 * abs(value):  # of equal numbers: rounding
        error = 0
    if error == 0:
        return sign + f"{value:.4g} ± 0".replace("-", "−")
    top = math.floor(math.log10(max(abs(value), error)))
    if not -4 <= top < 5:
        return f"({with_error(value / 10**top, error / 10**top, plus)})e{top}".replace("-", "−")
    digits = decimals(error)
    if round(value, digits) == 0:
        value, sign = 0.0, ""  # not -0
    return sign + f"{value:.{digits}f} ± {error:.{digits}f}".replace("-", "−")


def number(value, digits=3):
    """For a table: `digits` significant ones, no exponent where it can be avoided; n/a for None."""
    if value is None:
        return "n/a"
    if value == 0:
        return "0"
    if 1e-4 <= abs(value) < 1e6:
        decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
        return f"{value:.{decimals}f}"
    return f"{value:.{digits - 1}e}"
