"""Public decks under their own model, and converted with real moduli without and with stretch: CPU time to the same simulated time, particles,
kinetic energy. The decks are tutorials of Debian's liggghts-doc and folders of world/. Prints a Markdown table, and writes it with --page FILE.
    compare_decks.py [--steps N] [--page FILE] [DECK...]      (the target compare_decks runs it)"""
import argparse
import json
import os
import pathlib
import resource
import shutil
import subprocess
import tempfile

LAUNCHER, MPM = os.environ["GRANULAW_LAUNCHER"], os.environ["GRANULAW_MPM"]
TUTORIALS = pathlib.Path("/usr/share/doc/liggghts/examples/LIGGGHTS/Tutorials_public")
DECKS = ["chute_wear/in.chute_wear", "cohesion/in.cohesion", "cohesion/in.noCohesion", "contactModels/in.newModels", "conveyor/in.conveyor",
         "heatTransfer_1/in.heatGran", "hysteresis/in.hysteresis", "insert_stream/in.insert_stream", "meshGran/in.meshGran", "packing/in.packing"]
MATERIAL = "[material.bead]\ndensity = 2500\nyoungs_modulus = 5e9\npoisson_ratio = 0.3\nyield_stress = 25e6\n"


def user_time():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def run(folder, deck, steps):
    """State after the steps, with the user CPU time, s."""
    before = user_time()
    subprocess.run([LAUNCHER, "-steps", str(steps), "state.json", "-in", deck, "-log", "none"], cwd=folder, check=True, capture_output=True, timeout=3600)
    return {**json.loads((folder / "state.json").read_text()), "cpu": user_time() - before}


def convert(folder, deck, out, *words):
    done = subprocess.run([MPM, "convert", deck, "--materials-file", "material.toml", "--accept-defaults", "-o", out, "--json", *words], cwd=folder, check=True,
                          capture_output=True, text=True, timeout=600)
    return json.loads(done.stdout)


def compare(path, steps):
    """One row: the deck, and of each of the three its state."""
    with tempfile.TemporaryDirectory(prefix="granulaw-compare-") as top:
        folder = pathlib.Path(top) / "deck"
        shutil.copytree(TUTORIALS / path.parent, folder)
        folder.chmod(0o755)
        (folder / "post").mkdir(exist_ok=True)
        (folder / "material.toml").write_text(MATERIAL)
        rows = {}
        for name, words in (("real", ["--no-stretch"]), ("stretched", [])):
            said = convert(folder, path.name, name, *words)
            rows[name] = {**run(folder / name, path.name, round(steps * said["steps_factor"])), "stretch": said["stretch"], "factor": said["steps_factor"]}
        rows["own"] = run(folder, path.name, steps)
        return rows


def line(path, rows):
    own, real, stretched = rows["own"], rows["real"], rows["stretched"]
    states = ", ".join(f"{rows[k]['kinetic_energy']:.4g}" for k in ("own", "real", "stretched"))
    same = own["particles"] == real["particles"] == stretched["particles"]
    return (f"| {path.name} | {own['time']:.4g} | {own['cpu']:.2f} | {real['factor']:g} | {real['cpu'] / own['cpu']:.2f} | {stretched['stretch']:g}, {stretched['factor']:g} | "
            f"{stretched['cpu'] / own['cpu']:.2f} | {states} | {own['particles']:.0f}{'' if same else ' (they differ)'} |")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("decks", nargs="*", default=DECKS)
    arguments.add_argument("--steps", type=int, default=20000, help="time steps of the original")
    arguments.add_argument("--page", type=pathlib.Path)
    given = arguments.parse_args()
    text = [f"load at the start: {os.getloadavg()[0]:.1f}; {given.steps} time steps of the original", "",
            "| deck | time, s | CPU, s | steps, real | CPU, real | stretch, steps | CPU, stretched | kinetic energy, J: original, real, stretched | particles |",
            "|---|---|---|---|---|---|---|---|---|"]
    print("\n".join(text))
    for deck in map(pathlib.Path, given.decks):
        text.append(line(deck, compare(deck, given.steps)))
        print(text[-1], flush=True)
    if given.page:
        given.page.write_text("\n".join(text) + "\n")


if __name__ == "__main__":
    main()
