"""Defects that are known: (feature or "*", models, part of the outcome, why it stands). An entry that no run shows any more is to be removed."""
KNOWN = (
    ("*", ("thornton",), "energy drifts", "thornton with `stretch` books the energies of the unstretched contact"),
)
