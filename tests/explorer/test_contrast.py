"""test_contrast.py PAGE.css: contrast of the page's colours, light and dark, by WCAG 2.1 level AA.

Text has 4.5 to 1 against what lies behind it (success criterion 1.4.3); lines, marks and rims of controls 3 to 1 (1.4.11). Every colour of
the stylesheet that is used for text or for a line must be in the lists below; one that is missing fails.
"""
import re
import sys
from pathlib import Path

CARD, ZONES = ["card"], ["elastic", "inertia", "beyond"]
TEXT = {"text": ["page", "card", "good", "fair", "bad"], "soft": ["page", "card"] + ZONES, "law": CARD, "hertz": CARD, "thornton": CARD, "kept": CARD,
        "card": ["law"]}  # the last: the chosen partner
LINES = {"law": CARD + ZONES, "hertz": CARD + ZONES, "thornton": CARD + ZONES, "kept": CARD + ZONES, "data": CARD + ZONES, "soft": CARD + ZONES, "rim": ["card", "page"],
         "good-edge": CARD, "fair-edge": CARD, "bad-edge": CARD}
DECORATION = {"card", "edge", "grid"}  # halos behind text, frames of cards, grid lines: nothing is read from them alone


def luminance(colour):
    parts = [int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5)]
    return sum(w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055)**2.4) for w, c in zip((0.2126, 0.7152, 0.0722), parts))


def contrast(a, b):
    low, high = sorted((luminance(a), luminance(b)))
    return (high + 0.05) / (low + 0.05)


def colours(block):
    found = dict(re.findall(r"--([a-z-]+): (#[0-9a-f]{3,6})", block))
    return {name: c if len(c) == 7 else "#" + "".join(2 * x for x in c[1:]) for name, c in found.items()}


def main():
    style = Path(sys.argv[1]).read_text()
    light, dark = (colours(block) for block in re.findall(r":root \{(.*?)\}", style, re.S))
    failures = [f"only one of the two schemes has --{name}" for name in set(light) ^ set(dark)]
    used = {"text": set(re.findall(r"(?<![-\w])color: var\(--([a-z-]+)\)", style)) | set(re.findall(r"(?:text|name|label)[^{}]*\{[^{}]*fill: var\(--([a-z-]+)\)", style)),
            "lines": set(re.findall(r"(?:stroke|outline|border[a-z-]*):[^;{}]*var\(--([a-z-]+)\)", style))}
    failures += [f"text: --{name} is in no list" for name in used["text"] - set(TEXT)]
    failures += [f"lines: --{name} is in no list" for name in used["lines"] - set(LINES) - DECORATION]
    least = {}
    for scheme, palette in (("light", light), ("dark", dark)):
        for limit, pairs in ((4.5, TEXT), (3.0, LINES)):
            for front, backs in pairs.items():
                for back in backs:
                    found = contrast(palette[front], palette[back])
                    least[limit] = min(least.get(limit, (99, ""))[0:2], (found, f"{scheme}: {front} on {back}"))
                    if found < limit:
                        failures.append(f"{scheme}: --{front} on --{back} has {found:.2f}, needs {limit}")
    found = contrast("#ffffff", "#14304d"), contrast("#cfdcea", "#14304d")
    for colour in ("#14304d", "color: #fff", "#cfdcea"):
        if colour not in style:
            failures.append(f"the header no longer has {colour}")
    if min(found) < 4.5:
        failures.append(f"header: {found}")
    print(f"least of text {least[4.5][0]:.2f} ({least[4.5][1]}), of lines {least[3.0][0]:.2f} ({least[3.0][1]})")
    for failure in failures:
        print(f"FAILED: {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
