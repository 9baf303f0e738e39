"""Types, units and errors of every name; SI. All raise Error where input cannot be used."""
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str
__all__ = ["Contact", "Error", "Law", "Material", "Materials", "Pair", "Particle", "calibrate", "impact", "press", "read",
           "read_materials", "sphere", "table", "__version__"]

Path = str | os.PathLike[str]
Numbers = NDArray[np.float64]
Progress = Callable[[float], None]


class Error(ValueError):
    """Input that cannot be used, in one sentence."""


class Material:
    """An elastic-plastic material. Laws with other hardening, rates or yield surfaces come from a materials file."""
    def __init__(self, *, density: float, youngs_modulus: float, poisson_ratio: float, yield_stress: float = ..., hardening_modulus: float = 0.0) -> None:
        """kg/m^3, Pa, -, Pa (left out: elastic), Pa."""
    @property
    def density(self) -> float:
        """kg/m^3"""
    @property
    def youngs_modulus(self) -> float:
        """Pa"""
    @property
    def poisson_ratio(self) -> float:
        """0 to below 0.5"""
    @property
    def yield_stress(self) -> float:
        """Pa; infinity: elastic"""
    @property
    def hardening_modulus(self) -> float:
        """Pa, of linear hardening"""


class Particle:
    """A body that hits or is pressed: sphere(), or one of a materials file."""
    @property
    def radius(self) -> float:
        """m"""


class Materials:
    """What read_materials() gives."""
    @property
    def materials(self) -> dict[str, Material]:
        """By name."""
    @property
    def particles(self) -> list[str]:
        """Names."""
    def particle(self, name: str) -> Particle:
        """The particle of this name."""


class Pair:
    """Two bodies of known sizes and their law. Overlaps: R_i + R_j less the distance of the centres."""
    @property
    def names(self) -> str:
        """"a:b"."""
    @property
    def r_eff(self) -> float:
        """m, R_i R_j/(R_i + R_j)."""
    @property
    def m_eff(self) -> float:
        """kg, m_i m_j/(m_i + m_j)."""
    @property
    def largest_overlap(self) -> float:
        """m, to which the law's table goes. Beyond it force() and curves() raise Error."""
    @property
    def fastest(self) -> float:
        """m/s, to which the law's velocity axis goes; infinity without one."""
    def force(self, overlap: ArrayLike, largest: ArrayLike | None = None, *, speed: float = 0.0) -> Numbers:
        """N, pushing, at overlaps (m) of contacts whose largest overlap was `largest` (m, one number or as many; None: they load)
        and that began at `speed` (m/s; 0: slowly). The shape of `overlap`."""
    def curves(self, overlap: ArrayLike, largest: ArrayLike | None = None, *, speed: float = 0.0) -> tuple[Numbers, Numbers, Numbers]:
        """Force (N), its slope (N/m) and the contact radius (m); as force()."""
    def impact(self, velocity: float) -> dict[str, Any]:
        """One collision by the law: the keys of `mpm law --json` and `warnings`, sentences. m/s."""
    def restitution(self, velocity: ArrayLike) -> Numbers:
        """e of collisions at these speeds (m/s). The shape of `velocity`."""


class Contact:
    """The law of two materials, step by step, for bodies of any size: Law.contact().

    Arrays of n contacts are structured; all units are SI.
    motion: radius_a, radius_b (infinity: a wall), m_eff, overlap, approach (positive: nearer), dt, normal[3] (from b to a),
        slide[3] (velocity of a's surface against b's, along it), rolling[3], asked_again (1: nothing is kept).
    answer: normal, shear[3], couple[3] on body a; beyond (bits: 1 overlap, 2 too fast, 4 too slow, 8 another size).
    state: stiffness, contact_radius, stored_energy, largest_overlap, branch (0 apart, 1 loading, 2 unloading).
    """
    @property
    def values(self) -> int:
        """Numbers that a contact keeps between two steps."""
    @staticmethod
    def motion(n: int = 1) -> NDArray[np.void]:
        """n motions: all zero, with a wall as partner and the normal along z."""
    def history(self, n: int = 1) -> Numbers:
        """n x values: zero, of contacts that begin."""
    def advance(self, motion: NDArray[np.void], history: Numbers, ledger: Numbers | None = None) -> NDArray[np.void]:
        """Forces of a step; changes `history`. To `ledger`, five numbers, are added J that plastic flow, waves, friction, shear and
        adhesion took."""
    def state(self, motion: NDArray[np.void], history: Numbers) -> NDArray[np.void]:
        """What the contacts are beside their forces; changes nothing."""


