"""A LIGGGHTS user who never saw the project finds these answers by the documentation's search: within the first three results a page whose first screen has
the answer. The search is the site's own, run by node."""
import html
import json
import re
import shutil
from pathlib import Path

from programs import run
from pytest import skip

if not shutil.which("node"):
    skip("the book's search needs Debian's nodejs", allow_module_level=True)

# Question; what users type; the page with the answer; words of the answer.
QUESTIONS = (
    ("How do I convert my deck?", ("how do I convert my deck", "convert hertz deck", "from hertz"), "guide/convert-hertz", "mpm convert in.hopper"),
    ("Which yield stress?", ("which yield stress", "yield stress", "measure yield stress"), "guide/yield-stress", "Y is the uniaxial yield stress"),
    ("My run stops with \"beyond the law's table\".", ("beyond the law's table", "my run stops with beyond the law's table", "stops beyond table"),
     "guide/when-it-stops", "Make a deeper law"),
    ("How long will the table take?", ("how long will the table take", "how long table", "table long"), "guide/when-it-stops", "below a second from the atlas"),
    ("May I lower Young's modulus?", ("may I lower Young's modulus", "lower modulus", "soften"), "guide/plan", "A softer sphere yields later"),
    ("Which pairs are exact?", ("which pairs are exact", "exact pairs", "pairs"), "guide/pairs", "particles of one material and equal size; any particle on the rigid wall"),
    ("How do I cite?", ("how do I cite", "cite", "citation", "bibtex"), "guide/cite", "CITATION.cff"),
    ("Which licence?", ("licence", "license", "GPL"), "guide/cite", "GPL-2.0-or-later"),
    ("Where do I report a bug?", ("report a bug", "bug", "where do I report a bug"), "guide/cite", "Send, as files"),
    ("Does it run on a GPU?", ("GPU", "does it run on a GPU", "CUDA"), "guide/clusters", "No part runs on a GPU"),
    ("How do I run it on a cluster?", ("Slurm", "cluster", "how do I run on a cluster"), "guide/clusters", "#SBATCH --ntasks"),
    ("Other systems than Debian?", ("Ubuntu", "container", "docker", "Windows", "other systems"), "guide/install", "podman build"),
    ("How do I read the law in Matlab?", ("Matlab", "read law Matlab"), "reference/law-format", "readtable"),
    ("Coarse graining?", ("coarse graining", "coarse grain"), "guide/limits", "one large particle stands for many small ones"),
    ("Moisture and temperature?", ("moisture", "damp powder", "temperature dependence"), "guide/limits", "A law holds for the material in the state"),
    ("Viscoelasticity?", ("viscoelasticity", "viscoelastic", "creep"), "guide/limits", "no relaxation"),
    ("Cohesion?", ("cohesion", "my particles are cohesive", "cohesive powder", "surface energy", "sticking"), "guide/my-powder-sticks",
     "One more number is needed: the surface energy"),
    ("Adhesion?", ("adhesion", "JKR"), "guide/limits", "cohesion dent adds adhesion"),
    ("How do I do a die compaction?", ("how do I do a die compaction", "die compaction", "press tablets", "tabletting"), "guide/pressing", "Say confinement on in the pair style"),
    ("Which stretch?", ("which stretch", "stretch", "larger time step"), "guide/plan", "mpm stretch prints the largest"),
    ("Yield stress for lactose?", ("yield stress for lactose", "lactose", "microcrystalline cellulose", "mannitol"), "guide/yield-stress", "have no traceable value"),
    ("Rocky Linux?", ("Rocky Linux", "Fedora"), "guide/install", "need a container"),
    ("A cluster of Rocky Linux?", ("Rocky Linux cluster", "Apptainer"), "guide/clusters", "by Apptainer"),
    ("LAMMPS, YADE, EDEM, Rocky DEM?", ("LAMMPS", "YADE", "EDEM", "Rocky DEM", "other codes", "MercuryDPM"), "guide/other-codes", "pair_style granulaw"),
    ("Python?", ("python", "python module", "numpy"), "guide/python", "import granulaw"),
    ("What does damage number mean?", ("what does damage number mean", "damage number"), "theory/damage-number", "nothing to do with breakage"),
    ("How do I know that my result is right?", ("how do I know that my result is right", "is my result right", "check my simulation", "result wrong"), "guide/check-your-simulation", "wrong in eight ways"),
    ("ParaView: contacts coloured by dissipation?", ("paraview", "contacts coloured by dissipation", "VTK"), "guide/paraview", "dissipatedEnergy"),
    ("Does my material yield at my speeds?", ("does my material yield at my speeds", "does it yield", "speed of first yield"), "guide/plan", "If V is below V_on, Hertz suffices"),
    ("What do I do with friction?", ("what do I do with friction", "friction", "rolling friction"), "guide/tangential", "Keep them if they were measured"),
    ("Size distribution?", ("size distribution", "polydisperse"), "guide/pairs", "--radius-ratio R"),
    ("It stopped: why?", ("it stopped", "why did my simulation stop", "error message", "warning"), "guide/when-it-stops", "meaning and remedy of each message"),
    ("Is it for my process?", ("is it for my process", "mill", "blender", "vibrated bed"), "index", "what the law changes"),
    ("Breakage?", ("breakage", "fracture", "attrition"), "guide/limits", "breakage, attrition, wear"),
    ("A fluid?", ("CFDEM", "fluid coupling"), "guide/coupling", "fix couple/cfd"),
    ("My own contact law?", ("add a contact model", "new contact law", "write my own law"), "guide/new-contact-model", "A normal model is two files and one line"),
    ("Calls of the C library?", ("granulaw_advance", "granulaw.h", "API"), "reference/api", "Declarations with their units"),
    ("How accurate?", ("accuracy", "how accurate is a law"), "guide/limits", "within 0.72 % of F_max"),
    ("Can I use clumps?", ("can I use clumps", "clumps", "clump multisphere"), "examples/clumps/README", "They do"),
    ("What does f_granulaw[13] mean?", ("what does f_granulaw[13] mean", "f_granulaw[13]", "f_granulaw"), "reference/fix_granulaw_stats",
     "time step that the stiffest contact so far allowed"),
    ("How do I read the law in Python?", ("how do I read the law in Python", "read law python"), "reference/law-format", "pandas.read_csv"),
)
FIRST = 3
# Characters from the top of the page, or from the section that the result leads to: with the answer among them, Chromium shows it in a
# window of 1280 x 913 on each of the ten pages.
SCREEN = 1400

def opening(page, anchor):
    """The text that the reader sees first."""
    text = page.read_text()
    start = text.index(f'id="{anchor}"') if anchor else text.index('<div class="body" role="main">')
    plain = html.unescape(re.sub(r"<[^>]*>", "", text[text.index(">", start) + 1:]))
    return re.sub(r"\s+", " ", plain)[:SCREEN]

def test_found_within_three_results_and_on_the_first_screen(site):
    queries = [query for _, typed, _, _ in QUESTIONS for query in typed]
    lines = run("node", Path(__file__).with_name("search.js"), site, input="\n".join(queries)).stdout.splitlines()
    results, wrong = dict(zip(queries, map(json.loads, lines), strict=True)), []
    for _, typed, page, answer in QUESTIONS:
        for query in typed:
            first = results[query][:FIRST]
            anchors = [anchor for name, anchor, _ in first if name == page]
            if not anchors:
                wrong.append(f"{query}: {page} is not among {[name for name, _, _ in first]}")
            elif not any(answer in opening(site / f"{page}.html", anchor) for anchor in anchors):
                wrong.append(f"{query}: '{answer}' is not on the first screen of {page}")
    assert not wrong, "\n".join(wrong)
