// Materials to begin with, SI: density, E, nu, Y (Infinity: elastic), hardening, and the source of each number. Numbers in
// brackets: the literature of docs/guide/yield-stress.md.
const MATERIALS = [
  ["wax", 920, 91e6, 0.3, 1e6, 0, "a soft wax, representative values: the example of the first flow"],
  ["lactose", 1540, 24.1e9, 0.12, 180e6, 0, "assumed, without a traceable source: the example 'mixture'"],
  ["mcc", 1460, 5e9, 0.3, 40e6, 0, "like pellets of microcrystalline cellulose, assumed: the example 'mixture'"],
  ["m1-silo", 2500, 1e9, 0.2, 3.7e6, 0, "M1 of the silo benchmark (Dosta et al. 2024); Y set for e = 0.5 at 1 m/s"],
  ["sucrose", 1590, 35e9, 0.3, 500e6, 0, "E, H/3 of a single crystal [6]; density and nu assumed"],
  ["polyethylene-hd", 950, 0.7e9, 0.42, 25e6, 0, "middle of the ranges of E and tensile strength [11]; density and nu assumed"],
  ["polypropylene", 905, 1.1e9, 0.42, 32e6, 0, "middle of the ranges of E and tensile strength [11]; density and nu assumed"],
  ["aluminium-6061-t6", 2700, 69e9, 0.33, 270e6, 0, "E and Y [12], [13]; density and nu assumed"],
  ["aluminium-1100", 2710, 69e9, 0.33, 34e6, 0, "annealed: E and Y [12], [13]; density and nu assumed"],
  ["steel-a36", 7850, 200e9, 0.3, 250e6, 0, "Y [13]; E, density and nu assumed"],
  ["steel-a514", 7850, 200e9, 0.3, 700e6, 0, "Y [13]; E, density and nu assumed"],
  ["bearing-steel-soft", 7810, 190e9, 0.3, 460e6, 0, "52100, not hardened: E and the middle of Y [14]; density and nu assumed"],
  ["steel-elastic", 7850, 210e9, 0.3, Infinity, 0, "elastic: the walls of the example 'mixture'"],
].map(([name, density, youngs_modulus, poisson_ratio, yield_stress, hardening_modulus, source]) =>
  ({name, density, youngs_modulus, poisson_ratio, yield_stress, hardening_modulus, source}));