class Law:
    """A law file in memory."""
    @property
    def materials(self) -> dict[str, Material]:
        """By name. A hardening law that is not linear is not in them."""
    @property
    def pairs(self) -> list[str]:
        """"a:b", "a:wall", ..."""
    @property
    def provenance(self) -> dict[str, str]:
        """Version, command, hashes."""
    def write(self, path: Path) -> None:
        """A law file, whole or not at all, for `mpm` and LIGGGHTS."""
    def pair(self, pair: str = "", *, radius: float | None = None, radius2: float | None = None) -> Pair:
        """Two bodies by name ("" where there is one pair) and size, m: 1e-3, or the only one that the law allows; radius2 as
        radius, infinity: a thick deformable wall."""
    def contact(self, pair: str, *, friction: float = 0.0, tangential: str = "history", shear_stiffness: float = 0.0,
                shear_damping: float = 0.1, elastic_damping: float = 0.001, stretch: float = 1.0, waves: bool = True,
                radius_a: float = 0.0, radius_b: float = 0.0, work_of_adhesion: float = 0.0, adhesion_range: float = 0.0) -> Contact:
        """The law step by step. tangential: "history" or "plastic". shear_stiffness: 8 G*, Pa; 0: by the law's moduli. damping:
        parts of critical. radius_a, radius_b: of most bodies, m, for waves; 0: of the law's own ratio.
        work_of_adhesion: J/m2 of the two surfaces. adhesion_range: m; 0: 0.4 nm."""


def read(path: Path) -> Law:
    """A law file of `mpm table`."""
def read_materials(path: Path) -> Materials:
    """A materials file."""
def sphere(radius: float, material: Material) -> Particle:
    """A homogeneous sphere; radius in m."""
def table(materials: Mapping[str, Material] | Materials | Path, pairs: Iterable[str] = (), *, tolerance: float = 0.01, depth: float = 0.2,
          damage_number: float = 0.0625, jobs: int = 1, progress: Progress | None = None) -> Law:
    """Contact laws, as `mpm table` makes them: in about a second from the atlas, else by runs of the solver in `jobs` threads.

    pairs: "a:b", "a:wall"; none: all. tolerance: relative, of F and e. depth: largest overlap/R. damage_number: largest
    rho V^2/Y. progress: is called with 0 to 1 while the solver runs; Ctrl-C stops."""
def impact(particle: Particle, velocity: float, *, against: Particle | Material | None = None, friction: float = 0.0,
           tangential_velocity: float = 0.0, spin: float = 0.0, orientation: Sequence[float] = (0, 0, -1), grid: str = "auto",
           resolution: int = 0, shifted_grids: int = 4, threads: int = 1, estimate_error: bool = False, progress: Progress | None = None) -> dict[str, Any]:
    """One collision by the solver: the keys of `mpm impact --json`, and `trace`: arrays time_s, delta_m, force_N,
    contact_radius_m. velocity: m/s. against: another particle, a material (a thick wall), None (a rigid wall)."""
def press(particle: Particle, depth: float, *, against: Particle | Material | None = None, support: str = "free", grid: str = "auto",
          resolution: int = 0, shifted_grids: int = 4, threads: int = 1, estimate_error: bool = False, progress: Progress | None = None) -> dict[str, Any]:
    """One press by the solver to an overlap of `depth` radii and back; support: "free" or "midplane". As impact()."""
def calibrate(*files: Path, fit: str | Sequence[str], **options: float | str | bool | Sequence[str] | None) -> dict[str, Any]:
    """A material from measurements: the keys of `mpm calibrate --json`. Options are its words: radius=1e-3, density=1540,
    kind="platens". Only linear hardening, which the atlas has."""
