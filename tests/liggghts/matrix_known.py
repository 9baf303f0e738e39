"""Defects that are known: (feature as a regular expression, models, part of the outcome as a regular expression, why it stands). Entries that no run shows are named at the
end of a full run: remove them."""
KNOWN = ()
