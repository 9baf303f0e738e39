"""Defects that are known: (feature as a regular expression, models, part of the outcome as a regular expression, why it stands). Entries that no run shows are named at the
end of a full run: remove them."""
BOTH = ("mpm", "thornton")
NEAR = "LIGGGHTS hands a wall's spheres over from contact_distance_factor 1.01 on, which both models need for their pairs: a sphere near a wall counts as touching"
KNOWN = (
    (".*", ("thornton",), "energy drifts.*stretch", "thornton with `stretch` books the energies of the unstretched contact"),
    ("walls of the other model", ("mpm",), "energy drifts.*stretch", "the same: the walls are thornton's"),
    ("a sphere that fills a zcylinder", BOTH, "lays out its contact data differently", "a sphere on the axis has distance and overlap 0, which the check of the layout takes for another library"),
    (".*temperature.*", BOTH, "not a number in", NEAR),
    (".*temperature.*", BOTH, "state.txt", NEAR),
    (".*wall/gran/local.*heatFlux", BOTH, "not a number in", NEAR),
    (".*wall/gran/local.*", BOTH, "local.txt", NEAR),
    (".*local/gran/vtk of walls", BOTH, "vtk", NEAR),
    ("neigh_modify one 5000 page 50000.*", BOTH, "ends with", "LIGGGHTS's pages of contact history hold less than one sphere's values"),
    ("run_style respa.*|respa, .*", BOTH, "energy drifts", "the work of the other forces is measured once a step, and respa does not call the fix that does it"),
    ("walls before pair_style", BOTH, "energy drifts", "a wall that stands before the pair style with `energy on` keeps no books"),
    ("stretch at the wall only", ("thornton",), "energy drifts", "thornton with `stretch` books the energies of the unstretched contact"),
)
