"""A page of Markdown with PNG files beside it. A line break in a cell begins a second line."""
import io
import math
import pathlib
import re
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
    "legend.fontsize": 8, "lines.markersize": 4.5, "lines.linewidth": 1.2, "figure.constrained_layout.use": True})


def _number(cell):
    """Cells that are aligned to the right: numbers, and n/a and the like."""
    return bool(re.match(r"^[-+−±<≤>≥]?\s*[\d.]", cell)) or len(cell) < 5


class Page:
    """Blocks in order; `write` makes report.md and the pictures."""

    def __init__(self, title, lead):
        self._blocks, self._figures = [f"# {title}", lead], {}

    def section(self, title):
        self.text(f"## {title}")

    def heading(self, title):
        self.text(f"### {title}")

    def text(self, text):
        self._blocks.append(text)

    def table(self, head, rows, title=None):
        rows = [[str(c) for c in row] for row in rows]
        words = [bool(rows) and sum(not _number(r[k]) for r in rows) > len(rows) / 2 for k in range(1, len(head))]
        line = lambda cells: "| " + " | ".join(c.replace("|", "\\|").replace("\n", "<br>") for c in cells) + " |"
        marks = "|---|" + "".join("---|" if w else "---:|" for w in words)
        self.text((f"{title}:\n\n" if title else "") + "\n".join([line(head), marks, *map(line, rows)]))

    def figure(self, figure, name, caption):
        """A matplotlib figure, `name`.png."""
        tidy(figure)
        picture = io.BytesIO()
        figure.savefig(picture, format="png", dpi=130)
        plt.close(figure)
        self._figures[f"{name}.png"] = picture.getvalue()
        self.text(f"![{name}]({name}.png)\n\n*{caption}*")

    def write(self, folder):
        folder = pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in self._figures.items():
            (folder / name).write_bytes(content)
        (folder / "report.md").write_text("\n\n".join(self._blocks) + "\n")
        return folder / "report.md"


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
