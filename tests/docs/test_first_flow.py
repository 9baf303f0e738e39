"""The first page of the guide works as it stands: its materials file, its command, its deck."""
import json
import os
import re
import shutil

import programs
import steps
from programs import LAUNCHER, MPM, ROOT
from pytest import approx

PAGE = (ROOT / "docs/guide/first-flow.md").read_text()


def block(beginning):
    """The fenced block that begins with this line."""
    return next(b for b in re.findall(r"```\w*\n(.*?)```", PAGE, re.DOTALL) if b.startswith(beginning))


class TestFirstFlow:
    def test_as_written(self, folder):
        def run(*command):
            return programs.run(*command, cwd=folder).stdout

        (folder / "materials.toml").write_text(block("[material.wax]"))
        (folder / "in.first").write_text(block("atom_style"))
        made = run(MPM, "table", "materials.toml", "-o", "wax.h5")
        assert made == block("wrote wax.h5")
        law = run(MPM, "law", "wax.h5", "--pair", "wax:wall", "--radius", "3e-3", "--velocity", "1.0")
        # the page's number; the atlas may change its last digit
        assert float(re.search(r"restitution e +([\d.]+)", law)[1]) == approx(float(re.search(r"restitution e +([\d.]+)", PAGE)[1]), abs=0.002)
        log = run(LAUNCHER, "-in", "in.first")
        shown = [b for b in re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL) if not b.startswith("atom_style")]
        for line in "".join(shown).splitlines():  # what the page shows is what they say
            assert line in (made + law + log).splitlines()
        assert "WARNING: granulaw" not in log
        assert re.search(r"(?m)^ +100000 +150 ", log)  # all particles are there at the end
        # the page's picture: all particles are in its frame, and the script draws it
        frame = [line.split() for line in (folder / "frame_30000.txt").read_text().splitlines()[9:]]
        assert len(frame) == 150
        assert all(0 < float(row[3]) < 0.075 for row in frame)
        (folder / "frame.py").write_text(block("import matplotlib"))
        run("/usr/bin/python3", "frame.py")
        assert (folder / "frame.png").read_bytes()[:4] == b"\x89PNG"
        if os.environ.get("GRANULAW_KEEP_FRAME"):
            shutil.copy(folder / "frame.png", os.environ["GRANULAW_KEEP_FRAME"])
        # a deck that is no example: its contacts, energies and speeds
        told = run(ROOT / "tools/report", "--from", ".", "-o", "page")
        assert "contacts: stats.json" in told
        page = (folder / "page/report.md").read_text()
        assert re.search(r"\| stats.json \| wax-wax, particles \| \d+ \|", page)
        for name in ("contacts-1.png", "run-1.png"):
            assert f"]({name})" in page
            assert (folder / "page" / name).exists()
        assert "no energies over time" not in page
        stats = json.loads((folder / "stats.json").read_text())
        steps.check(MPM, [folder / "in.first"], stats, log)


class TestParaview:
    def test_lines_of_the_page(self, folder):
        """The page's lines in the deck of the first flow, and its script: a dent for each contact, with what its particles lost in it."""
        lines, script = re.findall(r"```\w+\n(.*?)```", (ROOT / "docs/guide/paraview.md").read_text(), re.DOTALL)
        (folder / "materials.toml").write_text(block("[material.wax]"))
        programs.run(MPM, "table", "materials.toml", "-o", "wax.h5", cwd=folder)
        deck = block("atom_style").replace("stats stats.json", "energy on").replace("f_granulaw\n", "ke\n")
        (folder / "in.view").write_text(deck[:deck.rindex("run ")].replace("5000 frame", "100000 frame") + lines + "run 35000\n")
        programs.run(LAUNCHER, "-in", "in.view", cwd=folder)
        programs.run("/usr/bin/python3", "-c", script, cwd=folder)
        contacts = (folder / "contacts_35000.txt").read_text().splitlines()[9:]
        view = (folder / "dents_35000.vtk").read_text()
        assert len(contacts) > 10 and f"CELL_DATA {len(contacts)}\n" in view
        lost = [float(x) for x in view.split("dissipated_J double\nLOOKUP_TABLE default\n")[1].split()]
        assert lost == [float(row.split()[-1]) for row in contacts] and max(lost) > 0
        assert (folder / "dents_0.vtk").exists()  # no contact yet
        assert b"f_granulaw[2]" in (folder / "particles_35000.vtk").read_bytes()
        assert b"force" in (folder / "forces_35000.vtk").read_bytes()


class TestReadme:
    def test_commands(self, folder):
        """The commands of the README, in turn: the collision of the solver and of the law agree within the law's error bound."""
        lines = re.findall(r"(?m)^    (mpm .*?)(?:  #.*)?$", (ROOT / "README.md").read_text())
        assert [line.split()[1] for line in lines] == ["impact", "table", "law", "convert"]
        (folder / "examples").symlink_to(ROOT / "examples")
        said = [programs.mpm(*line.split()[1:], cwd=folder).stdout for line in lines[:3]]  # the last is of the reader's deck
        bound = float(re.search(r"error bound .* e ([\d.]+)", said[2])[1])
        e = [float(re.search(r"restitution e +([\d.]+)", text)[1]) for text in (said[0], said[2])]
        assert abs(e[0] - e[1]) < bound
