"""Tangential, cohesion and rolling models beside ours."""
import itertools

from pytest import approx, mark
from collisions import pair_deck, wall_deck
from harness import POWDER, Deck, Material, head, properties, sphere_mass

RADIUS = 1.7e-3
MASS = sphere_mass(RADIUS, POWDER.density)
STEEL = Material("steel", 7800.0, 2.1e11, 0.3, 1e30)
# what cohesion and the epsd models require besides
MORE = ("fix p7 all property/global cohesionEnergyDensity peratomtypepair 1 1000\n"
        "fix p8 all property/global coefficientRollingViscousDamping peratomtypepair 1 0.1\n"
        "fix p9 all property/global rollingStiffness scalar 50\nfix p1")
BRIDGE = "".join(f"fix l{k} all property/global {line}\n" for k, line in enumerate((
    "surfaceLiquidContentInitial scalar 0.01", "surfaceTension scalar 0.07", "fluidViscosity scalar 0.001", "contactAngle peratomtype 0.1",
    "minSeparationDistanceRatio scalar 1.01", "maxSeparationDistanceRatio scalar 1.1", "maxLiquidContent scalar 0.01")))


class TestCombinations(Deck):
    def words(self, materials="powder"):
        return f"law {self.law} materials {materials} elasticDamping off"

    def law_words(self, model):
        return self.words() if model == "mpm" else "elasticDamping off"

    def oblique_pair(self, model, models):
        """Unlike spheres that meet with slip and spin. Prints for each v_x, v_z, omega_y, x, z."""
        text = head(half=20 * RADIUS) + properties([POWDER], 0.3).replace("fix p1", MORE)
        text += f"pair_style gran model {model} tangential {models} {self.law_words(model)}\npair_coeff * *\n"
        for k, (z, radius, vx, vz, spin) in enumerate(((1.00001, 1.0, 0.3, -0.5, 40.0), (-2.00001, 2.0, -0.2, 0.5, 25.0))):
            text += (f"create_atoms 1 single 0.0 0.0 {z * RADIUS!r} units box\ngroup a{k} id {k + 1}\n"
                     f"set group a{k} diameter {2 * radius * RADIUS!r} density {POWDER.density}\n"
                     f"velocity a{k} set {vx} 0 {vz}\nset group a{k} omegay {spin}\n"
                     f"compute o{k} a{k} property/atom omegay\ncompute s{k} a{k} reduce sum c_o{k}\n"
                     f"variable o{k} equal c_s{k}\n")
            for name, of in (("v", "vcm"), ("x", "xcm")):
                text += f"variable {name}x{k} equal {of}(a{k},x)\nvariable {name}z{k} equal {of}(a{k},z)\n"
        state = " ".join(f"${{vx{k}}} ${{vz{k}}} ${{o{k}}} ${{xx{k}}} ${{xz{k}}}" for k in (0, 1))
        return (text + "fix i all nve/sphere\ntimestep 4e-7\nthermo_style custom step c_s0 c_s1\n"
                f'run 0\nprint "BEFORE {state}"\nrun 150\nprint "AFTER {state}"\n')

    def momenta(self, state):
        """Linear (x, z) and angular (y, about the origin) momentum of the two, each over the sum of its parts' sizes."""
        masses = [MASS, 8 * MASS]
        terms = ([], [], [])
        for m, radius, (vx, vz, spin, x, z) in zip(masses, (RADIUS, 2 * RADIUS), (state[:5], state[5:])):
            terms[0].append(m * vx)
            terms[1].append(m * vz)
            terms[2].extend((0.4 * m * radius**2 * spin, m * z * vx, -m * x * vz))
        return [sum(t) for t in terms], [sum(map(abs, t)) for t in terms]

    @mark.parametrize("model", ("mpm", "thornton"))
    def test_every_combination(self, model):
        """All 45 without liquid, for walls and for pairs, of both models. Rolling and tangential models do not touch a head-on impact on a wall;
        the weak cohesion (its work is 1e-4 of the impact's) hardly. Between particles every one keeps the momenta, and
        each tangential and rolling model makes a difference of its own."""
        every = list(itertools.product(("off", "history", "no_history"), ("", "sjkr", "sjkr2"), ("", "cdt", "epsd", "epsd2", "epsd3")))
        names = [t + (f" cohesion {c}" if c else "") + (f" rolling_friction {r}" if r else "") for t, c, r in every]
        walls = self.run_each((wall_deck(model, self.law_words(model), POWDER, RADIUS, 1.0, 2e-7, tangential=models)
                               .replace("fix p1", MORE) for models in names), "SPEED")
        for (_, cohesion, _), models, (e,) in zip(every, names, walls):
            assert e == approx(walls[0][0], abs=(1e-3 if cohesion else 1e-12)), f"{model} {models}"
        decks = [self.oblique_pair(model, models) for models in names]
        text = self.run_deck("clear\n".join(decks))
        before, after = self.results(text, "BEFORE"), self.results(text, "AFTER")
        assert (len(before), len(after)) == (45, 45)
        seen = {}
        for (tangential, cohesion, rolling), models, a, b in zip(every, names, before, after):
            said = f"{model} {models}"
            assert b[1] - b[6] > 0.3, said  # they have parted
            (start, size), (end, _) = self.momenta(a), self.momenta(b)
            for p, q, s in zip(start, end, size):
                assert (q - p) / s == approx(0.0, abs=1e-12), said  # rounding of 150 steps
            if tangential == "off" and not rolling:
                assert (b[2], b[7]) == (a[2], a[7]), said
            if not cohesion:
                seen[tangential, rolling] = (b[2], b[7])
        assert len(set(seen.values())) == len(seen), f"{model}: {seen}"

    @mark.parametrize("command", ("pair_style", "fix w all"))
    @mark.parametrize("models, ranks", (("tangential tan_luding", 1), ("tangential history rolling_friction luding", 1), ("tangential history rolling_friction luding", 2),
                                 ("tangential history surface multicontact", 1), ("tangential history surface multicontact", 2),
                                 ("tangential history surface superquadric", 1)))
    def test_what_is_not_built(self, models, ranks, command):
        """Each other model of LIGGGHTS, for pairs and walls, is refused in one sentence that says what is possible."""
        deck = wall_deck("mpm", self.words(), POWDER, RADIUS, 1.0, 2e-7).splitlines()
        deck = "\n".join(line.replace("tangential history", models) if line.startswith(command) else line for line in deck) + "\n"
        self.refused(deck, "model mpm also for 'tangential plastic'", "choose among these", ranks=ranks)

    def test_liquid_bridges(self):
        """easo and washino pull across the gap after a contact: elastic spheres move as under stock Hertz with the same model, on 1
        and 2 ranks. `energy on` books the work of the bridge in contact and across the gap: what the two lose."""
        one = "fix p6 all property/global coefficientRestitution peratomtypepair 1 1.0\nfix p1"
        slow, dt = 0.05, 2e-7
        for model, words in (("mpm", self.words("elastic")), ("thornton", "elasticDamping off tangential_damping off")):
            material = STEEL if model == "mpm" else Material("elastic", POWDER.density, POWDER.youngs_modulus, 0.3, 1e30)
            for liquid in ("easo/capillary/viscous", "washino/capillary/viscous"):
                def deck_of(name, words, cohesion):
                    deck = pair_deck(name, words, (material, material), (RADIUS, RADIUS), slow, dt, run="run 3000")
                    return deck.replace("fix p1", BRIDGE + one, 1).replace("tangential history", f"tangential history {cohesion}")
                ours = deck_of(model, words, f"cohesion {liquid}")
                (stock,), (dry,), (alone,) = self.run_each((*(deck_of("hertz", "tangential_damping off", c) for c in (f"cohesion {liquid}", "")), ours), "SPEED")
                assert stock < 0.99 * dry
                for found in (alone, self.result(self.run_deck(ours, ranks=2), "SPEED")[0]):
                    # the re-tabulated x^1.5 is good to 1e-6, but the bridge may break a step earlier or later: its pull of 0.7 mN
                    # for 0.2 us is 1e-4 of the momentum
                    assert found / stock == approx(1.0, abs=2e-4), f"{model} {liquid}"
                said = 'variable o equal f_granulaw[15]\nprint "OTHER ${o}"\nvariable s equal'
                for ranks in (1, 2):
                    text = self.run_deck(deck_of(model, words + " energy on", f"cohesion {liquid}").replace("variable s equal", said), ranks=ranks)
                    speed, lost = self.result(text, "SPEED")[0], self.result(text, "OTHER")[0]
                    # of the elastic contact alone velocity Verlet keeps the energy to some 1e-5, at 100 steps a contact
                    energy = 0.25 * sphere_mass(RADIUS, material.density) * slow**2
                    assert lost / energy == approx(1 - (speed / slow)**2, abs=1e-4), f"{model} {liquid} {ranks}"

    def test_cohesion_is_felt(self):
        strong = MORE.replace("1000", "1e6")
        deck = wall_deck("mpm", self.words(), POWDER, RADIUS, 1.0, 2e-7, tangential="history cohesion sjkr")
        (pulled,), (free,) = self.run_each((deck.replace("fix p1", more) for more in (strong, MORE)), "SPEED")
        assert pulled < free - 0.001
        text = self.run_deck(deck.replace("fix p1", MORE).replace("materials powder", "materials powder stretch 3"))
        assert text.count("does not reach into the cohesion model") == 1
