"""Tables that scripts write into a README, between marks that name the script."""


def put(page, name, text, write):
    """Prints `text`, or replaces with it what stands between the marks of `name` in the file `page`."""
    if not write:
        print(text, end="")
        return
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    old = page.read_text()
    if old.count(begin) != 1 or old.count(end) != 1:
        raise SystemExit(f"{page}: needs the lines {begin} and {end}, once each")
    before, rest = old.split(begin)
    page.write_text(f"{before}{begin}\n{text}{end}{rest.split(end)[1]}")
