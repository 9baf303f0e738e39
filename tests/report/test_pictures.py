"""The pictures of tools/report and mpm plot: every panel has a name, no text leaves the picture, no two ticks run into each other."""
import io
import json
import sys
from unittest import mock

import run_files
from programs import ROOT, module
from pytest import fixture
from reporting import contacts_part, flow_part, page


class TestPictures:
    @fixture(autouse=True)
    def _folder(self, folder):
        self.folder = folder
        yield
        page.plt.close("all")

    def check(self, figure, named=True, cropped=False):
        """`named`: panels have titles; `cropped`: the picture is cut to what it holds."""
        figure.canvas.draw()
        renderer, whole = figure.canvas.get_renderer(), figure.bbox
        texts = [*figure.texts, *(t for legend in figure.legends for t in legend.get_texts())]
        for axes in figure.get_axes():
            bar = hasattr(axes, "_colorbar")
            if named and not bar and axes.axison:
                assert any(axes.get_title(loc=side) for side in ("left", "center")), "a panel without a name"
            texts += [axes.title, axes._left_title, axes.xaxis.label, axes.yaxis.label]
            for axis, place in ((axes.xaxis, 0), (axes.yaxis, 1)):
                low, high = sorted(axis.get_view_interval())
                shown = [tick.label1 for tick in axis.get_major_ticks() + axis.get_minor_ticks()
                         if tick.label1.get_visible() and tick.label1.get_text() and low <= tick.get_loc() <= high]
                boxes = sorted((t.get_window_extent(renderer).intervalx if place == 0 else t.get_window_extent(renderer).intervaly).tolist() for t in shown)
                for (_, end), (begin, _) in zip(boxes, boxes[1:]):
                    assert end < begin + 0.5, [t.get_text() for t in shown]
        for text in texts if not cropped else []:
            box = text.get_window_extent(renderer)
            if text.get_text().strip():
                assert whole.x0 - 1 <= box.x0 and box.x1 <= whole.x1 + 1 and whole.y0 - 1 <= box.y0 and box.y1 <= whole.y1 + 1, f"leaves the picture: {text.get_text()}"

    def tidied(self, figure, named=True):
        page.tidy(figure)
        self.check(figure, named)

    def test_report(self):
        run_files.everything(self.folder)
        decks, broken = flow_part.read_all(self.folder)
        assert broken == []
        self.tidied(flow_part.picture(decks[0], [name for name in flow_part.observables(decks[0])]))
        found, _ = contacts_part.read(decks)
        self.tidied(contacts_part.picture(next(iter(found.values()))), named=False)  # a map between two rows of bars, named above

    def test_long_names(self):
        figure, axes = page.plt.subplots(1, 4, figsize=(12.8, 3.2))
        for k, axis in enumerate(axes):
            axis.plot([9.05e7, 9.2e7], [k, k + 1])
            axis.set(title="peak kinetic energy while filling, J, of all particles of both materials", xlabel="youngs_modulus")
        axes[0].set(xscale="log", xlim=(2e1, 9e1))
        self.tidied(figure)

    def test_a_run(self):
        content = run_files.stats([(0.01, 60), (1.0, 40)], [(1e-3, 60), (0.05, 40)])
        content["series"] = {"time_s": [0, 1e-4, 2e-4], "kinetic_J": [0, 1e-6, 3e-6], "normal_dissipation_J": [0, 0, 1e-7],
                             "fastest_particle_m_per_s": [1, 2, 1.5]}
        (self.folder / "stats.json").write_text(json.dumps(content))
        self.tidied(contacts_part.picture_of_run(contacts_part.Run(self.folder / "stats.json", "stats.json")))

    def drawn(self, name, *words, told=""):
        """The figure that a script of mpm plot saves."""
        figures = []
        drawing = module(ROOT / f"tools/mpm/{name}.py")
        with mock.patch.object(drawing.plt.Figure, "savefig", lambda figure, *a, **k: figures.append(figure)), \
                mock.patch.object(sys, "stdin", io.StringIO(told)):
            drawing.main(*map(str, words))
        return figures[0]

    def test_law_and_pair(self):
        line = {"name": "law of the body", "role": "law", "x": [0, 1.2e-5], "y": [0, 2], "unloading": []}
        told = {"force": [line], "restitution": [line], "overlap_unit": 1e-6, "labels": ["overlap, µm", "force, N", "approach speed, m/s"],
                "title": "a_powder_with_a_rather_long_name (R = 3 mm) against another (a wall); ratio of radii 0.333, by the pair rule, whose error is not stated"}
        self.check(self.drawn("plot_law", "x.png", told=json.dumps(told)))
        bodies = [line | {"role": "body", "name": f"a_powder_with_a_rather_long_name, E*/Y = {k}"} for k in (100, 200)]
        self.check(self.drawn("plot_law", "x.png", told=json.dumps(told | {"force": bodies, "restitution": bodies, "title": ""})))

    def test_shape(self):
        directions = [{"direction": [1, 0, 0], "law_e": 0.5, "e": 0.51, "law_force_max_N": 1.0, "force_max_N": 1.1},
                      {"direction": [0, 0.6, 0.8], "law_e": None, "e": 0.4, "force_max_N": 1.1}]
        told = {"directions": directions, "mirrors": [True] * 3, "name": "a_particle_with_a_rather_long_name",
                "orientations": "30 orientations at 1, 2, 5 and 13 m/s, each with 8 cells across the contact"}
        self.check(self.drawn("plot_shape", "x.png", told=json.dumps(told)), cropped=True)
